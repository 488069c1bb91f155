#include "blocks/linear/thermal_network.h"

#include <fmt/format.h>

#include <algorithm>

namespace hysteron::blocks {

void ThermalNetwork::describe(Declaration& d) {
  d.name("thermal_network", "lumped thermal network: temperatures of bodies that exchange heat")
      .in_group("linear")
      .linear();
  d.law("capacities_i dT_i/dt = heat_i + to_ambient_i (ambient - T_i) + sum_j between_ij (T_j - T_i)")
      .from("Incropera, DeWitt, Fundamentals of Heat and Mass Transfer, 6th ed. (2007), chapter 5 (lumped capacities)");
  d.remark(
      "capacities, to_ambient and initial have one number per body; between has one per pair: (1,2), (1,3) "
      "... (2,3) ... Leave it out for a single body; write 0 for bodies that are not in contact.");
  d.remark("heat is a vector with one element per body: join single signals with a \"mux\".");
  d.remark(
      "Where a simulation starts in steady state, initial has no effect; a body without a path to the "
      "ambient has no steady state.");
  d.input("heat", "W", "heat flow into each body").vector();
  d.input("ambient", "K", "ambient temperature");
  d.output("temperature", "K", "temperature of each body").vector();
  d.state("temperature", "K", "temperature of each body").nominal(300);
  d.list("capacities", "J/K", "heat capacity of each body").positive().difference();
  d.list("to_ambient", "W/K", "thermal conductance of each body to the ambient")
      .not_negative()
      .difference()
      .as_long_as("capacities");
  d.list("between", "W/K", "thermal conductance of each pair of bodies").optional("").not_negative().difference();
  d.list("initial", "K", "initial temperature of each body").as_long_as("capacities");
}

Sizes ThermalNetwork::sizes(const Shape& shape) {
  Sizes s;
  const int n = shape.length("capacities");
  const auto pairs = static_cast<int>(thermal_network::pairs(static_cast<std::size_t>(n)));
  s.states = s.outputs = n;
  s.feedthrough = false;
  s.output_lengths = {n};
  s.input_lengths = {n, 1};
  s.lengths_from = fmt::format("it has {} {}", n, n == 1 ? "body" : "bodies");
  if (n < 1)
    s.error = "\"capacities\" is empty; give one per body";
  else if (shape.length("between") != pairs)
    s.error = fmt::format("{} bodies have {} pairs, \"between\" has {} numbers; give one conductance per pair", n,
                          pairs, shape.length("between"));
  return s;
}

void ThermalNetwork::rest(const View<double>& v) {
  const auto n = static_cast<std::size_t>(v.n_x);
  thermal_network::rest(network(v), v.inputs().first(n), v.u[n], v.out);
}

void ThermalNetwork::initial_states(const View<double>& v) { std::copy_n(v.list(initial).data(), v.n_x, v.out); }

Kernel thermal_network_block() { return kernel<ThermalNetwork>(); }

}  // namespace hysteron::blocks
