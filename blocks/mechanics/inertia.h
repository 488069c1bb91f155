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

/// One law about an axis and along a line. Of their Params the third from the end tells how often the force or torque
/// comes again, and Own::per_place(), from that, how many radians of its own a radian or a metre is.
template <class Own>
struct Cogging : Mass {
  template <class T>
  struct Params {
    T mass, damping, stiffness, cosine, sine, again, initial_position, initial_velocity;
  };
  template <class T>
  static MotionState<T> derivative(const Params<T>& p, const MotionState<T>& s, const ForceIn<T>& in) {
    const mass_spring_damper::Params<T> law{p.mass, p.damping, p.stiffness, T{0}};
    const T force = in.force + cogging::torque(p.cosine, p.sine, Own::per_place(p.again), s.position);
    return {s.velocity, mass_spring_damper::acceleration(law, s.position, s.velocity, force)};
  }
  static MotionState<double> rest(const Params<double>& p, const ForceIn<double>& in) {
    return {cogging::rest(p.cosine, p.sine, Own::per_place(p.again), p.stiffness, in.force), 0};
  }
};

struct InertiaWithCogging : Cogging<InertiaWithCogging> {
  static void describe(BlockSpec<InertiaWithCogging>& spec);
  template <class T>
  static T per_place(const T& periods) {
    return periods;
  }
};

/// Of a linear motor, where what comes again is told by its period [m].
struct MassWithCogging : Cogging<MassWithCogging> {
  static void describe(BlockSpec<MassWithCogging>& spec);
  template <class T>
  static T per_place(const T& period) {
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
