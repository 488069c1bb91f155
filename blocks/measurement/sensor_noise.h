// Decides the block "sensor_noise": white noise, held between its samples. Does not draw the numbers: models/random.h.
#pragma once

#include <cmath>
#include <string>

#include "engine/block/block.h"
#include "models/random.h"
#include "models/sources/signals.h"

namespace hysteron::blocks {

struct SensorNoise {
  static constexpr bool uses_time = true;
  enum Parameter { rms, period, seed };

  static void describe(Declaration& d);
  static Sizes sizes(const Shape&);
  static double sample(double time, double step) {
    return signals::piece_at(time, time / step, [&](double j) { return j * step; });
  }
  template <class T>
  static void output(const View<T>& v) {
    const auto k = static_cast<std::int64_t>(sample(v.branch, value_of(v.parameter(period))));
    const auto s = static_cast<std::uint64_t>(value_of(v.parameter(seed)));
    v.out[0] = v.u[0] + v.parameter(rms) * T{random::normal(s, v.key + 1, static_cast<std::uint64_t>(k))};
  }
  static double next_breakpoint(const View<double>& v) {
    const double step = v.parameter(period);
    return signals::strictly_behind(v.t, (sample(v.t, step) + 1) * step);
  }
  static std::string check(const View<double>& v);
};

Kernel sensor_noise_block();

}  // namespace hysteron::blocks
