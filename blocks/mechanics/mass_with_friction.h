// Decides the blocks with dry friction that truly sticks: "mass_with_friction" and, for a body that is drawn as sums,
// gains and integrators, "integrator_with_friction". Does not decide the law: models/mechanics/friction.h.
#pragma once

#include <string>

#include "blocks/linear/integrator.h"
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
  /// An excess of 0 is none, whatever the friction.
  static bool is_affine_in_modes(const Params<double>& p) {
    auto f = law(p);
    f.coulomb = 1;
    f.breakaway = p.breakaway == p.coulomb || (p.breakaway == 0 && p.excess == 0) ? 1 : 2;
    return friction::is_affine_in_modes(f);
  }
  static Mode initial_mode(const Params<double>& p, const MotionState<double>& s) {
    return {friction::is_absent(law(p)) ? friction::slide_up : friction::start(s.velocity)};
  }
  static std::string check(const Params<double>& p);
  struct OwnStep : StepWithFriction {
    explicit OwnStep(const Params<double>& p) : StepWithFriction(law(p)) {}
  };
};

/// Coulomb's friction, breakaway, and how one becomes the other.
void describe_dry_friction(Declaration& d, const MotionWords& words = translation);

/// A speed that dry friction acts on: of a mass of 1 kg without a spring.
struct IntegratorWithFriction {
  template <class T>
  struct Params {
    T level, excess, stribeck_velocity, stribeck_exponent, initial;
  };
  template <class T>
  using In = Integrator::In<T>;
  template <class T>
  using State = Integrator::State<T>;
  template <class T>
  using Out = Integrator::Out<T>;
  static void describe(BlockSpec<IntegratorWithFriction>& spec);
  /// Of a mass of 1 kg: level is a force and an acceleration.
  template <class T>
  static friction::Params<T> law(const Params<T>& p) {
    friction::Params<T> f;
    f.coulomb = p.level;
    f.breakaway = p.level * (1.0 + p.excess);
    f.stribeck_velocity = p.stribeck_velocity;
    f.falls_by = p.stribeck_exponent;
    return f;
  }
  template <class T>
  static Out<T> output(const Params<T>&, const State<T>& s) {
    return {s.x};
  }
  template <class T>
  static State<T> derivative(const Params<T>& p, const State<T>& s, const In<T>& in, Mode mode) {
    return {friction::acceleration(law(p), friction::Mode(mode.is), T{0}, s.x, in.u)};
  }
  template <class T>
  static T guard(const Params<T>& p, const State<T>& s, const In<T>& in, Mode mode) {
    return friction::guard(law(p), friction::Mode(mode.is), T{0}, s.x, in.u);
  }
  static Mode next(const Params<double>& p, const State<double>& s, const In<double>& in, Mode mode) {
    if (guard(p, s, in, mode) > 0) return mode;
    return {friction::next(law(p), friction::Mode(mode.is), 0.0, in.u)};
  }
  template <class T>
  static State<T> reset(const Params<T>&, const State<T>&, const In<T>&, Mode, Mode) {
    return {T{0}};
  }
  static State<double> initial(const Params<double>& p) { return {p.initial}; }
  static bool is_affine_in_modes(const Params<double>& p) { return p.excess == 0 || p.stribeck_velocity == 0; }
  static Mode initial_mode(const Params<double>& p, const State<double>& s) {
    return {friction::is_absent(law(p)) ? friction::slide_up : friction::start(s.x)};
  }
  class OwnStep {
   public:
    explicit OwnStep(const Params<double>& p) : step_(law(p)) {}
    bool takes(double) const { return true; }
    State<double> operator()(const State<double>& s, const In<double>& from, const In<double>& to, double h) {
      return {step_({0, s.x}, {from.u}, {to.u}, h).velocity};
    }

   private:
    StepWithFriction step_;
  };
};

Kernel mass_with_friction_block();
Kernel integrator_with_friction_block();

}  // namespace hysteron::blocks
