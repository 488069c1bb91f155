// Decides linear creep: a chain of Kelvin-Voigt elements that follow the signal slowly and add to it.
// Does not decide how many elements nor their times.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>

namespace hysteron::creep {

/// dx/dt = (u - x)/tau: one relaxation of time constant tau [s], x in the unit of u.
/// Source: Croft, Shed, Devasia, J. Dyn. Sys. Meas. Control 123 (2001) 35-43 (Kelvin-Voigt chain).
template <class T>
T relaxation_rate(const T& time, const T& x, const T& u) {
  return (u - x) / time;
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
