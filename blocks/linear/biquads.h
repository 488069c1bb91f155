// Decides the block "biquads": sections of second order one behind the other. Does not decide their law:
// models/linear/second_order.h.
#pragma once

#include "engine/block/block.h"
#include "models/linear/resonance.h"
#include "models/linear/second_order.h"

namespace hysteron::blocks {

struct Biquads {
  enum Parameter { gain, zero_frequencies, zero_dampings, pole_frequencies, pole_dampings };
  // States: per section its input q behind the poles, then v = q'/w.

  static void describe(Declaration& d);
  static Sizes sizes(const Shape& shape);
  template <class T>
  static void output(const View<T>& v) {
    v.out[0] = v.parameter(gain) * through(v, [](std::size_t, const T&) {});
  }
  template <class T>
  static void derivative(const View<T>& v) {
    through(v, [&](std::size_t k, const T& u) {
      const auto rate =
          resonance::rates(v.list(pole_frequencies)[k], v.list(pole_dampings)[k], v.x[2 * k], v.x[2 * k + 1], u);
      v.out[2 * k] = rate.q;
      v.out[2 * k + 1] = rate.v;
    });
  }
  static void rest(const View<double>& v);

 private:
  /// The input behind all sections; each is told what it gets.
  template <class T, class Section>
  static T through(const View<T>& v, const Section& section) {
    const auto zero = v.list(zero_frequencies), zero_damping = v.list(zero_dampings), pole = v.list(pole_frequencies),
               damping = v.list(pole_dampings);
    T u = v.u[0];
    for (std::size_t k = 0; k < pole.size(); ++k) {
      section(k, u);
      u = second_order::output(second_order::biquad(zero[k], zero_damping[k], pole[k]), damping[k], v.x[2 * k],
                               v.x[2 * k + 1], u);
    }
    return u;
  }
};

Kernel biquads_block();

}  // namespace hysteron::blocks
