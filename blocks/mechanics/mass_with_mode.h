// Decides the block "mass_with_mode": a mass on a spring that carries a second one by its own spring and damper. Does
// not decide how the first mass moves: models/mechanics/mass_spring_damper.h, nor the second:
// models/linear/resonance.h.
#pragma once

#include "engine/block/block.h"
#include "models/linear/resonance.h"
#include "models/mechanics/mass_spring_damper.h"

namespace hysteron::blocks {

struct MassWithMode {
  enum Parameter { mass, damping, stiffness, share, frequency, mode_damping, initial_position, initial_velocity };
  enum State { position, velocity, mode_position, mode_rate };  // the last: velocity of the mode over w, in m

  static void describe(Declaration& d);
  static Sizes sizes(const Shape&);
  template <class T>
  static void output(const View<T>& v) {
    v.out[0] = v.x[position];
    v.out[1] = v.x[velocity];
  }
  /// q'' = w^2 (x - q) + 2 z w (x' - q'): the mode follows a base whose velocity its damper feels too, so that what
  /// holds it pulls the first mass with share mass q''.
  template <class T>
  static void derivative(const View<T>& v) {
    const T w = v.parameter(frequency) * 6.283185307179586476925287;
    const T base = v.x[position] + 2.0 * v.parameter(mode_damping) * v.x[velocity] / w;
    const auto rate =
        resonance::rates(v.parameter(frequency), v.parameter(mode_damping), v.x[mode_position], v.x[mode_rate], base);
    const T pull = v.parameter(share) * v.parameter(mass) * w * rate.v;
    const mass_spring_damper::Params<T> law{v.parameter(mass), v.parameter(damping), v.parameter(stiffness), T(0.0)};
    v.out[position] = v.x[velocity];
    v.out[velocity] = mass_spring_damper::acceleration(law, v.x[position], v.x[velocity], T{v.u[0] - pull});
    v.out[mode_position] = rate.q;
    v.out[mode_rate] = rate.v;
  }
  static void rest(const View<double>& v);
  static void initial_states(const View<double>& v);
};

Kernel mass_with_mode_block();

}  // namespace hysteron::blocks
