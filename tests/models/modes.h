// Decides how tests move a model with modes through time: small Runge-Kutta steps, events located by bisection.
// Does not compete with the engine: it is slow and simple, to be an independent witness.
#pragma once

#include <cmath>
#include <functional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace hysteron::modes {

using Numbers = std::vector<double>;

struct System {
  std::function<Numbers(int mode, double t, const Numbers& x)> rate;
  std::function<double(int mode, double t, const Numbers& x)> guard;
  std::function<void(int& mode, double t, Numbers& x)> land;  ///< what follows where the guard is not positive
};

struct Event {
  double t;
  int before, after;
};

struct Walk {
  System system;
  double step;
  double t;
  int mode;
  Numbers x;
  std::vector<Event> events{};

  Numbers tried(double h) const {
    const auto add = [](Numbers a, double s, const Numbers& b) {
      for (std::size_t i = 0; i < a.size(); ++i) a[i] += s * b[i];
      return a;
    };
    const Numbers k1 = system.rate(mode, t, x), k2 = system.rate(mode, t + h / 2, add(x, h / 2, k1)),
                  k3 = system.rate(mode, t + h / 2, add(x, h / 2, k2)), k4 = system.rate(mode, t + h, add(x, h, k3));
    return add(add(add(add(x, h / 6, k1), h / 3, k2), h / 3, k3), h / 6, k4);
  }
  void settle() {
    for (int round = 0; system.guard(mode, t, x) <= 0; ++round) {
      const int before = mode;
      const Numbers at = x;
      system.land(mode, t, x);
      if (mode != before || x != at) events.push_back({t, before, mode});
      if (mode == before && x == at) return;
      if (round > 20) throw std::runtime_error("modes do not settle");
    }
  }
  void until(double end) {
    settle();
    while (t < end) {
      double h = std::fmin(step, end - t);
      const auto good = [&](double d) { return system.guard(mode, t + d, tried(d)) > 0; };
      if (!good(h)) {  // a mode that has just begun may start on its guard: look for a moment at which it may stay
        double low = system.guard(mode, t, x) > 0 ? 0 : h / 2;
        while (low > 1e-12 * h && !good(low)) low /= 2;
        if (low == 0 || good(low))
          for (int i = 0; i < 60; ++i) (good((low + h) / 2) ? low : h) = (low + h) / 2;
      }
      x = tried(h);
      t += h;
      if (end - t < 1e-15 * end) t = end;
      settle();
    }
  }
};

}  // namespace hysteron::modes
