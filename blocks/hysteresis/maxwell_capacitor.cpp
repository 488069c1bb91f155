#include "blocks/hysteresis/maxwell_capacitor.h"

#include "blocks/hysteresis/prandtl_ishlinskii.h"

namespace hysteron::blocks {

void MaxwellCapacitor::describe(Declaration& d) {
  d.name("maxwell_capacitor", "Maxwell resistive capacitor: hysteresis between charge and voltage")
      .in_group("hysteresis");
  d.law("u = sum elastances[i] (q - w_i), w_i = max(q - yield_charges[i], min(q + yield_charges[i], w_i before))")
      .from("Goldfarb, Celanovic, IEEE Control Syst. 17 (1997) no. 3, 69-79; thesis Eq. 5.8");
  d.remark(
      "An elastance is 1/C_i. Each element holds at most its yield charge; what it has held stays in its voltage.");
  d.remark(
      "In series with a capacitor and a transducer it makes the circuit of diagrams/stages/electromechanical.json.");
  d.remembers("q", "the charge w_i by which each element has yielded");
  d.input("q", "C", "charge that has passed");
  d.output("u", "V", "voltage across all elements");
  d.list("yield_charges", "C", "largest charge that each element holds").increasing().positive().difference();
  d.list("elastances", "1/F", "voltage per charge of each element, 1/C_i")
      .not_negative()
      .linear()
      .difference()
      .as_long_as("yield_charges");
}

Sizes MaxwellCapacitor::sizes(const Shape& shape) {
  Sizes s;
  s.memory = shape.length("yield_charges");
  if (s.memory < 1 || s.memory != shape.length("elastances"))
    s.error = "\"yield_charges\" and \"elastances\" must be lists of one length; give one elastance per yield charge";
  return s;
}

std::string MaxwellCapacitor::check_memory(const View<double>& v) {
  return check_nested(play::Sides::two, v.list(yield_charges), v.memory());
}

Kernel maxwell_capacitor_block() { return kernel<MaxwellCapacitor>(); }

}  // namespace hysteron::blocks
