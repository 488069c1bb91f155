// Decides what discover and diagnose share: reading, searching with progress and Ctrl-C, and the folder of results.
// Does not decide what is claimed (discover/) nor how it is told (discover_page.h).
#include "app/look.h"

#include <fmt/format.h>

#include "app/discover_page.h"
#include "app/interrupt.h"
#include "app/load.h"
#include "app/progress.h"
#include "app/publish.h"
#include "discover/discover.h"
#include "engine/error.h"

namespace hysteron {
namespace {

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

}  // namespace

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
  Document document =
      discovery_document(verb, found, data, {arguments.text("diagram"), arguments.text("--data"), folder});
  if (stopped) document.warnings.insert(document.warnings.begin(), "Interrupted: this is what was found until then.");
  publish(arguments, folder, document);
  if (stopped) throw Interrupted("interrupted; what was found so far is in " + folder);
  return arguments.has("--check") && found.verdict != Verdict::adequate ? exit_code::no : exit_code::done;
}

std::vector<OptionSpec> look_options() {
  return {options::diagram(),
          options::data(true),
          {"--only", "EFFECT", "consider only this effect (and those of further --only)", false, true},
          {"--free", "PATH", "this parameter may be refitted too, e.g. stage.gain", false, true},
          options::output_folder(),
          options::set(),
          options::choose(),
          options::allow()};
}

}  // namespace hysteron
