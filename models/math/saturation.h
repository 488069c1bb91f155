// Decides the limit of a signal, hard or with a knee. Does not decide what a limit does to states behind it.
#pragma once

#include <algorithm>
#include <cmath>

namespace hysteron::saturation {

/// y = max(lower, min(upper, u)), lower < upper, all in one unit.
template <class T>
T limit(const T& lower, const T& upper, const T& u) {
  using std::max;
  using std::min;
  return max(lower, min(upper, u));
}

/// y = u/(1 + |u/size|^n)^(1/n): u far below `size`, which |y| never reaches; the knee is the sharper the larger n >= 1
/// is. u and size in one unit. Source: Rapp, ESA SP-332 (1991) 179-184 (knee of an amplifier).
template <class T>
T with_knee(const T& size, const T& n, const T& u) {
  using std::abs;
  using std::exp;
  using std::log;
  const T share = abs(u / size);
  if (!(share > T(0.0))) return u;
  // 1 + share^n without overflow, whichever of the two is larger.
  const T power = n * log(share);
  if (power > T(0.0)) return (u / share) * exp(-log(1.0 + exp(-power)) / n);
  return u * exp(-log(1.0 + exp(power)) / n);
}

}  // namespace hysteron::saturation
