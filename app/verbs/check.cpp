// The verb check: is the file right. All problems of the first stage that fails are told together.
// Does not simulate.
#include <fmt/format.h>

#include <algorithm>

#include "app/cli/load.h"
#include "app/cli/verb.h"
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
    "Prints one line with counts if all is well, else every problem of the first stage that fails:\n"
    "file, line, place, what is wrong and the cure.\n"
    "Exit codes: 0 the file is right, 2 it is not.";

int check(const Arguments& arguments) {
  const Diagram diagram = load_diagram(arguments);
  const ProgramPointer program = compile_file(diagram);
  const auto free =
      std::count_if(program->parameters.begin(), program->parameters.end(), [](const auto& p) { return p.free; });
  fmt::print("{}: ok: {}, {}, {}, {}, {} ({} free), {}\n", arguments.text("diagram"),
             count_text(static_cast<long>(program->blocks.size()), "block"),
             count_text(static_cast<long>(program->input_names.size()), "input"),
             count_text(static_cast<long>(program->output_names.size()), "output"),
             count_text(program->n_x, "continuous state"),
             count_text(static_cast<long>(program->parameters.size()), "number"), free,
             count_text(static_cast<long>(program->memory_blocks.size()), "block") + " with memory");
  if (!arguments.has("--data")) return exit_code::done;
  const DataSet data = load_data(arguments, *program);
  long rows = 0;
  for (const auto& recording : data.recordings) rows += static_cast<long>(recording.last - recording.first);
  fmt::print("{}: ok: {}, {} judged\n", arguments.text("--data"),
             count_text(static_cast<long>(data.recordings.size()), "recording"), count_text(rows, "row"));
  for (const auto& remark : data.remarks) fmt::print("  {}\n", remark);
  return exit_code::done;
}

}  // namespace

Verb check_verb() {
  return {"check",
          "is a diagram (and its data) right",
          check_help,
          {options::diagram(), options::data(false), options::set(), options::choose(), options::allow()},
          check};
}

}  // namespace hysteron
