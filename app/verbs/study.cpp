// The verb study: many parameter sets of one diagram, shard by shard, and all of them together.
// Does not decide what a sample is (fit/study/study.h) nor how shards lie on the disk (study_shards.h).
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <memory>
#include <set>

#include "app/cli/answer.h"
#include "app/cli/interrupt.h"
#include "app/cli/load.h"
#include "app/cli/publish.h"
#include "app/cli/shape.h"
#include "app/study/study_merge.h"
#include "app/study/study_page.h"
#include "app/study/study_shards.h"
#include "app/study/study_slurm.h"
#include "engine/diagram/error.h"
#include "engine/diagram/stop.h"
#include "engine/lanes/lanes.h"
#include "io/diagram/diagram_file.h"
#include "io/files/shell_word.h"
#include "report/pages/numbers.h"

namespace hysteron {
namespace {

constexpr char study_help[] =
    "Answers: what comes out where parameters are spread. Draws parameter sets of one diagram (grid, uniform,\n"
    "Latin hypercube, Sobol, list), simulates each, takes features, filters, and keeps the samples in one file.\n\n"
    "Examples:\n"
    "  hysteron study tolerance.json                    every shard, then study.h5, result.json and report.html\n"
    "  hysteron study tolerance.json --shard 3/16       one shard alone, on this machine or another\n"
    "  hysteron study tolerance.json --merge            joins the shards that are there\n"
    "  hysteron study tolerance.json --slurm            shards and merge as jobs of a cluster, docs/clusters.md\n\n"
    "Started again, it goes on: finished shards of this very job are kept. Killed at any moment and started\n"
    "again, it gives the same bytes as without. docs/study.md says how jobs are written.\n"
    "Writes into the folder: shards/*.h5, study.h5 (and study.csv), result.json, report.html; with --slurm: slurm/.\n"
    "Exit codes: 0 done, 2 the job or the diagram is wrong, shards are missing, 130 interrupted.";

struct ShardChoice {
  int shard = 0, shards = 0;  ///< from 1
};

/// "3/16"
ShardChoice shard_of(const std::string& text) {
  ShardChoice c;
  const char* const end = text.data() + text.size();
  auto [at, code] = std::from_chars(text.data(), end, c.shard);
  if (code == std::errc{} && at != end && *at == '/') {
    const auto [last, second] = std::from_chars(at + 1, end, c.shards);
    if (second == std::errc{} && last == end && c.shard >= 1 && c.shard <= c.shards) return c;
  }
  fail("bad_command_line", "--shard", fmt::format("\"{}\" does not say which shard of how many", text),
       "write --shard 3/16: from 1 to the number of shards");
}

/// A study as it is asked for.
struct Asked {
  StudyJob job;
  StudyProblem problem;
  std::string folder;
  int shards = 1;
};

/// Runs `action`; an Error that it throws gets the file and line of the job.
template <class Action>
void with_lines_of_job(const StudyJob& job, const Action& action) {
  try {
    action();
  } catch (Error& error) {
    for (auto& p : error.problems)
      if (p.path.starts_with("--")) {  // "--set a.b=2", as on the command line
        const auto space = p.path.find(' ');
        p.path =
            fmt::format("/{}/{}", p.path.substr(2, space - 2), p.path.substr(space + 1, p.path.find('=') - space - 1));
      }
    locate_problems(error, job.file);
    throw Error(error.fault, error.problems);
  }
}

Asked read(const Arguments& arguments) {
  Asked asked;
  asked.job = read_study_job(arguments.text("job"), arguments.list("--allow"));
  Diagram diagram = read_diagram(asked.job.diagram, arguments.list("--allow"));
  with_lines_of_job(asked.job, [&] { apply_settings(diagram, asked.job.set, asked.job.choose); });
  const ProgramPointer program = compile_file(diagram);
  with_lines_of_job(asked.job, [&] { asked.problem = study_of(asked.job, program); });
  asked.folder = arguments.text("-o", stem_of(arguments.text("job")) + ".study");
  asked.shards = arguments.whole_number("--shards", asked.problem.study.shards);
  return asked;
}

/// The digest changes with the program, too: shards of two versions are not put together.
std::string digest_of(const Study& study) {
  return text_digest(fmt::format("hysteron {}\n{}", HYSTERON_VERSION, study.description));
}

std::string again_text(const Arguments& arguments, const Asked& asked) {
  std::string text =
      fmt::format("hysteron study {} -o {}", shell_word(arguments.text("job")), shell_word(asked.folder));
  if (arguments.has("--shards")) text += fmt::format(" --shards {}", asked.shards);
  return text;
}

std::string progress_text(const StudyProgress& p, const Study& study) {
  const std::string shards = fmt::format("{} of {} shards, {} draws", p.finished, p.shards, p.draws);
  return study.draws > 0 ? shards : fmt::format("{}, {} accepted", shards, p.accepted);
}

/// Computes what is missing of these shards. Returns what is said on the terminal alone: where the time went.
std::vector<std::string> compute(const Arguments& arguments, const Watch& watch, const Asked& asked,
                                 const StudyFolder& folder, const std::vector<int>& wanted) {
  const Study& study = asked.problem.study;
  std::vector<std::string> said;
  if (folder.open())
    said.push_back("note: the job or its diagram was changed since shards were computed here; those are computed anew");
  folder.clean();
  std::vector<int> missing;
  int damaged = 0;
  for (const int k : wanted) {
    const ShardState state = folder.state(k);
    if (!can_be_merged(state)) missing.push_back(k);
    damaged += state == ShardState::damaged ? 1 : 0;
  }
  if (damaged > 0)
    said.push_back(fmt::format("note: {} damaged; computed anew",
                               damaged == 1 ? "1 shard was" : fmt::format("{} shards were", damaged)));
  if (missing.size() < wanted.size())
    said.push_back(fmt::format("{} of {} shards were there already", wanted.size() - missing.size(), wanted.size()));
  if (missing.empty()) return said;
  const int threads = arguments.threads();
  const auto begin = std::chrono::steady_clock::now();
  const double part = static_cast<double>(missing.size()) / folder.shards();
  const double all = part * static_cast<double>(study.draws > 0 ? study.draws : study.accepted);
  StudyProgress last;
  folder.compute(missing, wanted.size() - missing.size(), threads, [&](const StudyProgress& now) {
    last = now;
    watch.show(std::min(1.0, static_cast<double>(study.draws > 0 ? now.draws : now.accepted) / all),
               progress_text(now, study));
  });
  if (const auto apart = why_not_in_lanes(*study.program, study.base, study.options, study.parameters); !apart.empty())
    said.push_back("simulated one after the other: " + apart);
  const double seconds = seconds_since(begin);
  const int used = std::min(threads, static_cast<int>(missing.size()));
  said.push_back(
      fmt::format("time: {} s for {} in {} on {}; {} ms per draw on one", number_text(seconds, 3),
                  count_text(static_cast<long>(last.draws), "draw"),
                  count_text(static_cast<long>(missing.size()), "shard"), count_text(used, "thread"),
                  number_text(last.draws == 0 ? 0 : 1e3 * seconds * used / static_cast<double>(last.draws), 3)));
  return said;
}

Answer one_shard(const Arguments& arguments, const Watch& watch, const Asked& asked) {
  const ShardChoice choice = shard_of(arguments.text("--shard"));
  if (arguments.has("--csv"))
    fail("bad_command_line", "--csv", "one shard alone writes no CSV", "give --csv with --merge");
  if (asked.problem.study.draws == 0 && choice.shards != asked.shards)
    fail("bad_command_line", "--shard",
         fmt::format(
             "the job is cut into {} shards, and which samples it has depends on that: it draws until {} are accepted",
             asked.shards, asked.problem.study.accepted),
         fmt::format("write --shard {}/{}, or change \"shards\" in the job", std::min(choice.shard, asked.shards),
                     asked.shards));
  const StudyFolder folder(asked.folder, asked.problem.study, digest_of(asked.problem.study), choice.shards);
  const auto said = compute(arguments, watch, asked, folder, {choice.shard - 1});
  const std::string file = folder.shard_file(choice.shard - 1);
  Answer answer;
  if (!arguments.quiet())
    for (const auto& line : said) answer.text += fmt::format("  {}\n", line);
  answer.text += fmt::format("shard {} of {}: {}\n", choice.shard, choice.shards, file);
  answer.files.push_back({file, "", true});
  answer.facts = Facts::object({{"shard", choice.shard}, {"shards", choice.shards}});
  return answer;
}

/// What the shards and the merge on a cluster must be told as this command was.
Answer submit(const Arguments& arguments, const Asked& asked, const StudyFolder& folder) {
  std::vector<std::string> words;
  if (arguments.has("--shards")) words = {"--shards", fmt::format("{}", asked.shards)};
  for (const auto& allowed : arguments.list("--allow")) words.push_back("--allow=" + allowed);
  std::vector<std::string> merge_words;
  if (arguments.has("--csv")) merge_words = {"--csv"};
  const StopScope to_its_end(nullptr);  // what Slurm has taken must be written down
  folder.open();
  return submit_study(arguments, arguments.text("job"), asked.job.title.empty() ? asked.job.name : asked.job.title,
                      folder, words, merge_words);
}

/// Every shard that is missing, unless only those that are there are to be joined; then the results.
Answer whole_study(const Arguments& arguments, const Watch& watch, const Asked& asked, const StudyFolder& folder,
                   std::shared_ptr<HeldFolder> held) {
  Answer answer;
  auto& said = answer.asides;
  if (arguments.has("--merge")) {
    folder.clean();
  } else {
    std::vector<int> all;
    for (int k = 0; k < asked.shards; ++k) all.push_back(k);
    said = compute(arguments, watch, asked, folder, all);
  }
  StagedResults& staged = held->staged.emplace(held->lock, std::set<std::string>{"study.h5", "study.csv"});
  const MergedStudy merged = merge_shards(folder, asked.problem, asked.job.title, arguments.has("--csv"),
                                          again_text(arguments, asked), staged);
  if (merged.unsealed > 0)
    said.push_back(fmt::format(
        "note: {} by an earlier version of hysteron; whether their numbers have changed on the disk since "
        "cannot be seen. Without {}/shards the same command computes them anew",
        merged.unsealed == 1 ? "1 shard was written" : fmt::format("{} shards were written", merged.unsealed),
        asked.folder));
  answer.document = study_document(asked.job, asked.problem, folder, merged);
  answer.document.data = merged.files;
  answer.folder = asked.folder;
  answer.held = std::move(held);
  return answer;
}

Answer study(const Arguments& arguments, const Watch& watch) {
  if (arguments.has("--shard") && arguments.has("--merge"))
    fail("bad_command_line", "--merge", "one shard alone cannot be merged",
         "give --shard or --merge, or none of them for everything");
  for (const char* other : {"--shard", "--merge", "--threads"})
    if (wants_slurm(arguments) && arguments.has(other))
      fail("bad_command_line", other,
           fmt::format("{} and --slurm exclude each other: shards and merge become jobs of one core each", other),
           "leave one of them out; a shard computed by --shard before is kept and not submitted");
  const Asked asked = read(arguments);
  watch.keep();
  const StopScope scope(watch.stop);
  try {
    if (arguments.has("--shard")) return one_shard(arguments, watch, asked);
    const StudyFolder folder(asked.folder, asked.problem.study, digest_of(asked.problem.study), asked.shards);
    folder.check();
    auto held = hold_folder(asked.folder, watch);
    return wants_slurm(arguments) ? submit(arguments, asked, folder)
                                  : whole_study(arguments, watch, asked, folder, std::move(held));
  } catch (const Stopped&) {
    throw Interrupted(fmt::format(
        "interrupted; shards that are finished are kept in {}/shards, and the same command goes on from there",
        asked.folder));
  }
}

/// Of the whole study its folder; of one shard, or of a submission to Slurm, what follows it.
std::vector<shape::Member> study_shape() {
  using namespace shape;
  const Facts jobs = object("as Slurm numbers them", {{"shards", text("empty: none was missing")},
                                                      {"merge", text("empty: nothing was submitted")}});
  const Facts filter = object(
      "a filter", {{"filter", text("as it is meant")}, {"passed", whole("draws")}, {"share", number("of all draws")}});
  const Facts column = object("of the accepted samples", {{"unit", text("of the values")},
                                                          {"meaning", text("what it is")},
                                                          {"smallest", number("")},
                                                          {"mean", number("")},
                                                          {"deviation", number("standard deviation")},
                                                          {"largest", number("")}});
  const Facts facts = object("of the whole study", {{"job", text("digest of what decides the numbers")},
                                                    {"draws", whole("all")},
                                                    {"accepted", whole("by every filter")},
                                                    {"share", number("accepted of all")},
                                                    {"filters", list("in their order", filter)},
                                                    {"failed", named("draws, by code", whole("how many"))},
                                                    {"not_finite", named("draws, by column", whole("how many"))},
                                                    {"gave_up", flag("too few were accepted")},
                                                    {"columns", named("by name", column)}});
  return published({{"facts", facts, sometimes},
                    {"shard", whole("that was computed alone, from 1"), sometimes},
                    {"shards", whole("of so many"), sometimes},
                    {"submitted", flag("to Slurm"), sometimes},
                    {"missing", whole("shards that the jobs compute"), sometimes},
                    {"jobs", jobs, sometimes}},
                   sometimes);
}

}  // namespace

Verb study_verb() {
  Verb verb{
      "study",
      "simulate many parameter sets of a diagram: tolerances, sweeps, Monte Carlo",
      study_help,
      {{"job", "JOB.json", "the study (\"do\": \"study\", docs/study.md)", true, false},
       {"-o", "FOLDER", "where everything goes; default: named after the job, e.g. tolerance.study", false, false},
       {"--shard", "K/N", "compute shard K of N alone, and merge nothing", false, false},
       {"--merge", "", "compute nothing, join the shards that are there", false, false},
       {"--shards", "N", "cut it into so many; default: as the job says, else 16", false, false},
       options::threads("shards"),
       {"--csv", "", "write the samples as study.csv, too", false, false},
       options::allow()},
      study,
      study_shape};
  for (auto& option : slurm_options()) verb.options.push_back(std::move(option));
  return verb;
}

}  // namespace hysteron
