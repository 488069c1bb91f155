// Input shapers leave their mode at rest: residual vibrations in closed form.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using tools::block;

std::string hertz(double f) { return fmt::format("{:.17g} Hz", f); }

/// What a mode of 2 Hz goes on to swing by behind a command that passes so many shapers for `frequency`.
double residual(int shapers, double frequency, double damping, const Node& command, double end,
                const std::string& rows) {
  std::vector<std::pair<std::string, Node>> blocks{{"s0", command}};
  for (int i = 1; i <= shapers; ++i)
    blocks.push_back(
        {fmt::format("s{}", i),
         block("input_shaper", {{"frequency", hertz(frequency)}, {"damping", damping}}, {fmt::format("s{}", i - 1)})});
  blocks.push_back(
      {"mode", block("resonance", {{"frequency", hertz(2)}, {"damping", damping}}, {blocks.back().first})});
  const auto program = tools::compiled(tools::diagram(blocks, {"mode"}));
  SimulateOptions options;
  options.until = end + 2;
  options.every = 1e-3;
  options.relative_tolerance = 1e-8;
  const auto traces = simulate(*program, start(*program), options);
  double largest = 0;
  for (std::size_t k = 0; k < traces.t.size(); ++k)
    if (traces.t[k] >= end) largest = std::max(largest, std::abs(traces.values[0][k] - 1));
  EXPECT_GT(traces.t.size(), 1000u) << rows;
  return largest;
}

const Node& step() {
  static const Node node = block("step", {{"after", 1.0}, {"time", "0.1 s"}});
  return node;
}

// A mode of 2 Hz and damping z swings with half periods of 0.25 s/sqrt(1 - z^2).
double half_period(double damping) { return 0.25 / std::sqrt(1 - damping * damping); }

TEST(InputShaperBlock, LeavesItsModeAtRestBehindAStep) {
  for (const double damping : {0.0, 0.1, 0.5})
    // tolerance of the integrator 1e-8 a step, some hundred steps
    EXPECT_LT(residual(1, 2, damping, step(), 0.1 + half_period(damping) + 1e-3, "step"), 1e-6) << damping;
  EXPECT_NEAR(residual(0, 2, 0.0, step(), 0.2, "unshaped"), 1, 1e-4);  // rows of 1 ms: a peak is missed by 2e-5
}

TEST(InputShaperBlock, ForgivesAWrongFrequencyAsTheClosedFormSays) {
  // Two pulses of one half, half a period of f apart, leave |cos(pi/2 * 2 Hz/f)| of the swing; two shapers its square.
  for (const double f : {1.8, 2.1, 2.4}) {
    const double one = std::abs(std::cos(M_PI_2 * 2 / f));
    EXPECT_NEAR(residual(1, f, 0, step(), 1, "one"), one, 1e-4 * one + 1e-6);
    EXPECT_NEAR(residual(2, f, 0, step(), 1, "two"), one * one, 1e-4 * one * one + 1e-6);
  }
}

TEST(InputShaperBlock, ShapesAnyCommandAlike) {
  // A staircase of unequal steps ends 0.63 s on: at rest half a period later.
  const Node stairs = block("staircase", {{"levels", tools::list({0, 0.7, -0.3, 1})}, {"duration", "0.21 s"}});
  EXPECT_LT(residual(1, 2, 0.05, stairs, 0.63 + half_period(0.05) + 1e-3, "staircase"), 2e-6);
}

TEST(InputShaperBlock, PassesRecordedRowsInTheSameWay) {
  // Row-wise advance is not for it; the simulation that a fit falls back to is exact all the same.
  Diagram d = tools::diagram({{"s", block("input_shaper", {{"frequency", "2 Hz"}}, {"u"})},
                              {"mode", block("resonance", {{"frequency", "2 Hz"}, {"damping", 0.0}}, {"s"})}},
                             {"mode"}, {{"u", ""}});
  const auto program = tools::compiled(d);
  auto run = start(*program);
  bind_input(*program, run, "u", tools::series({0, 0.1, 0.1, 2}, {0, 0, 1, 1}));
  SimulateOptions options;
  options.instants = {0.5, 1.0, 1.5, 1.9};
  options.relative_tolerance = 1e-8;
  const auto traces = simulate(*program, run, options);
  for (const double y : traces.values[0]) EXPECT_NEAR(y, 1, 1e-6);
}

}  // namespace
}  // namespace hysteron
