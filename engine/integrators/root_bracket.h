// Decides how the first instant is found at which one of several functions has lost its sign. Does not know what the
// functions are.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace hysteron {

/// The functions that are watched at one instant: positive while nothing has happened.
struct WatchedValues {
  double t = 0;  ///< [s]
  std::vector<double> g{};
};

/// Two times that cannot be told apart inside of a step [begin, end] [s]: what CVODE's own root finding takes.
inline double root_width(double begin, double end) {
  return 100 * std::numeric_limits<double>::epsilon() * (std::abs(end) + (end - begin));
}

/// Shrinks the bracket until it is no wider than `enough` [s]. At `a` no function has fallen, at `b` some have; of
/// those that had fallen before the bracket (g not positive at the first `a`) nothing is asked. Secants of those that
/// fell, the earliest first; halving wherever a secant gained less (regula falsi with bisection as its safeguard).
/// evaluate(t, g) writes the functions at t and returns a negative flag to give up, which is handed on; else 0.
template <class Evaluate>
int first_root(WatchedValues& a, WatchedValues& b, double enough, Evaluate evaluate) {
  const auto start = a.g;
  WatchedValues trial;
  trial.g.resize(start.size());
  const auto falls = [&](const std::vector<double>& g) {
    for (std::size_t i = 0; i < g.size(); ++i)
      if (start[i] > 0 && g[i] <= 0) return true;
    return false;
  };
  bool halve = false;
  while (b.t - a.t > enough) {
    double t = b.t;
    for (std::size_t i = 0; i < start.size(); ++i)
      if (start[i] > 0 && b.g[i] <= 0) t = std::min(t, a.t + (b.t - a.t) * a.g[i] / (a.g[i] - b.g[i]));
    // A secant that hits the root from one side leaves the bracket long: aim a little past it.
    t = halve ? (a.t + b.t) / 2 : std::clamp(t + enough / 4, a.t + enough / 2, b.t - enough / 2);
    trial.t = t;
    if (const int flag = evaluate(t, trial.g); flag < 0) return flag;
    const double before = b.t - a.t;
    std::swap(falls(trial.g) ? b : a, trial);
    halve = b.t - a.t > before / 2;
  }
  return 0;
}

}  // namespace hysteron
