// Decides the blocks of an inertia that a torque turns: the masses' own laws in other words, and
// "inertia_with_cogging", with its like along a line, "mass_with_cogging". Does not decide the laws: models/mechanics.
#pragma once

#include "blocks/mechanics/mass_spring_damper.h"
#include "blocks/mechanics/mass_with_friction.h"
#include "blocks/mechanics/mass_with_presliding.h"
#include "models/mechanics/cogging.h"

namespace hysteron::blocks {

struct Inertia : MassSpringDamper {
  static void describe(BlockSpec<Inertia>& spec);
};
struct InertiaWithFriction : MassWithFriction {
  static void describe(BlockSpec<InertiaWithFriction>& spec);
};
struct InertiaWithDrag : MassWithDrag {
  static void describe(BlockSpec<InertiaWithDrag>& spec);
};
struct InertiaWithPresliding : MassWithElements<DahlElement> {
  static void describe(Declaration& d);
};

struct InertiaWithCogging : Mass {
  template <class T>
  struct Params {
    T inertia, damping, stiffness, cosine, sine, periods, initial_position, initial_velocity;
  };
  static void describe(BlockSpec<InertiaWithCogging>& spec);
  template <class T>
  static MotionState<T> derivative(const Params<T>& p, const MotionState<T>& s, const ForceIn<T>& in) {
    const mass_spring_damper::Params<T> law{p.inertia, p.damping, p.stiffness, T{0}};
    const T torque = in.force + cogging::torque(p.cosine, p.sine, p.periods, s.position);
    return {s.velocity, mass_spring_damper::acceleration(law, s.position, s.velocity, torque)};
  }
  static MotionState<double> rest(const Params<double>& p, const ForceIn<double>& in) {
    return {cogging::rest(p.cosine, p.sine, p.periods, p.stiffness, in.force), 0};
  }
};

/// Of a linear motor: the same along a line, where what comes again is told by its period.
struct MassWithCogging : Mass {
  template <class T>
  struct Params {
    T mass, damping, stiffness, cosine, sine, period, initial_position, initial_velocity;
  };
  static void describe(BlockSpec<MassWithCogging>& spec);
  template <class T>
  static MotionState<T> derivative(const Params<T>& p, const MotionState<T>& s, const ForceIn<T>& in) {
    const mass_spring_damper::Params<T> law{p.mass, p.damping, p.stiffness, T{0}};
    const T force = in.force + cogging::torque(p.cosine, p.sine, per_way(p.period), s.position);
    return {s.velocity, mass_spring_damper::acceleration(law, s.position, s.velocity, force)};
  }
  static MotionState<double> rest(const Params<double>& p, const ForceIn<double>& in) {
    return {cogging::rest(p.cosine, p.sine, per_way(p.period), p.stiffness, in.force), 0};
  }

 private:
  /// [rad/m] as an inertia's periods count an angle.
  template <class T>
  static T per_way(const T& period) {
    return T{6.283185307179586476925287} / period;
  }
};

Kernel inertia_block();
Kernel inertia_with_friction_block();
Kernel inertia_with_drag_block();
Kernel inertia_with_presliding_block();
Kernel inertia_with_cogging_block();
Kernel mass_with_cogging_block();

}  // namespace hysteron::blocks
