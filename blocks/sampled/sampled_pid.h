// Decides the block "sampled_pid": a digital PI or PID controller. Does not decide its law:
// models/sampled/sampled_pid.h.
#pragma once

#include <string>

#include "engine/block/block.h"
#include "models/sampled/sampled_pid.h"

namespace hysteron::blocks {

struct SampledPid {
  template <class T>
  struct Params {
    T kp, ki, kd, filter, lower, upper, rule, anti_windup, tracking_time, initial, period, offset;
  };
  template <class T>
  struct In {
    T u;
  };
  template <class T>
  struct State {
    T integral, rate, error;
  };
  template <class T>
  struct Out {
    T y;
  };
  static void describe(BlockSpec<SampledPid>& spec);
  template <class T>
  static sampled_pid::Step<T> step(const Params<T>& p, const State<T>& s, const In<T>& in) {
    // tracking_time 0: that of the integral itself, kp/ki, but never below one period.
    T tracking = p.tracking_time;
    if (value_of(tracking) == 0) {
      tracking = p.period;
      if (value_of(p.ki) != 0 && p.kp / p.ki > p.period) tracking = p.kp / p.ki;
    }
    sampled_pid::Params<T> law;
    law.gains = {p.kp, p.ki, p.kd, T{0}};
    law.filter = p.filter;
    law.lower = p.lower;
    law.upper = p.upper;
    law.tracking_time = tracking;
    law.period = p.period;
    return sampled_pid::step(sampled_pid::Rule(static_cast<int>(value_of(p.rule))),
                             sampled_pid::AntiWindup(static_cast<int>(value_of(p.anti_windup))), law,
                             {s.integral, s.rate, s.error, s.error, T{0}}, sampled_pid::Inputs<T>{in.u, T{0}, in.u});
  }
  template <class T>
  static Out<T> output(const Params<T>& p, const State<T>& s, const In<T>& in) {
    return {step(p, s, in).command};
  }
  template <class T>
  static State<T> update(const Params<T>& p, const State<T>& s, const In<T>& in) {
    const auto after = step(p, s, in).after;
    return {after.integral, after.rate, after.error};
  }
  static State<double> initial(const Params<double>& p) { return {p.initial, 0, 0}; }
  static std::string check(const Params<double>& p);
};

Kernel sampled_pid_block();

}  // namespace hysteron::blocks
