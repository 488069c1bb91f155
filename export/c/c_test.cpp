#include "export/c/c_test.h"

#include <fmt/format.h>

namespace hysteron {
namespace {

std::string shown_unit(const Unit& unit) { return unit.text.empty() ? "" : " " + unit.text; }

/// A string of C.
std::string quoted(const std::string& text) {
  std::string made = "\"";
  for (const char c : text) made += c == '"' || c == '\\' ? std::string("\\") + c : std::string(1, c);
  return made + "\"";
}

std::string table(const SignalRows& inputs, const SignalRows& outputs, std::size_t count) {
  std::string text;
  for (std::size_t k = 0; k < count; ++k) {
    std::string row;
    for (const SignalRows* part : {&inputs, &outputs})
      for (const auto& signal : *part)
        row += (row.empty() ? "" : ", ") + c_text::literal(c_text::Real::float64, signal[k]);
    text += "    {" + row + "},\n";
  }
  return text;
}

constexpr char main_text[] = R"(
int main(int argc, char **argv)
{
    NAME_state state;
    NAME_input in;
    NAME_output out;
    double worst[OUTPUTS] = {0.0}, low[OUTPUTS] = {0.0}, high[OUTPUTS] = {0.0};
    int row, k, different = 0, failed = 0;
    NAME_start(&state);
    memset(&in, 0, sizeof in);
    for (row = 0; row < ROWS; ++row) {
        const double *expected = &rows[row][INPUTS];
        double got[OUTPUTS];
        int same = 1;
GIVE        NAME_step(&state, &in, &out);
TAKE        for (k = 0; k < OUTPUTS; ++k) {
            const double off = fabs(got[k] - expected[k]);
            if (memcmp(&got[k], &expected[k], sizeof got[k]) != 0)
                same = 0;
            if (!(off <= worst[k]))
                worst[k] = off;
            if (row == 0 || expected[k] < low[k])
                low[k] = expected[k];
            if (row == 0 || expected[k] > high[k])
                high[k] = expected[k];
        }
        if (!same && different++ == 0 && sizeof(NUMBER) == sizeof(double))
            printf("row %d is the first that differs\n", row);
    }
    for (k = 0; k < OUTPUTS; ++k) {
        /* What an output spans; a constant one is held against its value. */
        const double size = high[k] > low[k] ? high[k] - low[k] : fabs(high[k]);
        printf("%s: largest deviation %.3g%s of %.4g%s\n", names[k], worst[k] / scales[k], units[k], size / scales[k],
               units[k]);
        if (sizeof(NUMBER) < sizeof(double) && worst[k] != 0.0 && !(worst[k] <= 0.01 * size))
            failed = 1;
    }
    if (sizeof(NUMBER) == sizeof(double)) {
        if (different == 0)
            printf("%d rows of the engine: the same bits\n", ROWS);
        else
            printf("%d of %d rows differ from the engine\n", different, ROWS);
        failed = different != 0;
    } else {
        printf("%d rows of the engine in float\n", ROWS);
    }
    if (argc > 1) {
        const long steps = atol(argv[1]);
        const clock_t begin = clock();
        double sum = 0.0;
        long i;
        for (i = 0; i < steps; ++i) {
            row = (int)(i % ROWS);
GIVE            NAME_step(&state, &in, &out);
            sum += (double)out.FIRST;
        }
        printf("%.1f ns per step (sum %g)\n", 1e9 * (double)(clock() - begin) / CLOCKS_PER_SEC / (double)steps, sum);
    }
    return failed;
}
)";

void replace(std::string& text, const std::string& what, const std::string& by) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
    text.replace(at, what.size(), by);
}

}  // namespace

std::string c_test_source(const CSource& source, const CWish& wish, const SignalRows& inputs,
                          const SignalRows& outputs) {
  const std::string name = c_text::identifier(wish.name);
  const std::string number = wish.real == c_text::Real::float64 ? "double" : "float";
  const std::size_t count = outputs.front().size();
  std::string names, units, scales, give, take;
  for (std::size_t i = 0; i < source.inputs.size(); ++i)
    give += fmt::format("        in.{} = ({})rows[row][{}];\n", source.inputs[i].name, number, i);
  for (std::size_t i = 0; i < source.outputs.size(); ++i) {
    const CPort& port = source.outputs[i];
    take += fmt::format("        got[{}] = (double)out.{};\n", i, port.name);
    names += (i == 0 ? "" : ", ") + quoted(port.name);
    units += (i == 0 ? "" : ", ") + quoted(shown_unit(port.unit));
    scales += (i == 0 ? "" : ", ") + c_text::literal(c_text::Real::float64, port.unit.scale);
  }
  std::string text = main_text;
  replace(text, "GIVE            ", [&] {
    std::string further = give;
    replace(further, "        in.", "            in.");
    return further + "            ";
  }());
  replace(text, "GIVE", give);
  replace(text, "TAKE", take);
  replace(text, "NAME", name);
  replace(text, "NUMBER", number);
  replace(text, "ROWS", std::to_string(count));
  replace(text, "OUTPUTS", std::to_string(source.outputs.size()));
  replace(text, "INPUTS", std::to_string(source.inputs.size()));
  replace(text, "FIRST", source.outputs.front().name);
  return fmt::format(
             "/* {0}_test.c: steps through rows of the engine and says how far {0}.c is from them. With a number behind it: how\n"
             "   long so many steps take. */\n"
             "#include \"{0}.h\"\n\n#include <math.h>\n#include <stdio.h>\n#include <stdlib.h>\n#include <string.h>\n#include "
             "<time.h>\n\n"
             "static const char *const names[] = {{{1}}};\nstatic const char *const units[] = {{{2}}};\n"
             "/* of one such unit in SI */\nstatic const double scales[] = {{{3}}};\n\n"
             "/* Inputs, then outputs [SI]. */\nstatic const double rows[{4}][{5}] = {{\n{6}}};\n",
             name, names, units, scales, count, source.inputs.size() + source.outputs.size(),
             table(inputs, outputs, count)) +
         text;
}

}  // namespace hysteron
