// Decides how d(dx/dt)/dx of a program is computed: columns that share no row get one colour, and one evaluation in
// Jets carries eight colours (Curtis, Powell, Reid, IMA J. Appl. Math. 13 (1974) 117-119). Memory and modes are
// constants, so behind a kink the slopes are one-sided.
#pragma once

#include <vector>

#include "engine/integrators/integrator.h"
#include "engine/program/program.h"

namespace hysteron {

class Jacobian {
 public:
  explicit Jacobian(const Program& program);

  /// Which entries can be other than zero: what each state's derivative depends on, along values, rates and
  /// derivatives.
  const SparsityPattern& pattern() const { return pattern_; }
  int colours() const { return colours_; }
  /// The entries of pattern() in its order, at (t, x); false where one is not finite. Pure towards the run.
  bool operator()(const Run& run, double t, const double* x, double* entries);

 private:
  const Program& program_;
  SparsityPattern pattern_;
  std::vector<int> colour_;  // per state
  int colours_ = 0;
  JetWork work_;
  std::vector<Jet> x_;
};

}  // namespace hysteron
