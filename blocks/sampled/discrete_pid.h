// Decides the blocks "discrete_pid" and "discrete_pid_tracking": digital PID controllers of reference and measured
// value. Does not decide their law: models/sampled/sampled_pid.h.
#pragma once

#include <algorithm>
#include <limits>
#include <string>
#include <type_traits>

#include "blocks/continuous/pid.h"
#include "engine/block/block.h"
#include "models/sampled/sampled_pid.h"

namespace hysteron::blocks {

struct TwoInputs {
  template <class T>
  struct In {
    T reference, measured;
  };
};
struct ThreeInputs {
  template <class T>
  struct In {
    T reference, measured, tracked;
  };
};

template <bool tracks>
struct DiscretePid : std::conditional_t<tracks, ThreeInputs, TwoInputs> {
  template <class T>
  struct Params {
    T form, kp, ki, kd, integral_time, derivative_time, filter, derivative_on, setpoint_weight, lower, upper, rate,
        rule, anti_windup, tracking_time, initial, period, offset;
  };
  template <class T>
  struct State {
    T integral, rate, differentiated, error, command, begun;
  };
  template <class T>
  struct Out {
    T y;
  };
  static void describe(BlockSpec<DiscretePid>& spec);
  static std::string check(const Params<double>& p);

  template <class T>
  static sampled_pid::Params<T> law(const Params<T>& p) {
    using std::max;
    sampled_pid::Params<T> law;
    law.gains =
        pid::gains(pid::Form(static_cast<int>(value_of(p.form))), p.kp, p.ki, p.kd, p.integral_time, p.derivative_time);
    law.filter = pid::filter_of(law.gains, p.filter);
    law.weight = p.setpoint_weight;
    law.lower = p.lower;
    law.upper = p.upper;
    if (value_of(p.rate) > 0) law.step = p.rate * p.period;
    const T slow = pid::tracking_time_of(law.gains, p.tracking_time);
    law.tracking_time = value_of(p.tracking_time) > 0 ? p.tracking_time : T{max(slow, p.period)};
    law.period = p.period;
    return law;
  }
  /// At the first instant the past was as the present: no kick of the derivative, and no step.
  template <class T, class In>
  static sampled_pid::Step<T> step(const Params<T>& p, const State<T>& s, const In& in) {
    auto numbers = law(p);
    const bool begun = value_of(s.begun) != 0;
    const T error = in.reference - in.measured;
    const T differentiated = value_of(p.derivative_on) == 0 ? T{-in.measured} : error;
    sampled_pid::State<T> before{s.integral, s.rate, s.differentiated, s.error, s.command};
    if (!begun) {
      before.differentiated = differentiated;
      before.error = error;
      numbers.step = T{std::numeric_limits<double>::infinity()};
    }
    using sampled_pid::AntiWindup;
    constexpr AntiWindup rules[] = {AntiWindup::back_calculation, AntiWindup::clamping, AntiWindup::none};
    const T* given = nullptr;
    if constexpr (tracks) given = &in.tracked;
    return sampled_pid::step(sampled_pid::Rule(static_cast<int>(value_of(p.rule))),
                             rules[static_cast<int>(value_of(p.anti_windup))], numbers, before,
                             sampled_pid::Inputs<T>{in.reference, in.measured, differentiated}, given);
  }
  template <class T>
  static Out<T> output(const Params<T>& p, const State<T>& s, const typename DiscretePid::template In<T>& in) {
    return {step(p, s, in).command};
  }
  template <class T>
  static State<T> update(const Params<T>& p, const State<T>& s, const typename DiscretePid::template In<T>& in) {
    const auto after = step(p, s, in).after;
    return {after.integral, after.rate, after.differentiated, after.error, after.command, T{1}};
  }
  static State<double> initial(const Params<double>& p) { return {p.initial, 0, 0, 0, 0, 0}; }
};

Kernel discrete_pid_block();
Kernel discrete_pid_tracking_block();

}  // namespace hysteron::blocks
