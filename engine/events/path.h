// Decides what a jump does to memory and to rate-independent laws: they follow it as the path of a fast ramp.
//
// At a jump the outputs of the blocks that jump move from their old to their new values, s = 0 ... 1, while time and
// all other states stand still. A law dx/dt = f(x, u, du/dt) that is homogeneous of degree one in the rate, if only
// where the rate is high (a friction that falls with the speed), has a limit there: the path of a ramp, however short
// (Visintin, Differential Models of Hysteresis, 1994, chapter 1: rate independence). Rates along the path are those of
// a ramp of jump_duration. All blocks between take part, so the result is that of the ramp, whatever stands between and
// whatever the output grid. Memory commits along the path. What does not move (no rate-independent state and no
// nonlinear block in front of memory) needs no path: memory then simply follows to the end.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "engine/integrators/integrator.h"
#include "engine/program/program.h"

namespace hysteron {

/// Where only memory follows a jump, behind a bent block: so many pieces. A reversal inside a piece is missed by its
/// height.
inline constexpr int jump_pieces = 64;

/// Per block: does a jump of its outputs reach memory, or the states of a rate-independent law, at once through a bent
/// block, so that these follow in pieces?
std::vector<bool> turns_before_memory(const Program& program);

class JumpPath {
 public:
  /// Tolerances as of the integration in time; one absolute tolerance per state.
  JumpPath(const Program& program, double relative_tolerance, std::span<const double> absolute_tolerance);

  /// The outputs of `jumping` blocks were `before` (per signal) and are now as they evaluate at (t, x). Walks the path:
  /// changes the memory of the run and the states x. Returns true if states moved.
  bool follow(Run& run, Work& work, double t, std::vector<double>& x, const std::vector<double>& before,
              std::span<const int> jumping);

 private:
  bool find_jumps(const Work& work, const std::vector<double>& before, std::span<const int> candidates);
  void integrate(Run& run, Work& work, double t, std::vector<double>& x);
  void walk(Run& run, Work& work, double t, const std::vector<double>& x);
  void commit(Run& run, Work& work, double t, const std::vector<double>& x, double s);

  const Program& program_;
  double relative_tolerance_;
  std::vector<double> absolute_tolerance_;
  std::vector<int> states_;          // of rate-independent blocks
  std::vector<bool> moves_, turns_;  // per block: reaches such states at once; reaches memory through a bend
  std::vector<unsigned char> jumping_, rate_independent_;
  std::vector<double> from_, to_, trial_;
  PathPoint point_;
  std::unique_ptr<Integrator> solver_;
  // What the solver's function works on, valid during integrate().
  Run* run_ = nullptr;
  Work* work_ = nullptr;
  double t_ = 0;
};

}  // namespace hysteron
