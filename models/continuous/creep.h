// Decides linear creep: a chain of Kelvin-Voigt elements that follow the signal slowly and add to it.
// Does not decide how many elements nor their times.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>

namespace hysteron::creep {

/// dx/dt = (u - x)/tau: one relaxation of time constant tau [s], x in the unit of u.
/// Source: Croft, Shed, Devasia, J. Dyn. Sys. Meas. Control 123 (2001) 35-43 (Kelvin-Voigt chain).
template <class T>
T relaxation_rate(const T& time, const T& x, const T& u) {
  return (u - x) / time;
}

/// Amount of element k of a chain that creeps by the logarithm of time, log10(1 + t/first_time) per unit of per_decade
/// after a step: with a spectrum exp(-first_time/tau) over ln tau, ln(1 + t/first_time) is the sum of all relaxations
/// (Frullani's integral). Each element stands for the decades halfway to its neighbours; the ends reach out as far as
/// they reach in. times [s]: two or more, increasing; per_decade [-], first_time [s].
template <class T>
T logarithmic_amount(const T& per_decade, const T& first_time, std::span<const T> times, std::size_t k) {
  using std::exp;
  using std::log;
  const std::size_t last = times.size() - 1, low = k > 0 ? k - 1 : 0, high = k < last ? k + 1 : last;
  const T decades = log(times[high] / times[low]) / (std::numbers::ln10 * static_cast<double>(high - low));
  return per_decade * decades * exp(-(first_time / times[k]));
}

/// y = u + sum c_k x_k; c_k [-] is the share that element k adds in the end.
template <class T>
T output(std::span<const T> amounts, std::span<const T> x, const T& u) {
  T y = u;
  for (std::size_t k = 0; k < amounts.size(); ++k) y += amounts[k] * x[k];
  return y;
}

/// Response to a unit step at t = 0 from rest: 1 + sum c_k (1 - exp(-t/tau_k)).
template <class T>
T step_response(std::span<const T> amounts, std::span<const T> times, const T& t) {
  using std::exp;
  T y{1};
  for (std::size_t k = 0; k < amounts.size(); ++k) y += amounts[k] * (T{1} - exp(-(t / times[k])));
  return y;
}

}  // namespace hysteron::creep
