// Decides a sampled PI or PID controller: its command, its integral by one of three rules, and what a limit of the
// command does to the integral (anti-windup). Does not decide when it is asked nor where its error comes from.
#pragma once

#include <algorithm>

namespace hysteron::sampled_pid {

enum class Rule { forward, backward, trapezoidal };
enum class AntiWindup { none, clamping, back_calculation };

/// Units for an error in m and a command in V.
template <class T>
struct Params {
  T kp{1};             ///< [V/m]
  T ki{0};             ///< [V/(m s)]
  T kd{0};             ///< [V s/m]
  T filter{0};         ///< [s]  time constant of the derivative's filter
  T lower{0};          ///< [V]  lower < upper
  T upper{0};          ///< [V]
  T tracking_time{1};  ///< [s]  back calculation: time in which the integral follows the limited command
  T period{1};         ///< [s]
};

/// What the controller remembers: zero = at rest.
template <class T>
struct State {
  T integral{0};    ///< [V]
  T derivative{0};  ///< [V]  last filtered derivative part
  T error{0};       ///< [m]  last error
};

/// One instant: command and the state behind it.
template <class T>
struct Step {
  T command{};  ///< [V] within the limits
  State<T> after{};
};

/// The command for error e_k [m] and the state behind the instant.
///
///   u = sat(kp e_k + I + D),   D_k = (T_f D_(k-1) + kd (e_k - e_(k-1)))/(T_f + T_s)
///   forward:      I = I_k,                              I_(k+1) = I_k + ki T_s e_k
///   backward:     I = I_k + ki T_s e_k,                 I_(k+1) = I
///   trapezoidal:  I = I_k + ki T_s (e_k + e_(k-1))/2,   I_(k+1) = I
///   clamping:     the increment is left out where the command is beyond a limit and the increment pushes further
///   back calculation: I_(k+1) += T_s/T_t (sat(u) - u)
///
/// Before the first instant error and derivative are zero. Source: thesis section 2.3 (forward rule);
/// Astrom, Hagglund, Advanced PID Control (2006).
template <class T>
Step<T> step(Rule rule, AntiWindup windup, const Params<T>& p, const State<T>& s, const T& error) {
  using std::max;
  using std::min;
  T increment = p.ki * p.period * error;
  if (rule == Rule::trapezoidal) increment = T{0.5} * p.ki * p.period * (error + s.error);
  const T derivative = (p.filter * s.derivative + p.kd * (error - s.error)) / (p.filter + p.period);
  const T integral = rule == Rule::forward ? s.integral : T{s.integral + increment};
  const T raw = p.kp * error + integral + derivative;
  const T command = max(p.lower, min(p.upper, raw));

  T after = s.integral + increment;
  const bool further = (raw > p.upper && increment > T{0}) || (raw < p.lower && increment < T{0});
  if (windup == AntiWindup::clamping && further) after = s.integral;
  if (windup == AntiWindup::back_calculation) after += p.period / p.tracking_time * (command - raw);
  return {command, {after, derivative, error}};
}

}  // namespace hysteron::sampled_pid
