// The code in float: how far it says that it is from the engine is how far it is, under sanitizers of C.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <sstream>

#include "tests/export/c/in_c.h"
#include "tests/export/c/random_diagram.h"

namespace hysteron {
namespace {

using process::Folder;
using process::Outcome;

/// Beside what comp_test says, every output of every row: as the code gives it, and as the engine has it.
constexpr char driver[] = R"(#define main comp_test_main
#include "comp_test.c"
#undef main
int main(void)
{
    const int outputs = (int)(sizeof names / sizeof names[0]);
    const int inputs = (int)(sizeof rows[0] / sizeof rows[0][0]) - outputs;
    char name[] = "comp_test";
    char *words[] = {name, NULL};
    comp_state state;
    comp_input in;
    comp_output out;
    float number;
    int row, k;
    printf("exit %d\n", comp_test_main(1, words));
    comp_start(&state);
    for (row = 0; row < (int)(sizeof rows / sizeof rows[0]); ++row) {
        for (k = 0; k < inputs; ++k) {
            number = (float)rows[row][k];
            memcpy((char *)&in + k * (int)sizeof number, &number, sizeof number);
        }
        comp_step(&state, &in, &out);
        for (k = 0; k < outputs; ++k) {
            memcpy(&number, (char *)&out + k * (int)sizeof number, sizeof number);
            printf("%d %.17g %.17g\n", k, (double)number, rows[row][inputs + k]);
        }
    }
    return 0;
}
)";

struct Output {
  std::string name;
  double told = 0, told_size = 0;  // as comp_test prints them
  double off = 0, low = INFINITY, high = -INFINITY;
  double size() const { return high > low ? high - low : std::fabs(high); }
};

struct Ran {
  int code = -1;  // of comp_test
  std::vector<Output> outputs;
};

Ran ran(const Folder& folder) {
  folder.write("out/driver.c", driver);
  const Outcome run = process::shell(folder.path(), std::string("cd out && cc") + in_c::warnings + in_c::sanitized +
                                                        "-o driver driver.c comp.c -lm && ./driver");
  EXPECT_EQ(run.code, 0) << run.err;
  Ran made;
  std::istringstream lines(run.out);
  for (std::string line; std::getline(lines, line);) {
    char name[64];
    Output one;
    unsigned k = 0;
    double got = 0, expected = 0;
    const auto of_size = line.find(" of ");
    if (of_size != std::string::npos &&
        std::sscanf(line.c_str(), "%63[^:]: largest deviation %lf", name, &one.told) == 2) {
      one.told_size = std::strtod(line.c_str() + of_size + 4, nullptr);
      one.name = name;
      made.outputs.push_back(one);
    } else if (std::sscanf(line.c_str(), "exit %d", &made.code) == 1) {
      continue;
    } else if (std::sscanf(line.c_str(), "%u %lf %lf", &k, &got, &expected) == 3 && k < made.outputs.size()) {
      Output& of = made.outputs[k];
      of.off = std::max(of.off, std::fabs(got - expected));
      of.low = std::min(of.low, expected);
      of.high = std::max(of.high, expected);
    }
  }
  return made;
}

/// Printed with three and four digits.
void expect_what_is_told_holds(const Ran& run) {
  bool much = false;
  for (const Output& of : run.outputs) {
    EXPECT_NEAR(of.told, of.off, 5.1e-3 * of.off) << of.name;
    EXPECT_NEAR(of.told_size, of.size(), 5.1e-4 * of.size()) << of.name;
    much = much || of.off > 0.01 * of.size();
  }
  EXPECT_EQ(run.code, much ? 1 : 0);
}

/// Numbers of these diagrams are about one. Where no law has a step, ten blocks and sums over a thousand rows make of
/// the rounding of a float, 6e-8, no more than a thousandth.
void try_in_float(unsigned seed, int& smooth) {
  const Folder folder;
  in_c::RandomDiagram diagram;
  Outcome outcome;
  for (unsigned other = 0; other < 20 && outcome.code != 0; ++other) {
    diagram = in_c::random_diagram(seed + 10000 * other * in_c::random_kinds());
    folder.write("d.json", diagram.json);
    outcome = in_c::exported(folder, {"d.json", "--rate", "1 kHz", "--number", "float32"});
  }
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  SCOPED_TRACE(diagram.json);
  const Ran run = ran(folder);
  ASSERT_GE(run.outputs.size(), 4U);
  expect_what_is_told_holds(run);
  if (diagram.jumps) return;
  ++smooth;
  for (const Output& of : run.outputs) EXPECT_LT(of.off, 1e-3) << of.name;
}

TEST(ExportCInFloat, WhatItSaysOfRandomDiagramsHolds) {
  int smooth = 0;
  for (unsigned seed = 0; seed < in_c::random_kinds(); ++seed) try_in_float(seed, smooth);
  EXPECT_GT(smooth, 3);
}
TEST(LongExportCInFloat, WhatItSaysOfManyRandomDiagramsHolds) {
  int smooth = 0;
  for (unsigned seed = 2000; seed < 2200; ++seed) try_in_float(seed, smooth);
  EXPECT_GT(smooth, 20);
}

// 5.1 V and 0.3 V in float are other numbers: rounding of what never moves is no failure.
TEST(ExportCInFloat, AConstantOutputIsHeldAgainstItsValue) {
  const Folder folder;
  folder.write("d.json", R"({"format": 1, "title": "t", "inputs": {"u": {"unit": "V"}}, "blocks": {
    "k": {"type": "constant", "value": "5.1 V"}, "nothing": {"type": "gain", "gain": 0, "in": "u"},
    "y": {"type": "sum", "in": ["k", "nothing"]}}, "outputs": {"y": "y"}})");
  ASSERT_EQ(in_c::exported(folder, {"d.json", "--number", "float32"}).code, 0);
  const Ran run = ran(folder);
  EXPECT_EQ(run.code, 0);
  ASSERT_EQ(run.outputs.size(), 1U);
  EXPECT_EQ(run.outputs[0].told_size, 5.1);
  EXPECT_GT(run.outputs[0].told, 0);
  EXPECT_LT(run.outputs[0].told, 5.1 * 6e-8);  // half of a unit in the last place
}

// What the test of the code does with inputs of a recording, and with a clock that is slower than the code's.
TEST(ExportCInFloat, TakesTheInputsOfARecording) {
  const Folder folder;
  folder.write("d.json", R"({"format": 1, "title": "t", "inputs": {"u": {"unit": "V"}}, "blocks": {
    "table": {"type": "lookup", "at": {"value": [-1, 0, 2, 4, 7], "unit": "V"},
              "values": {"value": [-0.8, 0, 1.5, 3.4, 5.2], "unit": "um"}, "in": "u"},
    "core": {"type": "play", "radius": "0.3 um", "in": "table"},
    "held": {"type": "sample_hold", "period": "2 ms", "in": "core"}}, "outputs": {"y": "core", "h": "held"}})");
  std::string csv = "t[s],u[V]\n";  // 100 s on some clock, every 3 ms
  for (int k = 0; k <= 400; ++k) csv += fmt::format("{},{}\n", 100 + 3e-3 * k, 3 + 3 * std::sin(0.03 * k));
  folder.write("lab.csv", csv);
  const Outcome outcome =
      in_c::exported(folder, {"d.json", "--check", "lab.csv", "--number", "float32", "--rate", "1 kHz"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Ran run = ran(folder);
  ASSERT_EQ(run.outputs.size(), 2U);
  EXPECT_EQ(run.code, 0);
  for (const Output& of : run.outputs) {
    EXPECT_GT(of.told_size, 3) << of.name;  // um: of the recording, not of the turns within 1 V
    EXPECT_LT(of.told, 1e-5) << of.name;    // um: the rounding of 6 um is 4e-7
  }
}

}  // namespace
}  // namespace hysteron
