// Decides how a mass with dry friction steps through a row: it slides one way, turns or stops within the row, sticks
// for a while and breaks away, each where it happens. Does not decide the friction: models/mechanics/friction.h.
#pragma once

#include "blocks/mechanics/mass_spring_damper.h"
#include "models/mechanics/friction.h"
#include "models/mechanics/mass_motion.h"

namespace hysteron::blocks {

/// While a mass slides one way dry friction is a constant force, and what it holds more at low speed and all that is
/// not linear a force on the motion: mass_motion::step_under; Runge-Kutta where rows are too short for that, or nothing
/// drives it back. A row of ten radians and more ends where the mass comes to rest.
class StepWithFriction {
 public:
  explicit StepWithFriction(const friction::Params<double>& law)
      : law_(law), body_(friction::body(law)), beyond_(body_) {}

  bool takes(double) const { return true; }
  MotionState<double> operator()(const MotionState<double>& s, const ForceIn<double>& from, const ForceIn<double>& to,
                                 double h);

 private:
  using Motion = mass_motion::Motion;
  Motion short_row(Motion now, double from, double to, double h);
  Motion long_row(const Motion& begin, double from, double to, double h);
  /// Behind h [s] in which it slides that way, the force going from `from` to `to` [N]; further than it turns.
  Motion slide(const Motion& begin, double from, double to, double h, bool up);
  /// For how long of h [s] it sticks at a place, the force beginning at `from` [N] and rising by `rise` [N/s].
  double sticks(double place, double from, double rise, double h) const;

  friction::Params<double> law_;
  mass_spring_damper::Params<double> body_;
  BeyondLinear beyond_;
  RowStep row_, half_row_;
};

}  // namespace hysteron::blocks
