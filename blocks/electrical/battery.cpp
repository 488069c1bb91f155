#include "blocks/electrical/battery.h"

#include <algorithm>

namespace hysteron::blocks {

void BatteryCell::describe(Declaration& d) {
  d.name("battery_cell", "battery cell: open-circuit voltage, resistance and RC pairs").in_group("electrical");
  d.law(
       "d charge/dt = -current/capacity, dz_k/dt = (current - z_k)/times[k], voltage = open_circuit(charge) - resistance "
       "current - sum resistances[k] z_k")
      .from("Plett, Battery Management Systems I (2015), chapter 2");
  d.remark(
      "A discharge current is positive. The open-circuit curve is linear between its points and "
      "extrapolated beyond its ends, where a real cell would be damaged: watch the output \"charge\".");
  d.remark(
      "capacity is a charge in coulomb: 2.5 Ah is \"9000 C\". An RC pair has the capacitance "
      "times[k]/resistances[k].");
  d.input("current", "A", "current out of the cell (positive while it discharges)");
  d.output("voltage", "V", "voltage at the terminals");
  d.output("charge", "", "state of charge, 1 = full");
  d.state("x", "", "state of charge, then the current through the resistance of each RC pair");
  d.parameter("capacity", "C", "capacity: charge from full to empty, 1 Ah = 3600 C").positive();
  d.parameter("resistance", "ohm", "series (ohmic) resistance").linear().not_negative();
  d.list("charges", "", "state of charge at the points of the open-circuit curve, increasing").increasing();
  d.list("open_circuit", "V", "open-circuit voltage at these points").linear().as_long_as("charges");
  d.list("resistances", "ohm", "resistances of the RC pairs").optional("").linear().not_negative();
  d.list("times", "s", "time constants of the RC pairs").optional("").positive().as_long_as("resistances");
  d.parameter("initial", "", "initial state of charge").optional("1");
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
