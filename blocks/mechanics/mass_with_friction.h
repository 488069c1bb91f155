// Decides the block "mass_with_friction". Does not decide its law: models/mechanics/friction.h.
#pragma once

#include <string>

#include "blocks/mechanics/mass_spring_damper.h"
#include "blocks/mechanics/step_with_friction.h"
#include "models/mechanics/friction.h"

namespace hysteron::blocks {

struct MassWithFriction : Mass {
  template <class T>
  struct Params {
    T mass, damping, stiffness, coulomb, breakaway, stribeck_velocity, rest_speed, excess, stribeck_exponent,
        initial_position, initial_velocity, stiffening, quadratic, quintic, drag;
  };
  static void describe(BlockSpec<MassWithFriction>& spec);
  template <class T>
  static friction::Params<T> law(const Params<T>& p) {
    return {p.mass,
            p.damping,
            p.stiffness,
            p.coulomb,
            p.breakaway > T{0} ? p.breakaway : T(p.coulomb * (1.0 + p.excess)),
            p.stribeck_velocity,
            p.rest_speed,
            p.stiffening,
            p.quadratic,
            p.quintic,
            p.drag,
            p.stribeck_exponent};
  }
  template <class T>
  static MotionState<T> derivative(const Params<T>& p, const MotionState<T>& s, const ForceIn<T>& in, Mode mode) {
    return {s.velocity, friction::acceleration(law(p), friction::Mode(mode.is), s.position, s.velocity, in.force)};
  }
  template <class T>
  static T guard(const Params<T>& p, const MotionState<T>& s, const ForceIn<T>& in, Mode mode) {
    return friction::guard(law(p), friction::Mode(mode.is), s.position, s.velocity, in.force);
  }
  static Mode next(const Params<double>& p, const MotionState<double>& s, const ForceIn<double>& in, Mode mode) {
    if (guard(p, s, in, mode) > 0) return mode;
    return {friction::next(law(p), friction::Mode(mode.is), s.position, in.force)};
  }
  template <class T>
  static MotionState<T> reset(const Params<T>&, const MotionState<T>& s, const ForceIn<T>&, Mode, Mode) {
    return {s.position, T{0}};
  }
  /// Without friction: the middle of where it may stick.
  static MotionState<double> rest(const Params<double>& p, const ForceIn<double>& in) {
    return {mass_spring_damper::rest(friction::body(law(p)), in.force), 0};
  }
  static Mode initial_mode(const Params<double>& p) {
    return {friction::is_absent(law(p)) ? friction::slide_up : friction::start(p.initial_velocity)};
  }
  static std::string check(const Params<double>& p);
  struct OwnStep : StepWithFriction {
    explicit OwnStep(const Params<double>& p) : StepWithFriction(law(p)) {}
  };
};

/// Coulomb's friction, breakaway, and how one becomes the other.
void describe_dry_friction(Declaration& d, const MotionWords& words = translation);

Kernel mass_with_friction_block();

}  // namespace hysteron::blocks
