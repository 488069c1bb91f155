// Decides the block "impedance_estimator": windows, what is kept between samples, and what is told when one is full.
// Does not decide the laws: models/sampled/impedance.h.
#pragma once

#include <numbers>
#include <string>

#include "engine/block/block.h"
#include "models/sampled/impedance.h"

namespace hysteron::blocks {

struct ImpedanceEstimator {
  enum Parameter { samples, cycles, layers, area, thickness, initial, phasors, period };
  enum Input { voltage, current };
  /// Sums over the present window, then what the last full one has told.
  enum State { voltage_a, voltage_b, current_a, current_b, sum, capacitance, mean, polarisation, count };

  static void describe(Declaration& d);
  static Sizes sizes(const Shape& shape);
  static std::string check(const View<double>& v);
  static void initial_states(const View<double>& v);

  template <class T>
  static impedance::Stack<T> stack(const View<T>& v) {
    return {v.parameter(layers), v.parameter(area), v.parameter(thickness)};
  }
  template <class T>
  static void output(const View<T>& v) {
    v.out[0] = v.x[capacitance];
    v.out[1] = v.x[mean];
    v.out[2] = impedance::secant_polarisation(stack(v), v.x[capacitance], v.x[mean]);
    v.out[3] = v.x[polarisation];
  }
  template <class T>
  static void update(const View<T>& v) {
    const int n = v.choice(samples), k = static_cast<int>(v.hit % n);
    const auto share = v.choice(phasors) == 0 ? impedance::share(k, n, v.choice(cycles))
                                              : impedance::fourier_share(k, n, v.choice(cycles));
    const auto add = [&](State s, double of_sample, const T& signal) {
      v.out[s] = (k == 0 ? T{0} : v.x[s]) + T{of_sample} * signal;
    };
    for (int i = 0; i < count; ++i) v.out[i] = v.x[i];
    add(voltage_a, share.a, v.u[voltage]);
    add(voltage_b, share.b, v.u[voltage]);
    add(current_a, share.a, v.u[current]);
    add(current_b, share.b, v.u[current]);
    add(sum, 1, v.u[voltage]);
    if (k == n - 1) end_window(v, n);
  }

 private:
  template <class T>
  static void end_window(const View<T>& v, int n) {
    const T w = T{2 * std::numbers::pi * v.choice(cycles) / n} / v.parameter(period);
    v.out[capacitance] = impedance::capacitance(w, impedance::Phasor<T>{v.out[current_a], v.out[current_b]},
                                                impedance::Phasor<T>{v.out[voltage_a], v.out[voltage_b]});
    v.out[mean] = v.out[sum] / T(n);
    if (v.hit >= n)  // the first window has none before it to grow from
      v.out[polarisation] +=
          impedance::polarisation_growth(stack(v), v.x[capacitance], v.out[capacitance], v.x[mean], v.out[mean]);
  }
};

Kernel impedance_estimator_block();

}  // namespace hysteron::blocks
