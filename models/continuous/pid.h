// Decides a PID controller with limits: what its forms and parameters mean, the command, and the rates of its states.
// Does not decide how it is sampled: models/sampled/sampled_pid.h.
#pragma once

#include <algorithm>

#include "models/number.h"

namespace hysteron::pid {

/// parallel: P, I and D have gains of their own. standard: one gain for all, and times. series: the lead of D stands
/// before P and I, as in pneumatic controllers.
enum class Form { parallel, standard, series };
enum class AntiWindup { back_calculation, clamping, none };

/// What each form comes to. Units for an error in m and a command in V.
template <class T>
struct Gains {
  T kp{1};    ///< [V/m]
  T ki{0};    ///< [V/(m s)]
  T kd{0};    ///< [V s/m]
  T lead{0};  ///< [s]  of the series form: P and I see e + lead de/dt
};

/// parallel: kp, ki, kd as they are. standard: ki = kp/T_i, kd = kp T_d. series: kp (1 + 1/(T_i s)) (1 + T_d s).
/// T_i = 0: no integral. Source: Astrom, Hagglund, Advanced PID Control (2006), section 3.2.
template <class T>
Gains<T> gains(Form form, const T& kp, const T& ki, const T& kd, const T& integral_time, const T& derivative_time) {
  if (form == Form::parallel) return {kp, ki, kd, T{0}};
  const T of_integral = plain(integral_time) == 0 ? T{0} : T{kp / integral_time};
  if (form == Form::standard) return {kp, of_integral, kp * derivative_time, T{0}};
  return {kp, of_integral, T{0}, derivative_time};
}

/// What the filter of the derivative is where nothing is said: a tenth of the derivative's own time; a second, which
/// nobody sees, where there is no derivative.
template <class T>
T filter_of(const Gains<T>& g, const T& filter) {
  using std::abs;
  if (plain(filter) > 0) return filter;
  if (plain(g.lead) > 0) return T{0.1} * g.lead;
  return plain(g.kd) != 0 && plain(g.kp) != 0 ? T{T{0.1} * abs(T{g.kd / g.kp})} : T{1};
}

/// How fast the integral follows the limited command where nothing is said: the time of the integral itself. 0: there
/// is no integral.
template <class T>
T tracking_time_of(const Gains<T>& g, const T& tracking_time) {
  using std::abs;
  if (plain(g.ki) == 0) return T{0};
  if (plain(tracking_time) > 0) return tracking_time;
  return abs(T{g.kp / g.ki});
}

/// The command before its limits, and what the integral is fed with.
template <class T>
struct Wanted {
  T command{};        ///< [V]
  T integral_rate{};  ///< [V/s] of the error alone
};

/// u = kp (b r - m + lead d) + I + kd d and dI/dt = ki (r - m + lead d) for the filtered rate d [m/s] of the error or
/// of -m; b: the weight of the reference in P.
template <class T>
Wanted<T> wanted(const Gains<T>& g, const T& weight, const T& reference, const T& measured, const T& rate,
                 const T& integral) {
  const T before = g.lead * rate;
  return {g.kp * (weight * reference - measured + before) + integral + g.kd * rate,
          g.ki * (reference - measured + before)};
}

/// A limit of the command; either may be infinite.
template <class T>
T limited(const T& lower, const T& upper, const T& command) {
  using std::max;
  using std::min;
  return max(lower, min(upper, command));
}

/// Behind a limit, clamping fades out over this share of the range between both: where the error still pushes and P
/// already gives in, the integral then comes to rest there, and does not chatter.
inline constexpr double clamping_band = 1e-3;

/// dI/dt [V/s] of a continuous controller. back_calculation: + (given - wanted)/tracking_time, `given` being what the
/// actuator does; clamping: none of what pushes further beyond a limit.
/// Source: Astrom, Hagglund (as above), section 3.5.
template <class T>
T integral_rate(AntiWindup windup, const Wanted<T>& w, const T& given, const T& tracking_time, const T& lower,
                const T& upper) {
  if (windup == AntiWindup::back_calculation)
    return plain(tracking_time) > 0 ? T{w.integral_rate + (given - w.command) / tracking_time} : w.integral_rate;
  if (windup == AntiWindup::none) return w.integral_rate;
  const bool up = plain(w.integral_rate) > 0;
  const T beyond = (up ? T{w.command - upper} : T{lower - w.command}) / (T{clamping_band} * (upper - lower));
  if (!(plain(beyond) > 0)) return w.integral_rate;
  return plain(beyond) < 1 ? T{w.integral_rate * (T{1} - beyond)} : T{0};
}

}  // namespace hysteron::pid
