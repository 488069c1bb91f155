// The verb remove: takes an effect out of a diagram again, so that nothing of it is left.
// Removes only what was added as an effect, never a block of the user's own.
#include "app/cli/answer.h"
#include "app/cli/load.h"
#include "app/cli/rewrite.h"
#include "app/cli/shape.h"
#include "app/cli/target.h"
#include "discover/placement/add.h"
#include "io/diagram/diagram_file.h"
#include "io/diagram/text_diff.h"

namespace hysteron {
namespace {

constexpr char remove_help[] =
    "Answers: what does my diagram look like without this effect. Undoes \"hysteron add\" exactly.\n\n"
    "Examples:\n"
    "  hysteron remove creep next.json                       print the change only\n"
    "  hysteron remove drive_creep next.json -o stage.json   by the name of its block\n\n"
    "Prints the difference of the diagram file; writes it with -o.\n"
    "Exit codes: 0 done, 2 the effect is not there, or stands there twice.";

Answer remove(const Arguments& arguments, const Watch& watch) {
  const Diagram diagram = load_diagram(arguments, watch);
  if (arguments.has("-o")) check_diagram_target("-o", arguments.text("-o"), diagram);
  const Diagram without = remove_effect(diagram, registry(), arguments.text("effect"));
  Answer answer;
  answer.text = text_diff(diagram_text(diagram), diagram_text(without));
  answer.facts = Facts::object({{"effect", arguments.text("effect")}, {"change", answer.text}});
  rewrite(answer, arguments, without, {});
  return answer;
}

std::vector<shape::Member> remove_shape() {
  return {{"effect", shape::text("the effect or its block, as it was named")},
          {"change", shape::text("lines of the diagram file, as diff -u has them")}};
}

}  // namespace

Verb remove_verb() {
  return {"remove",
          "take an effect out of a diagram",
          remove_help,
          {{"effect", "EFFECT", "the effect (\"creep\"), or the name of its block (\"drive_creep\")", true, false},
           options::diagram(),
           options::output_file(),
           options::allow()},
          remove,
          remove_shape};
}

}  // namespace hysteron
