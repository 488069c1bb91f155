// Decides the block "thermal_network": temperatures of n bodies. Does not decide its law:
// models/linear/thermal_network.h.
#pragma once

#include <string>

#include "engine/block/block.h"
#include "models/linear/thermal_network.h"

namespace hysteron::blocks {

struct ThermalNetwork {
  enum Parameter { capacities, to_ambient, between, initial };

  static void describe(Declaration& d);
  static Sizes sizes(const Shape& shape);
  template <class T>
  static thermal_network::Network<T> network(const View<T>& v) {
    return {v.list(capacities), v.list(to_ambient), v.list(between)};
  }
  template <class T>
  static void output(const View<T>& v) {
    for (int i = 0; i < v.n_x; ++i) v.out[i] = v.x[i];
  }
  // Inputs: the heat of each body, then the ambient temperature.
  template <class T>
  static void derivative(const View<T>& v) {
    const auto n = static_cast<std::size_t>(v.n_x);
    thermal_network::rates(network(v), v.states(), v.inputs().first(n), v.u[n], v.out);
  }
  static void rest(const View<double>& v);
  static void initial_states(const View<double>& v);
};

Kernel thermal_network_block();

}  // namespace hysteron::blocks
