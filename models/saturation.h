// Decides the hard limit of a signal. Does not decide what a limit does to states behind it.
#pragma once

#include <algorithm>

namespace hysteron::saturation {

/// y = max(lower, min(upper, u)), lower < upper, all in one unit.
template <class T>
T limit(const T& lower, const T& upper, const T& u) {
  using std::max;
  using std::min;
  return max(lower, min(upper, u));
}

}  // namespace hysteron::saturation
