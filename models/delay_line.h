// Decides a delay by a whole number of samples: a ring of past values. Does not decide when samples come.
#pragma once

#include <cstddef>
#include <span>

namespace hysteron::delay_line {

/// The ring of a delay of n samples holds u_(k-n) ... u_(k-1); `at` is the place of the oldest. n = 0: no delay.
template <class T>
T output(std::span<const T> ring, std::size_t at, const T& u) {
  return ring.empty() ? u : ring[at];
}

/// Puts u_k in the place of the oldest value and returns the place of what is then the oldest.
template <class T>
std::size_t push(std::span<T> ring, std::size_t at, const T& u) {
  if (ring.empty()) return 0;
  ring[at] = u;
  return at + 1 == ring.size() ? 0 : at + 1;
}

}  // namespace hysteron::delay_line
