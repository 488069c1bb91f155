// Decides what can be said of a compiled diagram without running it: its loops, who asks for which rate, its clocks,
// what makes events. Does not print (explain.cpp).
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "engine/program/program.h"

namespace hysteron {

/// Blocks that read each other around a loop, in the order of the signals.
struct FeedbackLoop {
  std::vector<int> blocks;
  std::vector<int> opened_by;  ///< those whose outputs do not depend on their inputs at the same instant; none = an
                               ///< algebraic loop (Program::loops)
};
/// One loop per set of blocks that reach each other; the shortest through its first block.
std::vector<FeedbackLoop> feedback_loops(const Program& program);
/// A signal whose rate is computed, and who asks for it.
struct NeededRate {
  int signal = 0;
  std::vector<std::string> asked_by;  ///< "hysteresis, whose law is driven by it"
};
std::vector<NeededRate> needed_rates(const Program& program);

/// Sampled blocks that run together.
struct ClockFacts {
  double period = 0, offset = 0;  ///< [s]
  std::vector<int> blocks;
};
std::vector<ClockFacts> clock_facts(const Program& program);

/// A parameter's value as it is used, and where it comes from: "default", "--set", "diagram /blocks/a/gain",
/// "parameter set table.json /alpha".
std::string origin_text(const std::string& origin);

}  // namespace hysteron
