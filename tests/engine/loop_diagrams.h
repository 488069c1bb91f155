// Diagrams with an algebraic loop, and what they say at one input.
#pragma once

#include <algorithm>

#include "engine/diagram/index.h"
#include "engine/program/loops.h"
#include "tests/engine/simulate_tools.h"

namespace hysteron::tools {

/// A run with one input "u" that stands at `value`.
inline Run with_input(const Program& program, double value) {
  auto run = start(program);
  bind_input(program, run, "u", series({0}, {value}));
  set_loop_accuracy(program, run, 1e-6, 1e-2);
  return run;
}

/// The value of a signal at t = 0 with the input at `u`.
inline double value_at(const Program& program, double u, const std::string& signal) {
  const auto run = with_input(program, u);
  Work work(program);
  evaluate_values(program, run, work, 0, run.x.data());
  throw_if_unsolved(program, work, 0);
  return work.y[at(program.signal(signal))];
}

inline const std::vector<std::pair<std::string, std::string>> volts{{"u", "V"}};

/// error = u - gain * back, back = block(error).
inline Diagram feedback(const Node& block_in_the_loop, std::vector<std::string> record = {"error", "back"}) {
  return diagram({{"error", block("sum", {{"signs", "+-"}}, {"u", "back"})}, {"back", block_in_the_loop}},
                 std::move(record), volts);
}

/// A loop with kinks and memory around a state: x' = (sat(u - play(5 x + loop)) - x) / tau.
inline Diagram kinked(bool reversed = false) {
  std::vector<std::pair<std::string, Node>> blocks{
      {"error", block("sum", {{"signs", "+--"}}, {"u", "bent", "x"})},
      {"amplified", block("gain", {{"gain", 4.0}}, {"error"})},
      {"limited", block("saturation", {{"lower", "-2 V"}, {"upper", "2 V"}}, {"amplified"})},
      {"bent", block("play", {{"radius", "0.05 V"}}, {"limited"})},
      {"second", block("sum", {{"signs", "+-"}}, {"bent", "half"})},
      {"half", block("gain", {{"gain", 0.5}}, {"second"})},
      {"x", block("lag", {{"times", list({0.02}, "s")}}, {"second"})}};
  if (reversed) std::reverse(blocks.begin(), blocks.end());
  return diagram(blocks, {"x", "limited", "half"}, volts);
}

struct BoucWenNumbers {
  double alpha = 0.6187, beta = 0.2418, gamma = 0.0237, d_p = 1.6126;  // SPEC 2.3, in V
};

inline Node bouc_wen(const BoucWenNumbers& p, double d_p, const std::string& in) {
  return block("bouc_wen",
               {{"alpha", p.alpha}, {"beta", Number{p.beta, "1/V"}}, {"gamma", Number{p.gamma, "1/V"}}, {"d_p", d_p}},
               {in});
}

}  // namespace hysteron::tools
