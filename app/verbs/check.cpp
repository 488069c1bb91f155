// The verb check: is the file right. All problems of all stages are told together.
// Does not simulate.
#include <fmt/format.h>

#include <algorithm>

#include "app/cli/answer.h"
#include "app/cli/load.h"
#include "app/cli/shape.h"
#include "app/exports/check_fmu.h"
#include "report/pages/numbers.h"

namespace hysteron {
namespace {

constexpr char check_help[] =
    "Answers: is this file right - syntax, names, wires, units, order - and, with --data,\n"
    "do the recordings fit it. Nothing is simulated and nothing is written.\n\n"
    "Examples:\n"
    "  hysteron check stage.json\n"
    "  hysteron check stage.json --data lab.csv\n"
    "  hysteron check stage.json --choose compensator=none\n\n"
    "Of an FMU (stage.fmu) the archive and the model description are looked through; with --allow stage.fmu,\n"
    "which says that you trust it, it is loaded, too, and taken through its initialization and some steps.\n\n"
    "Prints one line with counts if all is well, else every problem: file, line, place, what is wrong and\n"
    "the cure. Where names or units are wrong, the rest is looked at without these blocks.\n"
    "Exit codes: 0 the file is right, 2 it is not.";

Facts diagram_facts(const Program& program, long free) {
  return Facts::object({{"blocks", program.blocks.size()},
                        {"inputs", program.input_names},
                        {"outputs", program.output_names},
                        {"continuous_states", program.n_x},
                        {"numbers", program.parameters.size()},
                        {"free", free},
                        {"blocks_with_memory", program.memory_blocks.size()}});
}

Answer check(const Arguments& arguments, const Watch& watch) {
  if (arguments.text("diagram").ends_with(".fmu")) return check_fmu(arguments);
  const Diagram diagram = load_diagram(arguments, watch);
  const ProgramPointer program = compile_telling_all(diagram);
  const auto free =
      std::count_if(program->parameters.begin(), program->parameters.end(), [](const auto& p) { return p.free; });
  Answer answer;
  answer.text = fmt::format("{}: ok: {}, {}, {}, {}, {} ({} free), {}\n", arguments.text("diagram"),
                            count_text(static_cast<long>(program->blocks.size()), "block"),
                            count_text(static_cast<long>(program->input_names.size()), "input"),
                            count_text(static_cast<long>(program->output_names.size()), "output"),
                            count_text(program->n_x, "continuous state"),
                            count_text(static_cast<long>(program->parameters.size()), "number"), free,
                            count_text(static_cast<long>(program->memory_blocks.size()), "block") + " with memory");
  answer.facts = Facts::object({{"diagram", diagram_facts(*program, free)}});
  if (!arguments.has("--data")) return answer;
  DataSet data;
  behind(answer.text, [&] { data = load_data(arguments, *program); });
  long rows = 0;
  for (const auto& recording : data.recordings) rows += static_cast<long>(recording.count_judged());
  answer.text +=
      fmt::format("{}: ok: {}, {} judged\n", arguments.text("--data"),
                  count_text(static_cast<long>(data.recordings.size()), "recording"), count_text(rows, "row"));
  for (const auto& remark : data.remarks) answer.text += fmt::format("  {}\n", remark);
  answer.warnings = data.remarks;
  answer.facts.set("data", Facts::object({{"recordings", data.recordings.size()}, {"rows", rows}}));
  return answer;
}

std::vector<shape::Member> check_shape() {
  const Facts diagram = shape::object("what stands in the diagram", {{"blocks", shape::whole("how many")},
                                                                     {"inputs", shape::texts("their names")},
                                                                     {"outputs", shape::texts("their names")},
                                                                     {"continuous_states", shape::whole("how many")},
                                                                     {"numbers", shape::whole("how many parameters")},
                                                                     {"free", shape::whole("of these, for a fit")},
                                                                     {"blocks_with_memory", shape::whole("how many")}});
  const Facts data = shape::object("what stands in the recordings", {{"recordings", shape::whole("how many")},
                                                                     {"rows", shape::whole("judged, of all")}});
  return {{"diagram", diagram, shape::sometimes}, {"data", data, shape::sometimes}, fmu_shape()};
}

}  // namespace

Verb check_verb() {
  return {"check",    "is a diagram (and its data) right",
          check_help, {options::diagram(), options::data(false), options::set(), options::choose(), options::allow()},
          check,      check_shape};
}

}  // namespace hysteron
