#include "blocks/electrical/battery.h"

#include <algorithm>

namespace hysteron::blocks {

void BatteryCell::describe(Declaration& d) {
  d.name("battery_cell", "cell of a battery: open-circuit curve, resistance and RC pairs").in_group("electrical");
  d.law(
       "d charge/dt = -current/capacity, dz_k/dt = (current - z_k)/times[k], voltage = open_circuit(charge) - resistance "
       "current - sum resistances[k] z_k")
      .from("Plett, Battery Management Systems I (2015), chapter 2");
  d.remark(
      "A current out of the cell is positive. The curve is straight between its points and beyond its ends, where a real "
      "cell is destroyed: look at \"charge\".");
  d.remark(
      "Capacities are charges: 2.5 A for an hour is \"9000 C\". A pair has the capacitance times[k]/resistances[k].");
  d.input("current", "A", "current out of the cell");
  d.output("voltage", "V", "voltage at the terminals");
  d.output("charge", "", "state of charge, 1 = full");
  d.state("x", "", "state of charge, then the current through each resistance");
  d.parameter("capacity", "C", "charge from full to empty").positive();
  d.parameter("resistance", "ohm", "what acts at once").linear().not_negative();
  d.list("charges", "", "points of the open-circuit curve, increasing").increasing();
  d.list("open_circuit", "V", "voltage at these points").linear().as_long_as("charges");
  d.list("resistances", "ohm", "of the RC pairs").optional("").linear().not_negative();
  d.list("times", "s", "their time constants").optional("").positive().as_long_as("resistances");
  d.parameter("initial", "", "state of charge at the start").optional("1");
}

Sizes BatteryCell::sizes(const Shape& shape) {
  Sizes s;
  const int points = shape.length("charges"), pairs = shape.length("resistances");
  s.states = 1 + pairs;
  s.outputs = 2;
  s.kinks = std::max(points - 2, 0);
  if (points < 2 || shape.length("open_circuit") != points)
    s.error = "\"charges\" and \"open_circuit\" must be lists of one length, two at least; give one voltage per charge";
  else if (shape.length("times") != pairs)
    s.error = "\"resistances\" and \"times\" must be lists of one length; give one of each per RC pair";
  return s;
}

void BatteryCell::initial_states(const View<double>& v) {
  std::fill(v.out, v.out + v.n_x, 0.0);
  v.out[0] = v.parameter(initial);
}

void BatteryCell::kinks(const View<double>& v) {
  const auto points = v.list(charges);
  for (std::size_t k = 1; k + 1 < points.size(); ++k) v.out[k - 1] = v.x[0] - points[k];
}

Kernel battery_cell_block() { return kernel<BatteryCell>(); }

}  // namespace hysteron::blocks
