// Decides how each block of a program answers small motions of its own inputs and states, where a run stands: exact
// slopes, block by block. Does not follow wires (linearize.h). Internal to the engine.
#pragma once

#include <Eigen/Core>

#include "engine/program/program.h"

namespace hysteron {

/// Deviations of one block, SI:  dx/dt = a x + b u + r du/dt,  y = c x + d u.  Of a sampled block x are its sampled
/// states, of which a x + b u are those behind an instant. A dead time has no slopes: it answers later.
struct BlockSlopes {
  Eigen::MatrixXd a, b, r, c, d;
  /// Nothing that its inputs do is seen at its outputs.
  bool cuts() const;
};

/// Slopes at (run.t, run.x) with memory and modes as committed.
class LocalSlopes {
 public:
  /// Evaluates the operating point. Throws Error "loop_unsolved".
  LocalSlopes(const Program& program, const Run& run);
  BlockSlopes operator()(int block);
  /// Value of a signal at the operating point [SI].
  double value(int signal) const { return values_.y[static_cast<std::size_t>(signal)]; }

 private:
  /// The block's functions with up to eight columns of (x, u, du) seeded, from column `first` on.
  void evaluate(int block, int first);

  const Program& program_;
  const Run& run_;
  Work values_;
  JetWork jets_;
  std::vector<Jet> x_, u_, du_, m_, y_, dx_;
};

}  // namespace hysteron
