// Decides the block "mass_with_stops". Does not decide its law: models/mechanics/hard_stop.h.
#pragma once

#include <algorithm>
#include <string>

#include "blocks/mechanics/mass_spring_damper.h"
#include "models/mechanics/hard_stop.h"

namespace hysteron::blocks {

struct MassWithStops : Mass {
  template <class T>
  struct Params {
    T mass, damping, stiffness, lower, upper, restitution, rest_speed, initial_position, initial_velocity;
  };
  static void describe(BlockSpec<MassWithStops>& spec);
  template <class T>
  static hard_stop::Params<T> law(const Params<T>& p) {
    return {p.mass, p.damping, p.stiffness, p.lower, p.upper, p.restitution, p.rest_speed};
  }
  template <class T>
  static MotionState<T> derivative(const Params<T>& p, const MotionState<T>& s, const ForceIn<T>& in, Mode mode) {
    return {s.velocity, hard_stop::acceleration(law(p), hard_stop::Mode(mode.is), s.position, s.velocity, in.force)};
  }
  template <class T>
  static T guard(const Params<T>& p, const MotionState<T>& s, const ForceIn<T>& in, Mode mode) {
    return hard_stop::guard(law(p), hard_stop::Mode(mode.is), s.position, in.force);
  }
  static Mode next(const Params<double>& p, const MotionState<double>& s, const ForceIn<double>& in, Mode mode) {
    if (guard(p, s, in, mode) > 0) return mode;
    return {hard_stop::land(law(p), hard_stop::Mode(mode.is), s.position, s.velocity, in.force).mode};
  }
  template <class T>
  static MotionState<T> reset(const Params<T>& p, const MotionState<T>& s, const ForceIn<T>& in, Mode before, Mode) {
    const auto landing = hard_stop::land(law(p), hard_stop::Mode(before.is), s.position, s.velocity, in.force);
    return {landing.position, landing.velocity};
  }
  static MotionState<double> rest(const Params<double>& p, const ForceIn<double>& in) {
    const double free = p.stiffness > 0 ? in.force / p.stiffness : in.force > 0 ? p.upper : p.lower;
    return {std::clamp(free, p.lower, p.upper), 0};
  }
  static std::string check(const Params<double>& p);
};

Kernel mass_with_stops_block();

}  // namespace hysteron::blocks
