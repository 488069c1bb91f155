// Decides the voltage of a cell: its open-circuit curve and what currents add. Does not decide its temperature.
#pragma once

#include <cstddef>
#include <span>

namespace hysteron::battery {

/// d(charge)/dt [1/s] for a current [A] out of the cell; charge 1 = full, capacity [A s].
template <class T>
T charge_rate(const T& capacity, const T& current) {
  return -current / capacity;
}

/// A pair of resistance and capacitance in series with the cell, as its current through the resistance: z' = (i -
/// z)/tau [A/s]; it takes R z [V].
template <class T>
T pair_rate(const T& time, const T& current, const T& z) {
  return (current - z) / time;
}

/// Open-circuit voltage [V] at a charge: straight between the points of the curve, and on beyond its ends.
/// At least two points, charges increasing. Source: Plett, Battery Management Systems I (2015), chapter 2.
template <class T>
T open_circuit(std::span<const T> charges, std::span<const T> voltages, const T& charge) {
  std::size_t k = 1;
  while (k + 1 < charges.size() && charge > charges[k]) ++k;
  const T share = (charge - charges[k - 1]) / (charges[k] - charges[k - 1]);
  return voltages[k - 1] + share * (voltages[k] - voltages[k - 1]);
}

}  // namespace hysteron::battery
