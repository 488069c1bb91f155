// Decides the blocks through which a measured temperature acts on a signal: "temperature_gain" on its size,
// "thermal_expansion" on its middle, "pyro_charge" while it changes. Does not compute temperatures: thermal_network
// does.
#pragma once

#include "engine/block/block.h"
#include "models/continuous/creep.h"

namespace hysteron::blocks {

template <class T>
struct SignalAndTemperature {
  T u, temperature;
};
template <class T>
struct WarmSignal {
  T y;
};

struct TemperatureGain {
  template <class T>
  struct Params {
    T sensitivity, reference, curvature;
  };
  template <class T>
  using In = SignalAndTemperature<T>;
  template <class T>
  using Out = WarmSignal<T>;
  static void describe(BlockSpec<TemperatureGain>& spec);
  template <class T>
  static Out<T> output(const Params<T>& p, const In<T>& in) {
    const T warmer = in.temperature - p.reference;
    return {in.u * (1.0 + warmer * (p.sensitivity + p.curvature * warmer))};
  }
};

struct ThermalExpansion {
  enum Parameter { coefficients, times, reference };

  static void describe(Declaration& d);
  static Sizes sizes(const Shape& shape);
  template <class T>
  static void output(const View<T>& v) {
    const auto c = v.list(coefficients);
    T y = v.u[0];
    for (std::size_t k = 0; k < c.size(); ++k) y += c[k] * (v.x[k] - v.parameter(reference));
    v.out[0] = y;
  }
  template <class T>
  static void derivative(const View<T>& v) {
    const auto tau = v.list(times);
    for (std::size_t k = 0; k < tau.size(); ++k) v.out[k] = creep::relaxation_rate(tau[k], v.x[k], v.u[1]);
  }
  static void rest(const View<double>& v) {
    for (int k = 0; k < v.n_x; ++k) v.out[k] = v.u[1];
  }
};

Kernel temperature_gain_block();
struct PyroCharge {
  template <class T>
  struct Params {
    T coefficient, time;
  };
  template <class T>
  using In = SignalAndTemperature<T>;
  template <class T>
  struct State {
    T forgotten;
  };
  template <class T>
  using Out = WarmSignal<T>;
  static void describe(BlockSpec<PyroCharge>& spec);
  template <class T>
  static Out<T> output(const Params<T>& p, const State<T>& s, const In<T>& in) {
    return {in.u + p.coefficient * (in.temperature - s.forgotten)};
  }
  template <class T>
  static State<T> derivative(const Params<T>& p, const State<T>& s, const In<T>& in) {
    return {creep::relaxation_rate(p.time, s.forgotten, in.temperature)};
  }
  static State<double> rest(const Params<double>&, const In<double>& in) { return {in.temperature}; }
};

Kernel thermal_expansion_block();
Kernel pyro_charge_block();

}  // namespace hysteron::blocks
