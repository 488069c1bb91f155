// Decides what discover and diagnose share: reading, searching with progress and Ctrl-C, and the folder of results.
// Does not decide what is claimed (discover/) nor how it is told (discover_page.h).
#include "app/verbs/look.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <limits>
#include <sstream>
#include <utility>

#include "app/cli/interrupt.h"
#include "app/cli/load.h"
#include "app/cli/target.h"
#include "discover/placement/add.h"
#include "discover/selection/check.h"
#include "discover/selection/discover.h"
#include "engine/diagram/error.h"
#include "engine/diagram/stop.h"
#include "io/data/same_rows.h"
#include "io/files/atomic_file.h"
#include "io/files/shell_word.h"
#include "io/json/value_text.h"
#include "report/pages/discover_facts.h"
#include "report/pages/discover_page.h"
#include "report/pages/drive_file.h"
#include "report/pages/model_table.h"

namespace hysteron {
namespace {

/// Effect ids of --only, one each or several with commas between them, checked before anything is computed.
std::vector<std::string> wanted_effects(const Arguments& arguments, const Effects& effects) {
  std::vector<std::string> ids;
  for (const auto& some : arguments.list("--only")) {
    if (some.find_first_not_of(" ,") == std::string::npos)
      fail("bad_command_line", "--only", "it names no effect",
           "name one, as in --only creep (\"hysteron effects\" lists them), or leave it out");
    std::istringstream list(some);
    for (std::string id; std::getline(list, id, ',');) ids.push_back(effects.get(id).id);
  }
  return ids;
}

/// What --json prints beside the verdict; all numbers stand in result.json.
Facts short_answer(const Discovery& found, const std::optional<Check>& check) {
  std::vector<std::string> effects;
  Facts::List ties;
  for (const auto& step : found.steps) {
    effects.push_back(step.winner.effect);
    std::vector<std::string> as_good = step.winner.same_effects;
    for (const auto& tie : step.ties) as_good.push_back(tie.effect);
    ties.push_back(as_good);
  }
  Facts facts = Facts::object({{"effects", effects}, {"ties", ties}});
  if (check) facts.set("check", check_facts(*check));
  return facts;
}

/// Numbers of an effect that stands in the diagram are the user's, found or guessed.
void tell_held_effects(const Diagram& diagram, const std::vector<std::string>& free,
                       std::vector<std::string>& warnings) {
  for (const auto& [name, effect] : effects_in(diagram)) {
    const std::string path = name;
    const auto is_of_it = [&](const std::string& f) { return f == path || f.starts_with(path + "."); };
    if (std::any_of(free.begin(), free.end(), is_of_it)) continue;
    warnings.push_back(
        fmt::format("{} stands in the diagram ({}) and is held as it is written there. If its numbers were not fitted "
                    "yet, run \"hysteron fit\" first, or name them with --free {}",
                    effect, path, path));
  }
}

using Steady = std::chrono::steady_clock;

/// So long the inspection of the data may take where the time is over: of recordings that are not long it is there.
constexpr std::chrono::milliseconds to_inspect{300};

/// Judged against the user's own diagram with what was free in it fitted: a wrong gain is no fault of the data. None
/// where the time was `over` before.
std::optional<Inspected> inspected_against(const Diagram& diagram, const DataSet& data, const Effects& effects,
                                           const std::vector<std::string>& free_paths, bool over, const Watch& watch) {
  const auto begun = Steady::now();
  const StopScope scope([&] { return (over || watch.stop()) && Steady::now() - begun > to_inspect; });
  try {
    DataModel model(compile_file(diagram), std::make_shared<const DataSet>(data));
    return inspect_data(diagram, registry(), model, effects, free_paths);
  } catch (const Stopped&) {
    return std::nullopt;
  }
}

/// A file that an option asks for beside the folder of results.
struct Beside {
  std::string option, ending, form;  ///< "--experiment", ".csv", "a CSV"
  std::string example, holds;        ///< "drive.csv", "experiment": in words
  std::string_view head;             ///< with which a former one begins
};

/// Where it goes, "" = nowhere. A recording, or any other file, is never written over; what cannot be written is told
/// before hours of search.
std::string file_beside(const Arguments& arguments, const Beside& what) {
  const std::string& option = what.option;
  if (!arguments.has(option)) return "";
  const std::string file = arguments.text(option);
  need_ending(option, file, {what.ending}, fmt::format("{}, e.g. {} {}", what.form, option, what.example));
  std::error_code none;
  const auto status = std::filesystem::status(file, none);
  if (std::filesystem::is_directory(status))
    fail("cannot_write", option, file + " is a folder",
         fmt::format("name a file in it, e.g. {}/{}", file, what.example));
  const auto folder = std::filesystem::path(file).parent_path();
  if (!folder.empty() && !std::filesystem::is_directory(folder, none))
    fail("cannot_write", option, fmt::format("there is no folder {}", folder.string()),
         "make it, or name a file in another one");
  if (access(folder.empty() ? "." : folder.c_str(), W_OK) != 0)
    fail("cannot_write", option,
         fmt::format("nothing can be written into {}", folder.empty() ? "this folder" : folder.string()),
         "name a file in a folder of yours");
  if (std::filesystem::is_regular_file(status) && !read_file(file).starts_with(what.head))
    fail("file_in_use", option, fmt::format("{} is there and holds no {}, so it is not written over", file, what.holds),
         fmt::format("name another file, e.g. {}, or remove this one", what.example));
  return file;
}

/// The experiment that is asked for, as a file; or that there is none.
void give_experiment(Answer& answer, const Discovery& found, const std::string& file) {
  if (file.empty()) return;
  const auto& e = found.experiment;
  if (!e || !e->drive) {
    answer.closing = fmt::format("No experiment is asked for: {} was not written.\n", file);
    return;
  }
  answer.files.push_back({file, drive_file_text(*e)});
  answer.closing = fmt::format("wrote {}: the experiment \"{}\". Measure {}\n", file, e->word, what_to_measure(*e));
  const auto faster = faster_than_recorded(*e);
  for (const auto& word : faster)
    answer.closing += fmt::format("note: {}. Check that drive and machine can bear it.\n", word);
  answer.facts.set("experiment", Facts::object({{"file", file},
                                                {"word", e->word},
                                                {"what_to_do", e->text},
                                                {"tells", e->between},
                                                {"separation", e->separation},
                                                {"measure", e->drive->outputs},
                                                {"rows", e->drive->t.size()},
                                                {"duration", e->drive->t.back() - e->drive->t.front()},
                                                {"shortest_step", e->drive->shortest_step},
                                                {"faster_than_recorded", faster}}));
}

/// What is looked for, in what, and for how long.
struct Wish {
  Effects effects;
  DiscoverOptions settings{};
  Diagram diagram{};
  DataSet given{};
  bool is_check = false;
  std::chrono::duration<double> within{};  ///< the time that --within leaves
};

Wish read_wish(const Arguments& arguments, const Watch& watch) {
  Wish wish{load_effects(arguments)};
  auto& settings = wish.settings;
  settings.only = wanted_effects(arguments, wish.effects);
  settings.free_paths = arguments.list("--free");
  settings.numbers_are_exact = arguments.has("--exact");
  settings.keeps_table = arguments.has("--keep-table");
  settings.max_steps = arguments.whole_number("--steps", settings.max_steps, 20);
  settings.threads = arguments.threads();
  wish.diagram = load_diagram(arguments, watch);
  const ProgramPointer program = compile_file(wish.diagram);
  wish.is_check = arguments.has("--check");
  wish.given = load_data(arguments, *program);
  need_moving_outputs(wish.given, *program);
  wish.within = std::chrono::duration<double>(arguments.seconds("--within", std::numeric_limits<double>::infinity()));
  if (!(wish.within.count() > 0))
    fail("bad_command_line", "--within", fmt::format("\"{}\" leaves no time", arguments.text("--within")),
         "write a time such as --within=\"2 min\", or leave it out");
  if (wish.is_check && arguments.has("--within"))
    fail("bad_command_line", "--within", "a check can say that nothing is new only after everything was tried",
         "leave out --within, or --check");
  return wish;
}

struct Looked {
  Discovery found;
  std::optional<Check> check{};
};

/// Ended by whoever watches, or when the time is over, with what was found by then.
Looked search(const std::string& verb, Wish& wish, const DataSet& data, const Watch& watch) {
  auto& settings = wish.settings;
  const auto begun = Steady::now();
  const auto past = [&, begun](double share) { return Steady::now() - begun > share * wish.within; };
  settings.progress = [&](const std::string& what, double done) { watch.show(done, what); };
  settings.spent = [&, begun] { return (Steady::now() - begun) / (DiscoverOptions::to_search * wish.within); };
  settings.stop = [&, past] { return watch.stop() || past(1); };
  Looked looked;
  try {
    with_lines_of(wish.diagram, [&] {
      const StopScope until_interrupted(watch.stop);
      if (wish.is_check) {
        looked.check = check(wish.diagram, data, registry(), wish.effects, settings);
        looked.found = looked.check->discovery;
      } else {
        looked.found = verb == "discover" ? discover(wish.diagram, data, registry(), wish.effects, settings)
                                          : diagnose(wish.diagram, data, registry(), wish.effects, settings);
      }
    });
  } catch (const Stopped&) {
    throw_nothing_found();
  }
  return looked;
}

/// What the reader must know of how it came to its end, first.
void tell_end(Document& document, const Arguments& arguments, bool stopped, bool broken_off) {
  if (stopped) document.warnings.insert(document.warnings.begin(), "Interrupted: this is what was found until then.");
  if (broken_off && !stopped)
    document.warnings.insert(
        document.warnings.begin(),
        fmt::format("Ended by --within {}: this is what was found until then; with more time there "
                    "may be more, or other names.",
                    arguments.text("--within")));
}

}  // namespace

Answer look(const std::string& verb, const Arguments& arguments, const Watch& watch) {
  const std::string drive =
      file_beside(arguments, {"--experiment", ".csv", "a CSV", "drive.csv", "experiment", drive_file_head});
  const std::string table = file_beside(
      arguments, {"--keep-table", ".json", "a JSON file", "table.json", "table of models", model_table_head});
  Wish wish = read_wish(arguments, watch);
  auto same_rows = warnings_of_same_rows(wish.given);
  DataSet data = std::exchange(wish.given, {});
  if (wish.is_check) data = with_both_roles(std::move(data));
  watch.keep();
  auto [found, check] = search(verb, wish, data, watch);
  if (!wish.is_check) tell_held_effects(wish.diagram, wish.settings.free_paths, found.warnings);
  data = as_found(std::move(data), found);
  const bool stopped = watch.stop();
  if (stopped) check.reset();  // nothing is known to be explained before everything was tried
  const auto inspected = inspected_against(found.base_diagram, data, wish.effects, wish.settings.free_paths,
                                           stopped || found.broken_off, watch);
  Answer answer;
  if (!table.empty()) answer.files.push_back({table, model_table_text(found)});
  answer.folder = result_folder(arguments, verb);
  Document& document = answer.document;
  document = discovery_document(verb, found, data, registry(), inspected.value_or(Inspected{}),
                                {arguments.text("diagram"), arguments.text("--data"), answer.folder},
                                check ? &*check : nullptr);
  if (!inspected)
    document.warnings.push_back(
        fmt::format("There was no time to inspect the recordings; do so: hysteron inspect {} --diagram {}",
                    shell_word(arguments.text("--data")), shell_word(arguments.text("diagram"))));
  for (auto& warning : same_rows) document.warnings.push_back(std::move(warning));
  tell_end(document, arguments, stopped, found.broken_off);
  answer.facts = short_answer(found, check);
  give_experiment(answer, found, drive);
  answer.exit_code = check && !check->explained ? exit_code::no : exit_code::done;
  if (!stopped) return answer;
  answer.exit_code = exit_code::interrupted;
  answer.interrupted = "interrupted; what was found so far is in " + answer.folder;
  return answer;
}

namespace {

Facts experiment_shape() {
  return shape::object(
      "what --experiment wrote",
      {{"file", shape::text("the CSV: t, and a column for each input")},
       {"word", shape::text("which experiment of the menu it is")},
       {"what_to_do", shape::text("in words")},
       {"tells", shape::text("which effects it tells apart")},
       {"separation", shape::number("rms difference of their models over the noise")},
       {"measure", shape::texts("outputs to be measured")},
       {"rows", shape::whole("of the file")},
       {"duration", shape::number("[s]")},
       {"shortest_step", shape::number("[s] between rows that are to be measured")},
       {"faster_than_recorded", shape::texts("inputs for which nothing slower tells, and by how much")}});
}

}  // namespace

std::vector<shape::Member> look_shape() {
  const Facts check =
      shape::object("the answer to --check", {{"explained", shape::flag("by the model as it stands")},
                                              {"parameters_moved", shape::flag("other values would do")},
                                              {"named", shape::texts("what is new")}});
  return shape::published({{"effects", shape::texts("found, in their order")},
                           {"ties", shape::list("of each step", shape::texts("effects that explain it as well"))},
                           {"check", check, shape::sometimes},
                           {"experiment", experiment_shape(), shape::sometimes}});
}
std::vector<OptionSpec> look_options() {
  return {options::diagram(),
          options::data(true),
          {"--only", "EFFECT", "consider only this effect (and others: with commas, or further --only)", false, true},
          {"--free", "PATH", "this parameter may be refitted too, e.g. stage.gain", false, true},
          {"--exact", "", "take the parameters that are not free as exact: other values are not tried", false, false},
          options::effects(),
          options::threads("candidates"),
          {"--within", "TIME", "end after so long with what was found by then, e.g. \"2 min\"", false, false},
          {"--experiment", "FILE.csv",
           "write the experiment that is asked for, if any, as rows for a generator or controller", false, false},
          {"--keep-table", "FILE.json", "write all models that were fitted, for scores of your own", false, false},
          options::output_folder(),
          options::set(),
          options::choose(),
          options::allow()};
}

}  // namespace hysteron
