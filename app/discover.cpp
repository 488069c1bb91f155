// The verb discover: the whole loop - compare, name the missing effect, add it, fit it - until only noise is left.
// Does not decide what is claimed (discover/) nor how it is told (discover_page.h).
#include "discover/discover.h"

#include <fmt/format.h>

#include "app/discover_page.h"
#include "app/interrupt.h"
#include "app/load.h"
#include "app/progress.h"
#include "app/publish.h"
#include "app/verb.h"
#include "engine/error.h"

namespace hysteron {
namespace {

constexpr char discover_help[] =
    "Answers: what does my model lack, and how much better is it with that. Tries every effect that the data can\n"
    "show at every place where it may enter, fits it on the train recordings, judges it on the others, adds what is\n"
    "certain, and goes on until only noise is left or nothing known helps.\n\n"
    "The verdict is one of\n"
    "  adequate             no effect improves other recordings by more than chance, and no structure remains\n"
    "  missing_effect       named, with evidence\n"
    "  not_distinguishable  something is missing; several effects explain it equally well; an experiment would tell\n"
    "  unexplained          structure remains that no known effect takes away\n\n"
    "Examples:\n"
    "  hysteron discover stage.json --data dataset.json\n"
    "  hysteron discover stage.json --data lab.csv -o out --steps 1\n"
    "  hysteron discover stage.json --data dataset.json --only creep --only hysteresis\n"
    "  hysteron discover stage.json --data dataset.json --check     exit code 0 only if the model is adequate\n\n"
    "Writes into the folder: result.json (every decision with its numbers), traces/*.csv, report.html, and the\n"
    "diagram of each step (step1_creep.json ... final.json).\n"
    "Ctrl-C ends with the steps found so far.\n"
    "Exit codes: 0 done, 1 with --check: any other verdict than adequate, 2 wrong input, 3 numerics failed,\n"
    "            130 interrupted.";

constexpr char diagnose_help[] =
    "Answers: WHICH physical effect is missing, with evidence, or an honest \"cannot tell\".\n"
    "This is the first step of \"hysteron discover\": everything is tried, one effect is named, none is piled on it.\n\n"
    "Examples:\n"
    "  hysteron diagnose stage.json --data dataset.json\n"
    "  hysteron diagnose stage.json --data lab.csv --free gain --only creep\n\n"
    "Writes into the folder: result.json, traces/*.csv, report.html, and the diagram with the effect named.\n"
    "Exit codes: 0 done, whatever was found; 2 wrong input, 3 numerics failed, 130 interrupted.";

/// Effect ids of --only, checked before anything is computed.
std::vector<std::string> wanted_effects(const Arguments& arguments, const Effects& effects) {
  for (const auto& id : arguments.list("--only")) effects.get(id);
  return arguments.list("--only");
}

int max_steps(const Arguments& arguments) {
  const double steps = arguments.number("--steps", DiscoverOptions{}.max_steps);
  if (steps < 1 || steps > 20 || steps != static_cast<int>(steps))
    fail("bad_command_line", "--steps", "the number of steps is not a whole number from 1 to 20", "write --steps 2");
  return static_cast<int>(steps);
}

int look(const std::string& verb, const Arguments& arguments) {
  const Effects effects = all_effects();
  DiscoverOptions settings;
  settings.only = wanted_effects(arguments, effects);
  settings.free_paths = arguments.list("--free");
  settings.max_steps = max_steps(arguments);
  const Diagram diagram = load_diagram(arguments);
  const ProgramPointer program = compile_file(diagram);
  const DataSet data = load_data(arguments, *program);

  const DeferInterrupts defer;
  Progress progress(arguments.quiet());
  settings.progress = [&](const std::string& what, double done) { progress.show(done, what); };
  settings.stop = [] { return interrupted(); };
  Discovery found;
  with_lines_of(diagram, [&] {
    found = verb == "discover" ? discover(diagram, data, registry(), effects, settings)
                               : diagnose(diagram, data, registry(), effects, settings);
  });
  progress.clear();
  const bool stopped = interrupted();
  const std::string folder = result_folder(arguments, verb);
  Document document = discovery_document(verb, found, data, {arguments.text("diagram"), arguments.text("--data"), folder});
  if (stopped) document.warnings.insert(document.warnings.begin(), "Interrupted: this is what was found until then.");
  publish(arguments, folder, document);
  if (stopped) throw Interrupted("interrupted; what was found so far is in " + folder);
  return arguments.has("--check") && found.verdict != Verdict::adequate ? exit_code::no : exit_code::done;
}

int act_discover(const Arguments& arguments) { return look("discover", arguments); }
int act_diagnose(const Arguments& arguments) { return look("diagnose", arguments); }

std::vector<OptionSpec> shared_options() {
  return {options::diagram(),
          options::data(true),
          {"--only", "EFFECT", "consider only this effect (and those of further --only)", false, true},
          {"--free", "PATH", "this parameter may be refitted too, e.g. stage.gain", false, true},
          options::output_folder(),
          options::set(),
          options::choose(),
          options::allow()};
}

}  // namespace

Verb discover_verb() {
  auto list = shared_options();
  list.push_back({"--steps", "N", "add at most so many effects (default 3)", false, false});
  list.push_back({"--check", "", "exit with 1 unless the model is adequate", false, false});
  return {"discover", "the whole loop, step by step, until only noise is left", discover_help, list, act_discover};
}

Verb diagnose_verb() {
  return {"diagnose", "which physical effect is missing, with evidence", diagnose_help, shared_options(), act_diagnose};
}

}  // namespace hysteron
