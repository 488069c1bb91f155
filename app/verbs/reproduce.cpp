// The verb reproduce: runs the jobs behind the figures of a published work and holds its claims against what comes out.
// Does not run the jobs itself (published_runs.h), draw them (job_figures.h) nor judge a claim (claims.h).
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>

#include "app/cli/answer.h"
#include "app/cli/shape.h"
#include "app/cli/terminal.h"
#include "app/jobs/baseline.h"
#include "app/jobs/published_runs.h"
#include "engine/diagram/error.h"
#include "report/page/report.h"
#include "report/pages/numbers.h"

namespace hysteron {
namespace {

namespace fs = std::filesystem;

constexpr char reproduce_help[] =
    "Answers: does a published work come out again, figure by figure and claim by claim. Runs the jobs\n"
    "(\"do\": \"runs\") of a folder of diagrams and prints, per claim: id, what it says, what came out, what was\n"
    "expected, and the outcome:\n"
    "  agrees              within the tolerance\n"
    "  calibrated          agrees, but a stand-in was tuned to reach it: it shows only that the number is reachable\n"
    "  differs             outside the tolerance; why, where that is known\n"
    "  cannot be checked   and the reason\n\n"
    "Examples:\n"
    "  hysteron reproduce                     everything\n"
    "  hysteron reproduce chapter2            the figures of one chapter\n"
    "  hysteron reproduce fig2_15 -o out      one figure\n"
    "  hysteron reproduce C2-07               the figures that settle one claim\n"
    "  hysteron reproduce chapter4 --full     its searches and studies in full size\n"
    "  hysteron reproduce all --baseline kept     kept at the first time, compared with at the next ones\n\n"
    "Writes into the folder: result.json, traces/*.csv (what each figure draws), report.html with the claims, and\n"
    "a page per chapter (chapter2.html) with every figure, each as SVG beside it. docs/reproduce.md tells how a job is "
    "written.\n"
    "Exit codes: 0 done, whatever was found, 1 a claim that held in the baseline does not any more, 2 a job is\n"
    "wrong, 3 a run failed.";

/// Claims of which jobs that were not run settle further parts: the outcome is that of the parts that were.
void tell_missing_parts(std::vector<ClaimOutcome>& claims, const std::vector<PublishedJob>& others, JobPool& pool) {
  std::map<std::string, std::vector<std::string>> elsewhere;
  for (const auto& job : others) try {
      for (const auto& part : pool.job(job.file).job().claims) {
        auto& names = elsewhere[part.id];
        if (names.empty() || names.back() != job.name) names.push_back(job.name);
      }
    } catch (const Error&) {
      continue;  // a job that was not asked for need not be right
    }
  for (auto& c : claims)
    if (const auto found = elsewhere.find(c.claim.id); found != elsewhere.end() && c.reason.empty())
      c.reason = fmt::format("further parts of it are settled by {}, not run here", fmt::join(found->second, ", "));
}

// ---- what is told ---------------------------------------------------------------------------------------------------

std::string counts_text(const std::vector<ClaimOutcome>& claims) {
  std::vector<std::string> parts;
  for (const char* outcome : {"agrees", "calibrated", "differs", "cannot be checked"}) {
    const auto n = std::count_if(claims.begin(), claims.end(), [&](const auto& c) { return c.outcome == outcome; });
    if (n == 0) continue;
    const std::string word = outcome;
    parts.push_back(fmt::format("{} {}", n,
                                n == 1 || word == "calibrated" || word == "cannot be checked" ? word
                                : word == "agrees"                                            ? "agree"
                                                                                              : "differ"));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

/// One claim for the terminal: its outcome, what it says, and each part below it.
std::string claim_text(const ClaimOutcome& c) {
  std::string text = wrapped(fmt::format("{} {}: {}", c.claim.id, c.outcome, c.claim.says));
  if (!c.reason.empty()) text += wrapped(c.reason, 8);
  for (const auto& part : c.parts) {
    text += wrapped(
        fmt::format("{}{}: {}; expected {}", part.holds ? "" : "differs: ", part.job, part.came_out, part.expected), 8);
    if (!part.holds && !part.remark.empty()) text += wrapped(part.remark, 8);
  }
  if (!c.claim.remark.empty()) text += wrapped(c.claim.remark, 8);
  if (!c.claim.calibrated.empty() && c.outcome == "calibrated") text += wrapped("calibrated: " + c.claim.calibrated, 8);
  return text;
}

Facts claim_facts(const std::vector<ClaimOutcome>& claims) {
  Facts list = Facts::object({});
  for (const auto& c : claims) {
    Facts::List parts;
    for (const auto& p : c.parts)
      parts.push_back(Facts::object({{"job", p.job},
                                     {"holds", p.holds},
                                     {"came_out", p.came_out},
                                     {"expected", p.expected},
                                     {"remark", p.remark}}));
    list.set(c.claim.id, Facts::object({{"says", c.claim.says},
                                        {"outcome", c.outcome},
                                        {"reason", c.reason},
                                        {"remark", c.claim.remark},
                                        {"parts", parts}}));
  }
  return list;
}

/// The part of `claims` that a job settles, for the section of its figure.
std::vector<ClaimOutcome> claims_of(const std::vector<ClaimOutcome>& claims, const std::string& job) {
  std::vector<ClaimOutcome> list;
  for (auto c : claims) {
    std::erase_if(c.parts, [&](const PartOutcome& p) { return p.job != job; });
    if (!c.parts.empty()) list.push_back(std::move(c));
  }
  return list;
}

/// The page of one chapter; its traces are those of the whole result.
Document chapter_page(const std::string& chapter, const std::vector<PublishedJob>& jobs, std::vector<JobDone>& results,
                      const std::vector<ClaimOutcome>& claims) {
  Document page;
  page.verb = "reproduce";
  page.title = chapter;
  std::vector<ClaimOutcome> of_chapter;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    if (jobs[i].chapter != chapter) continue;
    Section section = std::move(results[i].page.section);
    const auto settled = claims_of(claims, jobs[i].name);
    if (!settled.empty()) section.tables.insert(section.tables.begin(), claim_table(settled));
    for (const auto& c : claims)
      for (const auto& p : c.parts)
        if (p.job == jobs[i].name &&
            std::none_of(of_chapter.begin(), of_chapter.end(), [&](const auto& o) { return o.claim.id == c.claim.id; }))
          of_chapter.push_back(c);
    page.sections.push_back(std::move(section));
    for (auto& table : results[i].page.traces) page.traces.push_back(std::move(table));
    for (auto& file : results[i].page.files) page.files.push_back(std::move(file));
  }
  page.headline =
      fmt::format("{}: {} redrawn{}{}", chapter, count_text(static_cast<long>(page.sections.size()), "figure"),
                  of_chapter.empty() ? "" : "; claims: ", counts_text(of_chapter));
  return page;
}

/// What the reader of any of these figures must know: what stands in for a measurement, and where numbers are assumed.
std::vector<std::string> notes_on(const std::vector<PublishedJob>& jobs, const std::string& chapter, JobPool& pool) {
  std::vector<std::string> notes, assumed;
  for (const auto& job : jobs) {
    if (!chapter.empty() && job.chapter != chapter) continue;
    const RunsJob& wish = pool.job(job.file).job();
    if (!wish.surrogate.empty() && std::find(notes.begin(), notes.end(), wish.surrogate) == notes.end())
      notes.push_back(wish.surrogate);
    if (!wish.assumed.empty()) assumed.push_back(job.name);
  }
  if (!assumed.empty())
    notes.push_back(fmt::format("Numbers that the published work does not give are assumed in {}; each says which.",
                                fmt::join(assumed, ", ")));
  return notes;
}

int tell_baseline(const BaselineAnswer& answer, const std::string& folder, Document& document) {
  if (answer.kept) {
    document.sentences.push_back(fmt::format("Kept as the baseline in {}.", folder));
    return exit_code::done;
  }
  for (const auto& id : answer.worse)
    document.warnings.push_back(fmt::format("{} held in the baseline and does not any more.", id));
  for (const auto& id : answer.better)
    document.sentences.push_back(fmt::format("{} holds now; in the baseline it did not.", id));
  for (const auto& text : answer.changed) document.warnings.push_back(text);
  if (!answer.added.empty())
    document.sentences.push_back(
        fmt::format("Added to the baseline, which did not have them: {}.", fmt::join(answer.added, ", ")));
  if (answer.worse.empty() && answer.changed.empty())
    document.sentences.push_back(fmt::format("Nothing differs from the baseline in {}.", folder));
  return answer.worse.empty() ? exit_code::done : exit_code::no;
}

/// "time: 12 s, most work in fig2_13 with 2.1 s": runs that wait for others count too
std::string times_text(double seconds, const std::vector<PublishedJob>& jobs, const std::vector<JobDone>& results) {
  const auto longest = std::max_element(results.begin(), results.end(),
                                        [](const JobDone& a, const JobDone& b) { return a.seconds < b.seconds; });
  std::string text = fmt::format("time: {} s", number_text(seconds, 3));
  if (results.size() > 1)
    text += fmt::format(", most work in {} with {} s", jobs[static_cast<std::size_t>(longest - results.begin())].name,
                        number_text(longest->seconds, 2));
  return text;
}

Answer reproduce(const Arguments& arguments, const Watch& watch) {
  const auto begin = std::chrono::steady_clock::now();
  const std::string folder = arguments.has("--from") ? arguments.text("--from") : folder_of_jobs();
  const std::string claims_file = (fs::path(folder) / "claims.json").string();
  const auto published = fs::exists(claims_file) ? read_claims(claims_file) : std::vector<PublishedClaim>{};
  JobPool pool(arguments.list("--allow"), arguments.has("--full"));
  auto words = arguments.list("what");
  if (words.empty()) words.emplace_back("all");
  const WantedJobs wanted = wanted_jobs(words, jobs_in(folder), published, pool);
  auto results = run_all(wanted.jobs, pool, watch);

  std::vector<PartOutcome> parts;
  for (const auto& r : results) parts.insert(parts.end(), r.parts.begin(), r.parts.end());
  auto claims = judge_all(published, parts, wanted.prefixes);
  if (wanted.claims_alone)
    std::erase_if(claims,
                  [&](const auto& c) { return std::find(words.begin(), words.end(), c.claim.id) == words.end(); });
  tell_missing_parts(claims, wanted.others, pool);
  Answer answer;
  Document& document = answer.document;
  document.verb = "reproduce";
  document.title = fmt::format("{}", fmt::join(words, " "));
  document.headline = fmt::format("{} redrawn; claims: {}", count_text(static_cast<long>(wanted.jobs.size()), "figure"),
                                  claims.empty() ? "none" : counts_text(claims));
  Section overview;
  overview.title = "Claims";
  overview.tables.push_back(claim_table(claims));
  const auto claim_columns = overview.tables.front().columns;
  document.sections.push_back(std::move(overview));
  std::vector<std::string> chapters;
  for (const auto& job : wanted.jobs)
    if (std::find(chapters.begin(), chapters.end(), job.chapter) == chapters.end()) chapters.push_back(job.chapter);
  for (const auto& chapter : chapters) {
    Document page = chapter_page(chapter, wanted.jobs, results, claims);
    page.warnings = notes_on(wanted.jobs, chapter, pool);
    document.files.emplace_back(chapter + ".html", report_html(page));
    for (auto& section : page.sections) {
      if (wanted.jobs.size() == 1)  // its claims are all of them, which stand above
        std::erase_if(section.tables, [&](const Table& t) { return t.columns == claim_columns; });
      document.sections.push_back(std::move(section));
    }
    for (auto& table : page.traces) document.traces.push_back(std::move(table));
    for (auto& file : page.files) document.files.push_back(std::move(file));
  }
  for (const auto& section : document.sections)  // one figure or two show what came out
    for (const auto& figure : section.figures)
      if (document.answer.size() < 2) document.answer.push_back(figure);
  document.warnings = notes_on(wanted.jobs, "", pool);
  if (arguments.has("--baseline"))
    answer.exit_code =
        tell_baseline(hold_against(arguments.text("--baseline"), claims, document.traces, wanted.others.empty()),
                      arguments.text("--baseline"), document);
  for (const auto& r : results)
    if (!r.failed.empty()) {
      document.warnings.push_back(r.failed);
      answer.exit_code = exit_code::numerics;
    }
  document.facts = to_json(Facts::object({{"claims", claim_facts(claims)}}));
  if (!arguments.quiet())
    for (const auto& c : claims) answer.text += claim_text(c);
  answer.folder = arguments.text("-o", "reproduce");
  answer.asides = {times_text(seconds_since(begin), wanted.jobs, results)};
  return answer;
}

std::vector<shape::Member> reproduce_shape() {
  using namespace shape;
  const Facts part = object("what one job says of it", {{"job", text("its name")},
                                                        {"holds", flag("within the tolerance")},
                                                        {"came_out", text("value")},
                                                        {"expected", text("value")},
                                                        {"remark", text("why it differs, where that is known")}});
  const Facts claim =
      object("a claim of the published work",
             {{"says", text("the claim")},
              {"outcome", choice("of all parts", {"agrees", "calibrated", "differs", "cannot be checked"})},
              {"reason", text("why it cannot be checked")},
              {"remark", text("what a reader should know")},
              {"parts", list("by job", part)}});
  return published({{"facts", object("what came out", {{"claims", named("by id", claim)}})}});
}

}  // namespace

Verb reproduce_verb() {
  return {
      "reproduce",
      "run the figures of a published work, and check its claims",
      reproduce_help,
      {{"what", "WHAT", "all (default), a chapter, a figure (fig2_15) or a claim (C2-07)", false, true},
       {"--from", "FOLDER", "where the jobs and claims.json lie; default: diagrams/ of the project", false, false},
       {"--full", "", "searches and studies as large as the jobs name under \"full\"; takes hours", false, false},
       {"--baseline", "FOLDER", "keep outcomes and curves there, or compare with those that are there", false, false},
       {"-o", "FOLDER", "where the results go; default: reproduce", false, false},
       options::allow()},
      reproduce,
      reproduce_shape};
}

}  // namespace hysteron
