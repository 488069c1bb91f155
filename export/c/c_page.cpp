#include "export/c/c_page.h"

#include <fmt/format.h>

#include "engine/diagram/time_text.h"

namespace hysteron {
namespace {

std::string port_table(const std::vector<CPort>& ports) {
  std::string text = "| member | unit of the code | signal | shown in |\n|---|---|---|---|\n";
  for (const auto& p : ports)
    text +=
        fmt::format("| `{}` | {} | {} | {} |\n", p.name, p.si_unit, p.signal, p.unit.text.empty() ? "1" : p.unit.text);
  return text;
}

}  // namespace

std::string deviation_text(const CPort& port, double off) {
  return fmt::format("{}: at most {:.3g}{}", port.name, port.unit.difference_from_si(off),
                     port.unit.text.empty() ? "" : " " + port.unit.text);
}

std::string c_page(const CPlan& plan, const CSource& source, const CWish& wish, const CFindings& findings) {
  const std::string n = c_text::identifier(wish.name);
  const bool wide = wish.real == c_text::Real::float64;
  const long bytes = wide ? 8 : 4;
  std::string text = fmt::format(
      "# {}\n\nC99, written by hysteron{}. No heap, no recursion, every loop bounded; the state belongs to the caller.\n\n",
      n, wish.from.empty() ? "" : " from " + wish.from);
  text += fmt::format(
      "```c\n#include \"{0}.h\"\n\nstatic {0}_state state;\n{0}_input in;\n{0}_output out;\n\n{0}_start(&state);\n"
      "/* then at every step: fill in, and */\n{0}_step(&state, &in, &out);\n```\n\n",
      n);
  text +=
      plan.period > 0
          ? fmt::format("One step every {} ({:.6g} Hz). The first call is the instant 0.\n\n", time_text(plan.period),
                        1 / plan.period)
          : "Nothing in the code depends on how often it is called: it remembers turns of its inputs, not time.\n\n";
  text += "## Inputs\n\n" + port_table(source.inputs) + "\n## Outputs\n\n" + port_table(source.outputs);
  text += fmt::format(
      "\n## Size\n\nNumbers that are remembered: {} ({} bytes); constants: {} ({} bytes, `static const`).\n",
      source.state_numbers, source.state_numbers * bytes, source.constants, source.constants * bytes);
  if (!findings.replaced.empty()) {
    text +=
        "\n## From continuous to sampled\n\nThe code holds other blocks than the diagram where states move continuously:\n\n";
    for (const auto& line : findings.replaced) text += "- " + line + "\n";
    text += "\nIn the engine, over the rows of the test, the sampled diagram differs from the continuous one by\n\n";
    for (std::size_t i = 0; i < findings.off.size(); ++i)
      text += "- " + deviation_text(source.outputs[i], findings.off[i]) + "\n";
  }
  text += fmt::format("\n## Test\n\n    cc -std=c99 -O2 -o {0}_test {0}_test.c {0}.c -lm && ./{0}_test\n\n", n);
  text += fmt::format("It holds {} rows of the engine; the inputs are {}. ", findings.rows, findings.rows_from);
  text +=
      wide
          ? "Compiled so that products and sums are not contracted (`-std=c99` does that; else `-ffp-contract=off`) the "
            "outputs have the same bits.\n"
          : "It says how far the outputs in float are from the engine's in double, and fails beyond 1 % of what an output "
            "spans.\n";
  return text;
}

}  // namespace hysteron
