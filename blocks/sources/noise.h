// Decides the block "noise": random numbers of a given bandwidth. Does not decide how they are drawn and joined:
// models/sources/noise.h.
#pragma once

#include <cstdint>
#include <string>

#include "engine/block/block.h"
#include "models/sources/noise.h"
#include "models/sources/signals.h"

namespace hysteron::blocks {

struct Noise {
  static constexpr bool uses_time = true;
  enum Parameter { rms, bandwidth, seed, offset, between_numbers };
  enum Between { smooth, hold };

  static void describe(Declaration& d);
  static Sizes sizes(const Shape& shape);
  static std::string check(const View<double>& v);

  /// Between two numbers [s].
  template <class T>
  static T step(const View<T>& v) {
    return T{v.choice(between_numbers) == hold ? noise::held_bandwidth : noise::joined_bandwidth} /
           v.parameter(bandwidth);
  }
  static double held(double time, double step) {
    return signals::piece_at(time, time / step, [&](double j) { return j * step; });
  }
  template <class T>
  static void output(const View<T>& v) {
    const auto own = static_cast<std::uint64_t>(value_of(v.parameter(seed)));
    const std::uint64_t stream = v.key + 1;
    const T value = v.choice(between_numbers) == hold ? T{noise::number(own, stream, held(v.branch, value_of(step(v))))}
                                                      : noise::joined(T{v.t / step(v)}, own, stream);
    v.out[0] = v.parameter(offset) + v.parameter(rms) * value;
  }
  static double next_breakpoint(const View<double>& v) {
    if (v.choice(between_numbers) == smooth) return signals::never;
    return signals::strictly_behind(v.t, (held(v.t, step(v)) + 1) * step(v));
  }
  static double shortest_period(const View<double>& v) { return step(v); }
};

Kernel noise_block();

}  // namespace hysteron::blocks
