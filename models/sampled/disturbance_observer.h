// Decides how a disturbance is told from a command and the speed that answers it. Does not decide when samples come.
#pragma once

#include <cmath>

namespace hysteron::disturbance_observer {

/// Share of the way that a low-pass of the corner f [Hz] goes in one period T [s], the samples held: 1 - exp(-2 pi f
/// T).
template <class T>
T share(const T& corner, const T& period) {
  using std::exp;
  return T{1} - exp(T{-6.283185307179586476925287 * corner * period});
}

/// What the speed v says beyond the command: the low-pass follows z = u + J v share/T, the disturbance is J v share/T -
/// z. With J v' = u + d and a held u it is d (1 - (1 - share)^k) behind k samples of a constant d, exactly. Source:
/// Ohnishi, Shibata, Murakami, IEEE/ASME Trans. Mechatronics 1 (1996) 56-67; here with held samples.
template <class T>
T momentum_rate(const T& inertia, const T& share, const T& period, const T& speed) {
  return inertia * speed * share / period;
}

}  // namespace hysteron::disturbance_observer
