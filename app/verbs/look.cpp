// Decides what discover and diagnose share: reading, searching with progress and Ctrl-C, and the folder of results.
// Does not decide what is claimed (discover/) nor how it is told (discover_page.h).
#include "app/verbs/look.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <sstream>

#include "app/cli/interrupt.h"
#include "app/cli/load.h"
#include "app/cli/progress.h"
#include "app/cli/publish.h"
#include "discover/placement/add.h"
#include "discover/search/check.h"
#include "engine/diagram/error.h"
#include "engine/diagram/stop.h"
#include "io/data/same_rows.h"
#include "report/pages/discover_facts.h"
#include "report/pages/discover_page.h"

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

/// What --json prints: the answer; all its numbers stand in result.json.
Facts short_answer(const Document& document, const Discovery& found, const Check* answer, const std::string& folder) {
  std::vector<std::string> effects;
  Facts::List ties;
  for (const auto& step : found.steps) {
    effects.push_back(step.winner.effect);
    std::vector<std::string> as_good = step.winner.same_effects;
    for (const auto& tie : step.ties) as_good.push_back(tie.effect);
    ties.push_back(as_good);
  }
  Facts facts = Facts::object({{"verdict", document.verdict},
                               {"headline", document.headline},
                               {"effects", effects},
                               {"ties", ties},
                               {"warnings", document.warnings},
                               {"result", folder + "/result.json"}});
  if (answer != nullptr) facts.set("check", check_facts(*answer));
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
                                           const std::vector<std::string>& free_paths, bool over) {
  const auto begun = Steady::now();
  const StopScope scope([&] { return (over || interrupted()) && Steady::now() - begun > to_inspect; });
  try {
    DataModel model(compile_file(diagram), std::make_shared<const DataSet>(data));
    return inspect_data(diagram, registry(), model, effects, free_paths);
  } catch (const Stopped&) {
    return std::nullopt;
  }
}

}  // namespace

int look(const std::string& verb, const Arguments& arguments) {
  const Effects effects = load_effects(arguments);
  DiscoverOptions settings;
  settings.only = wanted_effects(arguments, effects);
  settings.free_paths = arguments.list("--free");
  settings.numbers_are_exact = arguments.has("--exact");
  settings.max_steps = arguments.whole_number("--steps", settings.max_steps, 20);
  settings.threads = arguments.threads();
  const Diagram diagram = load_diagram(arguments);
  const ProgramPointer program = compile_file(diagram);
  const bool is_check = arguments.has("--check");
  const DataSet given = load_data(arguments, *program);
  need_moving_outputs(given, *program);
  DataSet data = is_check ? with_both_roles(given) : given;

  const DeferInterrupts defer;
  Progress progress(arguments.quiet());
  settings.progress = [&](const std::string& what, double done) { progress.show(done, what); };
  const auto begun = Steady::now();
  const std::chrono::duration<double> within{arguments.seconds("--within", std::numeric_limits<double>::infinity())};
  if (!(within.count() > 0))
    fail("bad_command_line", "--within", fmt::format("\"{}\" leaves no time", arguments.text("--within")),
         "write a time such as --within=\"2 min\", or leave it out");
  if (is_check && arguments.has("--within"))
    fail("bad_command_line", "--within", "a check says that nothing is new only once everything was tried",
         "leave out --within, or --check");
  const auto past = [&](double share) { return Steady::now() - begun > share * within; };
  settings.enough = [&] { return past(DiscoverOptions::to_search); };
  settings.stop = [&] { return interrupted() || past(1); };
  Discovery found;
  std::optional<Check> answer;
  const auto searched = [&] {
    const StopScope until_interrupted(interrupted);
    if (is_check) {
      answer = check(diagram, data, registry(), effects, settings);
      found = answer->discovery;
    } else {
      found = verb == "discover" ? discover(diagram, data, registry(), effects, settings)
                                 : diagnose(diagram, data, registry(), effects, settings);
    }
  };
  try {
    with_lines_of(diagram, searched);
  } catch (const Stopped&) {
    throw_nothing_found();
  }
  if (!is_check) tell_held_effects(diagram, settings.free_paths, found.warnings);
  progress.clear();
  data = as_found(std::move(data), found);
  const bool stopped = interrupted();
  if (stopped) answer.reset();  // nothing is known to be explained before everything was tried
  const auto inspected =
      inspected_against(found.base_diagram, data, effects, settings.free_paths, stopped || found.broken_off);
  const std::string folder = result_folder(arguments, verb);
  Document document =
      discovery_document(verb, found, data, registry(), inspected.value_or(Inspected{}),
                         {arguments.text("diagram"), arguments.text("--data"), folder}, answer ? &*answer : nullptr);
  if (!inspected)
    document.warnings.emplace_back(
        "There was no time to inspect the data themselves: run \"hysteron inspect\" on them.");
  for (auto& warning : warnings_of_same_rows(given)) document.warnings.push_back(std::move(warning));
  if (stopped) document.warnings.insert(document.warnings.begin(), "Interrupted: this is what was found until then.");
  if (found.broken_off && !stopped)
    document.warnings.insert(
        document.warnings.begin(),
        fmt::format("Ended by --within {}: this is what was found until then; with more time there "
                    "may be more, or other names.",
                    arguments.text("--within")));
  if (arguments.has("--json")) {
    write_results(folder, document);
    fmt::print("{}\n", json_text(short_answer(document, found, answer ? &*answer : nullptr, folder)));
  } else {
    publish(arguments, folder, document);
  }
  if (stopped) throw Interrupted("interrupted; what was found so far is in " + folder);
  return answer && !answer->explained ? exit_code::no : exit_code::done;
}

std::vector<OptionSpec> look_options() {
  return {options::diagram(),
          options::data(true),
          {"--only", "EFFECT", "consider only this effect (and others: with commas, or further --only)", false, true},
          {"--json", "", "print the answer as JSON, for programs", false, false},
          {"--free", "PATH", "this parameter may be refitted too, e.g. stage.gain", false, true},
          {"--exact", "", "the numbers of the diagram that are not free are exact: other values are not tried", false,
           false},
          options::effects(),
          options::threads("candidates"),
          {"--within", "TIME", "end after so long with what was found by then, e.g. \"2 min\"", false, false},
          options::output_folder(),
          options::set(),
          options::choose(),
          options::allow()};
}

}  // namespace hysteron
