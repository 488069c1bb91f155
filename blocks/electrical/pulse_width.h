// Decides the blocks "pwm", "h_bridge" and "h_bridge_with_dead_time". Does not decide their laws:
// models/electrical/pulse_width.h.
#pragma once

#include <array>

#include "engine/block/block.h"
#include "models/electrical/pulse_width.h"

namespace hysteron::blocks {

/// Compares its input with a carrier of its own: steps end at the carrier's corners (breakpoints), between which it is
/// straight, and at the edges (modes: bit 0 is the first leg, bit 1 the second).
struct Pwm {
  static constexpr bool uses_time = true;
  enum Parameter { frequency, modulation };

  static void describe(Declaration& d);
  static Sizes sizes(const Shape&);
  template <class T>
  static void output(const View<T>& v) {
    v.out[0] = T{pulse_width::gate(law(v), legs(v.mode))};
  }
  template <class T>
  static void guard(const View<T>& v) {
    const auto reserves = both(v);
    v.out[0] = law(v) != pulse_width::Modulation::unipolar || reserves[0] < reserves[1] ? reserves[0] : reserves[1];
  }
  static int next_mode(const View<double>& v) {
    const auto reserves = both(v);
    const bool two = law(v) == pulse_width::Modulation::unipolar;
    return v.mode ^ (reserves[0] > 0 ? 0 : 1) ^ (!two || reserves[1] > 0 ? 0 : 2);
  }
  static double next_breakpoint(const View<double>& v) { return pulse_width::next_corner(v.parameter(frequency), v.t); }

 private:
  template <class T>
  static pulse_width::Modulation law(const View<T>& v) {
    return pulse_width::Modulation(v.choice(modulation));
  }
  static pulse_width::Legs legs(int mode) { return {(mode & 1) != 0, (mode & 2) != 0}; }
  template <class T>
  static std::array<T, 2> both(const View<T>& v) {
    const T carrier = pulse_width::carrier(v.parameter(frequency), v.t), level = pulse_width::level(law(v), v.u[0]);
    const auto on = legs(v.mode);
    return {pulse_width::reserve(on.first, level, carrier), pulse_width::reserve(on.second, T{-level}, carrier)};
  }
};

struct HBridge {
  template <class T>
  struct Params {
    T supply, resistance;
  };
  template <class T>
  struct In {
    T gate, current;
  };
  template <class T>
  struct Out {
    T voltage;
  };
  static void describe(BlockSpec<HBridge>& spec);
  template <class T>
  static Out<T> output(const Params<T>& p, const In<T>& in) {
    return {p.supply * in.gate - p.resistance * in.current};
  }
};

/// On the mean over a period, what the current flows through while both switches of a leg are open takes from the
/// voltage.
struct HBridgeWithDeadTime {
  template <class T>
  struct Params {
    T supply, resistance, loss;
  };
  template <class T>
  using In = HBridge::In<T>;
  template <class T>
  using Out = HBridge::Out<T>;
  static void describe(BlockSpec<HBridgeWithDeadTime>& spec);
  template <class T>
  static Out<T> output(const Params<T>& p, const In<T>& in) {
    const double sign = value_of(in.current) > 0 ? 1 : value_of(in.current) < 0 ? -1 : 0;
    return {p.supply * in.gate - p.resistance * in.current - sign * p.loss};
  }
  static std::array<double, 1> kinks(const Params<double>&, const In<double>& in) { return {in.current}; }
};

Kernel pwm_block();
Kernel h_bridge_block();
Kernel h_bridge_with_dead_time_block();

}  // namespace hysteron::blocks
