// The verb draw: the picture of a diagram.
// Does not lay out (draw/), nor simulate.
#include <cmath>

#include "app/cli/answer.h"
#include "app/cli/load.h"
#include "app/cli/shape.h"
#include "app/cli/target.h"
#include "draw/drawing.h"
#include "engine/diagram/error.h"
#include "io/diagram/layout_file.h"

namespace hysteron {
namespace {

constexpr char draw_help[] =
    "Answers: what does this diagram look like. Signals flow from left to right, feedback returns below;\n"
    "values stand below the blocks, units at the wires. A choice shows its candidate in use. Blocks that were moved by\n"
    "hand (hysteron studio) stand where they were put, as stage.layout.json beside stage.json says.\n\n"
    "Examples:\n"
    "  hysteron draw stage.json\n"
    "  hysteron draw loop.json -o figures/loop.svg --depth 1\n"
    "  hysteron draw loop.json --choose compensator=none --set controller.kp=\"0.5 V/um\"\n\n"
    "Writes one SVG file, named after the diagram, which every browser and most editors open. Needs the program\n"
    "dot of Graphviz.\n"
    "Exit codes: 0 done, 2 the diagram is wrong or Graphviz is missing.";

Answer draw_diagram(const Arguments& arguments, const Watch& watch) {
  const Diagram diagram = load_diagram(arguments, watch);
  const ProgramPointer program = compile_file(diagram);
  const double depth = arguments.number("--depth", 0);
  if (depth < 0 || depth != std::floor(depth) || depth > 100)
    fail("bad_command_line", "--depth", "\"" + arguments.text("--depth") + "\" is no number of levels",
         "write a whole number, e.g. --depth 1");
  const std::string file = arguments.text("-o", stem_of(arguments.text("diagram")) + ".svg");
  need_ending("-o", file, {".svg"}, "an SVG file, e.g. -o stage.svg");
  Answer answer;
  answer.files.push_back({file, diagram_svg(diagram, *program, registry(),
                                            {static_cast<int>(depth), {}, read_layout(arguments.text("diagram"))})});
  answer.closing = "wrote " + file + "\n";
  answer.facts = Facts::object({{"picture", file}});
  return answer;
}

std::vector<shape::Member> draw_shape() { return {{"picture", shape::text("the SVG file")}}; }

}  // namespace

Verb draw_verb() {
  return {"draw",
          "a picture of a diagram",
          draw_help,
          {options::diagram(),
           {"-o", "FILE.svg", "the picture; default: named after the diagram, in this folder", false, false},
           {"--depth", "N", "open nested diagrams, N levels deep (default 0: each is one box)", false, false},
           options::set(),
           options::choose(),
           options::allow()},
          draw_diagram,
          draw_shape};
}

}  // namespace hysteron
