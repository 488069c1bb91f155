// Decides the block "battery_cell". Does not decide its law: models/electrical/battery.h.
#pragma once

#include <string>

#include "engine/block/block.h"
#include "models/electrical/battery.h"

namespace hysteron::blocks {

struct BatteryCell {
  enum Parameter { capacity, resistance, charges, open_circuit, resistances, times, initial };
  // States: the charge, then the current through the resistance of each pair.

  static void describe(Declaration& d);
  static Sizes sizes(const Shape& shape);
  static void initial_states(const View<double>& v);
  static void kinks(const View<double>& v);

  template <class T>
  static void output(const View<T>& v) {
    T voltage = battery::open_circuit(v.list(charges), v.list(open_circuit), v.x[0]) - v.parameter(resistance) * v.u[0];
    const auto pairs = v.list(resistances);
    for (std::size_t k = 0; k < pairs.size(); ++k) voltage -= pairs[k] * v.x[k + 1];
    v.out[0] = voltage;
    v.out[1] = v.x[0];
  }
  template <class T>
  static void derivative(const View<T>& v) {
    const auto tau = v.list(times);
    v.out[0] = battery::charge_rate(v.parameter(capacity), v.u[0]);
    for (std::size_t k = 0; k < tau.size(); ++k) v.out[k + 1] = battery::pair_rate(tau[k], v.u[0], v.x[k + 1]);
  }
};

Kernel battery_cell_block();

}  // namespace hysteron::blocks
