// Decides whether what an integrator's last step passed - a kink, a jump, a reversal - moves the states by more than
// the control of its error has seen: dx/dt is held against what the step made of it. Does not decide what is done then.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "engine/integrators/integrator.h"
#include "engine/program/program.h"
#include "engine/simulate/jacobian.h"

namespace hysteron {

/// A jump of dx/dt that moves the states by more than this share of the tolerance in one step restarts the integrator;
/// its error control deals with smaller ones.
inline constexpr double noticed_jump = 0.1;

class StepDefects {
 public:
  using Derivative = std::function<bool(double t, const double* x, double* dx)>;

  /// All of them outlive this. `states`: 0 where the integrator steps through time alone. `jacobian`: of bdf, or null.
  /// `tolerance`: absolute, per state [SI].
  StepDefects(const Integrator& solver, Formula formula, int states, Derivative derivative, Jacobian* jacobian,
              const Run& run, std::span<const double> tolerance);

  /// What was seen at `seen` [s] inside of the step from `from` only: would dx/dt there, all through the step, move the
  /// states.
  bool jumps(double from, double seen);
  /// A kink between `before` and `behind`, of which both ends of the step `from` .. `to` [s] have seen one side each,
  /// as the control of its error has. Backward differences feel large jumps and another Newton matrix alone; the others
  /// want a jump or a bend of dx/dt that moves the states to be the end of a step (40 dead zones behind sines, largest
  /// error with and without: 4e-9 and 1.9e-4 Runge-Kutta, 1.7e-6 and 2.2e-5 Adams, 8.9e-6 and 5.9e-6 bdf).
  bool bends(double from, double before, double behind, double to);
  /// The step from `from` [s] was cut where an input of memory turns. It was made with dx/dt behind that, where memory
  /// said what it had said at the beginning, whatever it said between: is dx/dt before the cut what the step made of
  /// it, to the error that a step may have.
  bool leads_to_its_end(double from);

 private:
  void slope_at(double t, std::vector<double>& dx);
  bool bends_the_states(double from, double before, double behind, double to);
  bool bends_newton(double from, double before, double behind, double to);

  const Integrator& solver_;
  Formula formula_;
  int states_;
  Derivative derivative_;
  Jacobian* jacobian_;
  const Run& run_;
  std::span<const double> tolerance_;
  std::vector<double> x_, before_, after_, entries_before_, entries_after_;
};

}  // namespace hysteron
