// Decides the block "time_table": points over time, joined. Does not decide Akima's curve: models/math/akima.h.
#pragma once

#include <algorithm>
#include <cstddef>

#include "engine/block/block.h"
#include "engine/block/instance.h"
#include "models/math/akima.h"
#include "models/sources/signals.h"

namespace hysteron::blocks {

struct TimeTable {
  static constexpr bool uses_time = true;
  enum Parameter { times, values, between_points, repeat };
  enum Between { linear, hold, akima };

  static void describe(Declaration& d);
  static Declaration instance(const Declaration& type, const Node& block);
  static Sizes sizes(const Shape& shape);

  /// Which round the table makes at `time`, the first being 0; and the piece of it: -1 before the first point.
  struct Place {
    double round = 0;
    std::ptrdiff_t piece = -1;
  };
  template <class T>
  static Place place(const View<T>& v, double time) {
    const auto at = v.list(times);
    const auto n = static_cast<std::ptrdiff_t>(at.size());
    const auto value = [&](std::ptrdiff_t i) { return value_of(at[static_cast<std::size_t>(i)]); };
    Place p;
    if (v.choice(repeat) == 1) {
      const double length = value(n - 1) - value(0);
      p.round = std::max(
          0.0, signals::piece_at(time, (time - value(0)) / length, [&](double j) { return value(0) + j * length; }));
      time -= p.round * length;
    }
    const auto behind =
        std::upper_bound(at.begin(), at.end(), time, [](double t, const T& x) { return t < value_of(x); });
    p.piece = behind - at.begin() - 1;
    if (v.choice(repeat) == 1) p.piece = std::min(p.piece, n - 2);  // rounding
    return p;
  }
  template <class T>
  static void output(const View<T>& v) {
    const auto at = v.list(times), y = v.list(values);
    const auto n = static_cast<std::ptrdiff_t>(at.size());
    const Place p = place(v, v.branch);
    const auto time_of = [&](std::ptrdiff_t i) { return at[static_cast<std::size_t>(i)]; };
    const auto value = [&](std::ptrdiff_t i) { return y[static_cast<std::size_t>(i)]; };
    const auto k = p.piece;
    if (k < 0 || k >= n - 1 || v.choice(between_points) == hold) {
      v.out[0] = value(std::clamp<std::ptrdiff_t>(k, 0, n - 1));
      return;
    }
    const T t = p.round == 0 ? v.t : T{v.t - T{p.round} * (time_of(n - 1) - time_of(0))};
    v.out[0] = v.choice(between_points) == akima
                   ? akima::on_piece(n, k, t, time_of, value)
                   : T{value(k) + (value(k + 1) - value(k)) * (t - time_of(k)) / (time_of(k + 1) - time_of(k))};
  }
  static double next_breakpoint(const View<double>& v);
};

Kernel time_table_block();

}  // namespace hysteron::blocks
