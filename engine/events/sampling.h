// Decides what sampled blocks do at an instant: those that are due see each other's outputs in the order of the wires,
// then all their states change together. Does not decide when (clocks.h), nor what the jumps of the held outputs do.
#pragma once

#include <span>
#include <vector>

#include "engine/program/program.h"

namespace hysteron {

class Sampling {
 public:
  explicit Sampling(const Program& program);

  /// Runs the blocks `due` (places in program.sampled_blocks, as Clocks::take() gives them) at (t, x). `steps`: those
  /// of program.hit_values that are not in work.y yet. Writes sampled states and held outputs into the memory of the
  /// run. Throws Error "loop_unsolved".
  void operator()(Run& run, Work& work, double t, const double* x, std::span<const int> due,
                  const std::vector<Step>& steps);

 private:
  const Program& program_;
  std::vector<unsigned char> due_;
  std::vector<double> after_;  // where Run::m is
};

}  // namespace hysteron
