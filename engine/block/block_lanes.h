// Decides how the functions of a fixed block pass many lanes: a loop over lanes around them, compiled for the vector
// instructions of several generations of processors, of which the present one's are taken. The block's author writes
// nothing for it. Does not decide which diagrams run in lanes (lanes.h).
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <utility>

#include "engine/block/block_forms.h"
#include "engine/block/kernel.h"
#include "engine/block/lane.h"
#include "engine/block/simd_dispatch.h"

namespace hysteron::block_detail {

using LaneDual = DualOf<Lane>;

/// A struct of scalars from numbers `at` tells one by one; written out, so that the compiler sees every member.
template <class S, class At>
inline S filled(const At& at) {
  if constexpr (std::is_empty_v<S>)
    return {};
  else
    return [&]<std::size_t... i>(std::index_sequence<i...>) { return S{at(static_cast<int>(i))...}; }
  (std::make_index_sequence<sizeof(S) / sizeof(decltype(at(0)))>{});
}

template <class S>
inline S lane_of(const double* numbers, int lanes, int lane) {
  return filled<S>([&](int i) { return Lane(numbers[i * lanes + lane]); });
}
template <class S>
inline S inputs_of(const double* const* u, int lane) {
  return filled<S>([&](int i) { return Lane(u[i][lane]); });
}

/// Numbers of `s` that `take` makes of its members, to their places.
template <class T, class S, class Take>
inline void spread(const S& s, double* out, int lanes, int lane, const Take& take) {
  if constexpr (!std::is_empty_v<S>) {
    constexpr std::size_t n = sizeof(S) / sizeof(T);
    const auto numbers = std::bit_cast<std::array<T, n>>(s);
    for (std::size_t i = 0; i < n; ++i) out[static_cast<int>(i) * lanes + lane] = take(numbers[i]);
  }
}

template <class B>
struct OutputOfLanes {
  static void of(const LanesView& v, int l) {
    using F = Forms<B, Lane>;
    using Y = Types<B, Lane>;
    const auto p = lane_of<typename Y::P>(v.p, v.lanes, l);
    const auto s = lane_of<typename Y::S>(v.x, v.lanes, l);
    const auto in = [&] { return inputs_of<typename Y::I>(v.u, l); };
    const auto keep = [&](const typename Y::O& o) { spread<Lane>(o, v.out, v.lanes, l, [](Lane a) { return a.v; }); };
    if constexpr (F::output_time) {
      keep(B::output(p, Time<Lane>{v.t, v.branch}));
    } else if constexpr (F::output_state) {
      keep(B::output(p, s));
    } else if constexpr (F::output_in) {
      keep(B::output(p, in()));
    } else if constexpr (F::output_state_in) {
      keep(B::output(p, s, in()));
    } else {
      const auto m = B::advance(p, lane_of<typename Y::M>(v.m, v.lanes, l), in());
      spread<Lane>(m, v.advanced, v.lanes, l, [](Lane a) { return a.v; });
      keep(B::output(p, m, in()));
    }
  }
};

template <class B>
struct RatesOfLanes {
  static void of(const LanesView& v, int l) {
    using F = Forms<B, LaneDual>;
    using Y = Types<B, LaneDual>;
    const auto fixed = [&](const double* numbers) {
      return [=, lanes = v.lanes](int i) { return LaneDual(Lane(numbers[i * lanes + l])); };
    };
    const auto p = filled<typename Y::P>(fixed(v.p));
    const auto s =
        filled<typename Y::S>([&](int i) { return LaneDual(Lane(v.x[i * v.lanes + l]), Lane(v.dx[i * v.lanes + l])); });
    const auto in = [&] {
      return filled<typename Y::I>([&](int i) { return LaneDual(Lane(v.u[i][l]), Lane(v.du[i][l])); });
    };
    const auto keep = [&](const typename Y::O& o) {
      spread<LaneDual>(o, v.out, v.lanes, l, [](const LaneDual& a) { return a.rate.v; });
      if constexpr (F::output_time)
        spread<LaneDual>(o, v.values, v.lanes, l, [](const LaneDual& a) { return a.value.v; });
    };
    if constexpr (F::output_time)
      keep(B::output(p, Time<LaneDual>{LaneDual(Lane(v.t), Lane(1)), v.branch}));
    else if constexpr (F::output_state)
      keep(B::output(p, s));
    else if constexpr (F::output_in)
      keep(B::output(p, in()));
    else if constexpr (F::output_state_in)
      keep(B::output(p, s, in()));
    else
      keep(B::output(p, B::advance(p, filled<typename Y::M>(fixed(v.m)), in()), in()));
  }
};

template <class B>
struct DerivativeOfLanes {
  static void of(const LanesView& v, int l) {
    using Y = Types<B, Lane>;
    const auto p = lane_of<typename Y::P>(v.p, v.lanes, l);
    const auto s = lane_of<typename Y::S>(v.x, v.lanes, l);
    const auto in = inputs_of<typename Y::I>(v.u, l);
    const auto keep = [&](const typename Y::S& dx) { spread<Lane>(dx, v.out, v.lanes, l, [](Lane a) { return a.v; }); };
    if constexpr (Forms<B, Lane>::derivative_rate)
      keep(B::derivative(p, s, in, inputs_of<typename Y::I>(v.du, l)));
    else
      keep(B::derivative(p, s, in));
  }
};

/// The loop over lanes. No lane's results are another's arguments.
template <class Body>
struct OverLanes {
  using Arguments = LanesView;
  static void run(const LanesView& view) {
    const LanesView v = view;
#pragma GCC ivdep
    for (int l = 0; l < v.lanes; ++l) Body::of(v, l);
  }
};
template <class Body>
LaneFunctions::Call over_lanes() {
  return SimdDispatch<OverLanes<Body>>::on_this_processor();
}

template <class B>
LaneFunctions fixed_lanes() {
  LaneFunctions f;
  f.output = over_lanes<OutputOfLanes<B>>();
  f.output_rate = over_lanes<RatesOfLanes<B>>();
  if constexpr (Forms<B, double>::states) f.derivative = over_lanes<DerivativeOfLanes<B>>();
  return f;
}

}  // namespace hysteron::block_detail
