// Decides the block "modes": modes that ring beside what a signal does anyway. Does not decide how a mode moves:
// models/linear/resonance.h, nor how many there are.
#pragma once

#include "engine/block/block.h"
#include "models/linear/resonance.h"

namespace hysteron::blocks {

struct Modes {
  enum Parameter { frequencies, dampings, positions, velocities };
  // States: motion q of each mode, then v = q'/w of each, of the size of q at the resonance.

  static void describe(Declaration& d);
  static Sizes sizes(const Shape& shape);
  template <class T>
  static void output(const View<T>& v) {
    const auto position = v.list(positions), velocity = v.list(velocities);
    const std::size_t n = position.size();
    T y = v.u[0];
    for (std::size_t k = 0; k < n; ++k) y += position[k] * (v.x[k] - v.u[0]) + velocity[k] * v.x[n + k];
    v.out[0] = y;
  }
  template <class T>
  static void derivative(const View<T>& v) {
    const auto frequency = v.list(frequencies), damping = v.list(dampings);
    const std::size_t n = frequency.size();
    for (std::size_t k = 0; k < n; ++k) {
      const auto rate = resonance::rates(frequency[k], damping[k], v.x[k], v.x[n + k], v.u[0]);
      v.out[k] = rate.q;
      v.out[n + k] = rate.v;
    }
  }
  static void rest(const View<double>& v);
};

Kernel modes_block();

}  // namespace hysteron::blocks
