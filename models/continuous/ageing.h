// Decides how a gain falls with use, and how the cycles of a signal are counted. Does not decide what has that gain.
#pragma once

#include <cmath>

namespace hysteron::ageing {

/// Gain after n cycles (or hours) over that of a new device: 1 - a log10(1 + n/n0); a per decade, n0 > 0 in the unit of
/// n: where the decades begin. Source: Jaffe, Cook, Jaffe, Piezoelectric Ceramics (1971), chapter 7 (ageing goes with
/// the logarithm of time); Zhang, Jones, Acta Mater. 58 (2010) 1584 (of cycles).
template <class T>
T gain(const T& per_decade, const T& n0, const T& n) {
  using std::log;
  return 1.0 - per_decade * log(1.0 + n / n0) / std::log(10.0);
}

/// Cycles of a signal: half a one for every turn by more than `swing`. As rain-flow counting looks for turning points,
/// ASTM E1049.
template <class T>
struct Count {
  T extreme{0};    ///< [u] farthest point since the last turn
  T direction{0};  ///< of the present way: 1, -1, 0 = not yet moved
  T cycles{0};
};

/// The count after a monotone move to u; swing 0 counts nothing. Pure; cutting the move changes nothing.
template <class T>
Count<T> count(const Count<T>& before, const T& swing, const T& u) {
  Count<T> c = before;
  if (!(swing > T(0.0))) return c;
  if (c.direction == T(0.0)) {
    if (u - c.extreme > swing || c.extreme - u > swing) {
      c.direction = u > c.extreme ? T(1.0) : T(-1.0);
      c.extreme = u;
    }
    return c;
  }
  if (c.direction * (u - c.extreme) >= T(0.0)) {
    c.extreme = u;
  } else if (c.direction * (c.extreme - u) > swing) {
    c.direction = -c.direction;
    c.extreme = u;
    c.cycles += T(0.5);
  }
  return c;
}

}  // namespace hysteron::ageing
