// Decides the block "disturbance_observer". Does not decide its law: models/sampled/disturbance_observer.h.
#pragma once

#include "engine/block/block.h"
#include "models/sampled/disturbance_observer.h"

namespace hysteron::blocks {

struct DisturbanceObserver {
  enum Parameter { inertia, corner, use, period };
  enum Input { command, speed };

  static void describe(Declaration& d);
  static Sizes sizes(const Shape& shape);
  template <class T>
  static void output(const View<T>& v) {
    v.out[1] = momentum_rate(v) - v.x[0];
    v.out[0] = v.choice(use) == 0 ? T{v.u[command] - v.out[1]} : v.u[command];
  }
  template <class T>
  static void update(const View<T>& v) {
    const T rate = momentum_rate(v);
    const T applied = v.choice(use) == 0 ? T{v.u[command] - rate + v.x[0]} : v.u[command];
    v.out[0] = v.x[0] + share(v) * (applied + rate - v.x[0]);
  }

 private:
  template <class T>
  static T share(const View<T>& v) {
    return disturbance_observer::share(v.parameter(corner), v.parameter(period));
  }
  template <class T>
  static T momentum_rate(const View<T>& v) {
    return disturbance_observer::momentum_rate(v.parameter(inertia), share(v), v.parameter(period), v.u[speed]);
  }
};

Kernel disturbance_observer_block();

}  // namespace hysteron::blocks
