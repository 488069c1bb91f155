// Decides the blocks "pulse" and "trapezoid": levels between which a signal jumps or goes in straight lines, once or
// over and over. Does not decide their corners: models/sources/pulses.h.
#pragma once

#include <string>

#include "engine/block/block.h"
#include "models/sources/pulses.h"

namespace hysteron::blocks {

struct Pulse {
  template <class T>
  struct Params {
    T low, high, period, duty, time, pulses;
  };
  template <class T>
  struct Out {
    T y;
  };
  static constexpr Smoothness smoothness = Smoothness::jumps;
  template <class T>
  static signals::PulseTimes times(const Params<T>& p) {
    const double count = value_of(p.pulses);
    return {value_of(p.period), value_of(p.duty), value_of(p.time), count > 0 ? count : signals::never};
  }

  static void describe(BlockSpec<Pulse>& spec);
  template <class T>
  static Out<T> output(const Params<T>& p, const Time<T>& time) {
    const auto corners = times(p);
    return {corners.is_high(corners.piece(time.branch)) ? p.high : p.low};
  }
  static double next_breakpoint(const Params<double>& p, double t) { return times(p).next_breakpoint(t); }
  static std::string check(const Params<double>& p);
};

struct Trapezoid {
  template <class T>
  struct Params {
    T low, high, rise, top, fall, period, time;
  };
  template <class T>
  struct Out {
    T y;
  };
  template <class T>
  static signals::TrapezoidTimes times(const Params<T>& p) {
    return {value_of(p.rise), value_of(p.top), value_of(p.fall), value_of(p.period), value_of(p.time)};
  }

  static void describe(BlockSpec<Trapezoid>& spec);
  template <class T>
  static Out<T> output(const Params<T>& p, const Time<T>& time) {
    const double piece = times(p).piece(time.branch);
    return {p.low + (p.high - p.low) * signals::trapezoid(time.t, p.rise, p.top, p.fall, p.period, p.time, piece)};
  }
  static double next_breakpoint(const Params<double>& p, double t) { return times(p).next_breakpoint(t); }
  static std::string check(const Params<double>& p);
};

Kernel pulse_block();
Kernel trapezoid_block();

}  // namespace hysteron::blocks
