// Decides the blocks "synchronous_motor" and "stepper_motor". Does not decide their laws:
// models/electrical/synchronous_machine.h.
#pragma once

#include <algorithm>
#include <cmath>

#include "blocks/electrical/sub_steps.h"
#include "engine/block/block.h"
#include "models/electrical/synchronous_machine.h"

namespace hysteron::blocks {

struct SynchronousMotor {
  template <class T>
  struct Params {
    T resistance, inductance_d, inductance_q, flux, pole_pairs;
  };
  template <class T>
  struct In {
    T voltage_d, voltage_q, speed;
  };
  template <class T>
  struct State {
    T current_d, current_q;
  };
  template <class T>
  struct Out {
    T torque, current_d, current_q;
  };
  static void describe(BlockSpec<SynchronousMotor>& spec);
  template <class T>
  static synchronous_machine::Machine<T> machine(const Params<T>& p) {
    return {p.resistance, p.inductance_d, p.inductance_q, p.flux, p.pole_pairs};
  }
  template <class T>
  static Out<T> output(const Params<T>& p, const State<T>& s) {
    return {synchronous_machine::torque<T>(machine(p), {s.current_d, s.current_q}), s.current_d, s.current_q};
  }
  template <class T>
  static State<T> derivative(const Params<T>& p, const State<T>& s, const In<T>& in) {
    const auto rate =
        synchronous_machine::rates<T>(machine(p), {in.voltage_d, in.voltage_q}, in.speed, {s.current_d, s.current_q});
    return {rate.first, rate.second};
  }
  static State<double> rest(const Params<double>& p, const In<double>& in);
  static double fastest(const Params<double>& p, const In<double>& in) {
    const double larger = std::max(p.inductance_d, p.inductance_q), smaller = std::min(p.inductance_d, p.inductance_q);
    return p.resistance / smaller + std::fabs(p.pole_pairs * in.speed) * larger / smaller;
  }
  using OwnStep = SubSteps<SynchronousMotor>;
};

struct StepperMotor {
  template <class T>
  struct Params {
    T resistance, inductance, torque_constant, teeth, detent;
  };
  template <class T>
  struct In {
    T voltage_a, voltage_b, angle, speed;
  };
  template <class T>
  struct State {
    T current_a, current_b;
  };
  template <class T>
  struct Out {
    T torque, current_a, current_b;
  };
  static void describe(BlockSpec<StepperMotor>& spec);
  template <class T>
  static synchronous_machine::Stepper<T> machine(const Params<T>& p) {
    return {p.resistance, p.inductance, p.torque_constant, p.teeth, p.detent};
  }
  template <class T>
  static Out<T> output(const Params<T>& p, const State<T>& s, const In<T>& in) {
    return {synchronous_machine::torque<T>(machine(p), in.angle, {s.current_a, s.current_b}), s.current_a, s.current_b};
  }
  template <class T>
  static State<T> derivative(const Params<T>& p, const State<T>& s, const In<T>& in) {
    const auto rate = synchronous_machine::rates<T>(machine(p), {in.voltage_a, in.voltage_b}, in.angle, in.speed,
                                                    {s.current_a, s.current_b});
    return {rate.first, rate.second};
  }
  static State<double> rest(const Params<double>& p, const In<double>& in);
  /// The induced voltages turn with the teeth.
  static double fastest(const Params<double>& p, const In<double>& in) {
    return p.resistance / p.inductance + std::fabs(p.teeth * in.speed);
  }
  using OwnStep = SubSteps<StepperMotor>;
};

Kernel synchronous_motor_block();
Kernel stepper_motor_block();

}  // namespace hysteron::blocks
