// Decides a sampled PI or PID controller: its command, its integral by one of three rules, limits of the command and of
// its rate, and what these do to the integral (anti-windup). Does not decide what the gains of its forms are
// (models/continuous/pid.h), when it is asked, nor where its inputs come from.
#pragma once

#include <cmath>
#include <limits>

#include "models/continuous/pid.h"

namespace hysteron::sampled_pid {

enum class Rule { forward, backward, trapezoidal };
enum class AntiWindup { none, clamping, back_calculation };

/// Units for an error in m and a command in V.
template <class T>
struct Params {
  pid::Gains<T> gains{};
  T filter{0};                                      ///< [s]  time constant of the derivative's filter
  T weight{1};                                      ///< [-]  of the reference in the proportional part
  T lower{0};                                       ///< [V]  lower < upper
  T upper{0};                                       ///< [V]
  T step{std::numeric_limits<double>::infinity()};  ///< [V]  largest change of the command from instant to instant
  T tracking_time{1};  ///< [s]  back calculation: time in which the integral follows the limited command
  T period{1};         ///< [s]
};

/// What the controller remembers: zero = at rest.
template <class T>
struct State {
  T integral{0};        ///< [V]
  T rate{0};            ///< [m/s]  last filtered rate
  T differentiated{0};  ///< [m]  last error, or measured value with a minus, of which the rate is taken
  T error{0};           ///< [m]    last error, with the lead of the series form
  T command{0};         ///< [V]    last command
};

template <class T>
struct Inputs {
  T reference{};       ///< [m]
  T measured{};        ///< [m]
  T differentiated{};  ///< [m]  the error, or -measured: of which the derivative is taken
};

/// One instant: the command and the state behind it.
template <class T>
struct Step {
  T command{};  ///< [V] within the limits
  T wanted{};   ///< [V] without them
  State<T> after{};
};

/// The command at an instant and the state behind it.
///
///   d_k = (T_f d_(k-1) + s_k - s_(k-1))/(T_f + T_s)            filtered rate of s, the error or -measured
///   e_k = r_k - m_k + lead d_k,  P_k = kp (b r_k - m_k + lead d_k),  D_k = kd d_k
///   u = sat(P_k + I + D_k)
///   forward:      I = I_k,                              I_(k+1) = I_k + ki T_s e_k
///   backward:     I = I_k + ki T_s e_k,                 I_(k+1) = I
///   trapezoidal:  I = I_k + ki T_s (e_k + e_(k-1))/2,   I_(k+1) = I
///   clamping:     the increment is left out where the command is beyond a limit and the increment pushes further
///   back calculation: I_(k+1) += T_s/T_t (u - (P_k + I + D_k)); with what is `given` in place of u, if
///                     the actuator does something else; nothing without an integral (ki = 0)
///
/// sat keeps within lower and upper and within `step` of the last command. Before the first instant all is zero.
/// Source: thesis section 2.3 (forward rule); Astrom, Hagglund, Advanced PID Control (2006), sections 3.5 and 13.4.
template <class T>
Step<T> step(Rule rule, AntiWindup windup, const Params<T>& p, const State<T>& s, const Inputs<T>& in,
             const T* given = nullptr) {
  const T rate = (p.filter * s.rate + (in.differentiated - s.differentiated)) / (p.filter + p.period);
  const T error = in.reference - in.measured + p.gains.lead * rate;
  T increment = p.gains.ki * p.period * error;
  if (rule == Rule::trapezoidal) increment = T{0.5} * p.gains.ki * p.period * (error + s.error);
  const T integral = rule == Rule::forward ? s.integral : T{s.integral + increment};
  const T raw = pid::wanted(p.gains, p.weight, in.reference, in.measured, rate, integral).command;
  const bool steps = !std::isinf(plain(p.step));
  const T near = steps ? pid::limited(T{s.command - p.step}, T{s.command + p.step}, raw) : raw;
  const T command = pid::limited(p.lower, p.upper, near);

  T after = s.integral + increment;
  const bool further = (raw > command && increment > T{0}) || (raw < command && increment < T{0});
  if (windup == AntiWindup::clamping && further) after = s.integral;
  if (windup == AntiWindup::back_calculation && plain(p.gains.ki) != 0)
    after += p.period / p.tracking_time * ((given != nullptr ? *given : command) - raw);
  return {command, raw, {after, rate, in.differentiated, error, command}};
}

}  // namespace hysteron::sampled_pid
