// The verb add: puts an effect into a diagram, as a choice that can be switched off, and shows the change.
// Does not fit it and does not judge whether it is missing.
#include "discover/placement/add.h"

#include <fmt/format.h>

#include <filesystem>
#include <optional>

#include "app/cli/answer.h"
#include "app/cli/load.h"
#include "app/cli/rewrite.h"
#include "app/cli/shape.h"
#include "app/cli/target.h"
#include "app/cli/terminal.h"
#include "discover/placement/excitation.h"
#include "engine/diagram/error.h"
#include "io/diagram/diagram_file.h"
#include "io/diagram/text_diff.h"

namespace hysteron {
namespace {

constexpr char add_help[] =
    "Answers: what does my diagram look like with this effect in it. The effect becomes a block on one wire,\n"
    "written as a choice between \"off\" and \"on\"; the readers of that wire read it instead.\n\n"
    "Examples:\n"
    "  hysteron add creep stage.json                         print the change only\n"
    "  hysteron add creep stage.json --at drive -o next.json\n"
    "  hysteron add hysteresis stage.json --data lab.csv -o next.json   start values for this drive\n"
    "  hysteron run next.json --choose drive_creep=off       the model without it\n\n"
    "--at takes a signal (\"drive\": behind it, for all its readers) or an input port (\"stage.in\": just before\n"
    "it), also inside diagrams (\"stage/actuator.u\"). Without --at the first place where the effect may enter\n"
    "is taken, and said. \"hysteron fit\" then finds its parameters; \"hysteron effects\" lists the effects.\n\n"
    "Prints the difference of the diagram file; writes it with -o.\n"
    "Exit codes: 0 done, 2 the diagram, the effect or the place is wrong.";

Answer add(const Arguments& arguments, const Watch& watch) {
  const Effects library = load_effects(arguments);
  const Effect& effect = library.get(arguments.text("effect"));
  const Diagram diagram = load_diagram(arguments, watch);
  if (arguments.has("-o")) check_diagram_target("-o", arguments.text("-o"), diagram);
  const ProgramPointer program = compile_file(diagram);
  std::optional<DataSet> data;
  std::optional<Excitation> excitation;
  if (arguments.has("--data")) {
    data = load_data(arguments, *program);
    const Place place = place_for(effect, diagram, registry(), arguments.text("--at"), &*data);
    excitation = circumstances_at(diagram, registry(), *data, place);
  }
  const Added added = add_effect(diagram, registry(), effect, arguments.text("--at"),
                                 excitation ? &*excitation : nullptr, data ? &*data : nullptr);
  refuse_new_loop(*program, *compile(added.diagram, registry()), added.at);  // what is written must run

  Answer answer;
  const std::string change = text_diff(diagram_text(diagram), diagram_text(added.diagram));
  answer.text = change;
  if (!arguments.quiet())
    for (const auto& remark : added.remarks) answer.text += wrapped("note: " + remark);
  rewrite(answer, arguments, added.diagram, added.nested);
  if (!arguments.quiet()) answer.closing += fmt::format("{} enters at {} as {}\n", effect.id, added.at, added.name);
  answer.warnings = added.remarks;
  answer.facts = Facts::object({{"effect", effect.id}, {"at", added.at}, {"block", added.name}, {"change", change}});
  return answer;
}

std::vector<shape::Member> add_shape() {
  return {{"effect", shape::text("as \"hysteron effects\" names it")},
          {"at", shape::text("where it enters")},
          {"block", shape::text("the name of its block")},
          {"change", shape::text("lines of the diagram file, as diff -u has them")}};
}

}  // namespace

Verb add_verb() {
  return {"add",
          "put an effect into a diagram",
          add_help,
          {{"effect", "EFFECT", "the effect, as in \"hysteron effects\"", true, false},
           options::diagram(),
           {"--at", "SIGNAL", "where it enters: a signal, an input port, or what is read of one (outputs.NAME)", false,
            false},
           options::data(false),
           options::effects(),
           options::output_file(),
           options::allow()},
          add,
          add_shape};
}

}  // namespace hysteron
