#include "blocks/hysteresis/maxwell_capacitor.h"

#include "blocks/hysteresis/prandtl_ishlinskii.h"

namespace hysteron::blocks {

void MaxwellCapacitor::describe(Declaration& d) {
  d.name("maxwell_capacitor", "Maxwell resistive capacitor: hysteresis of voltage against charge")
      .in_group("hysteresis");
  d.law("u = sum elastances[i] (q - w_i), w_i = max(q - yield_charges[i], min(q + yield_charges[i], w_i before))")
      .from("Goldfarb, Celanovic, IEEE Control Syst. 17 (1997) no. 3, 69-79; thesis Eq. 5.8");
  d.remark(
      "An elastance is 1/C_i. The charge on each element is limited to its yield charge, where it slips "
      "like a Coulomb friction element.");
  d.remark("Used in series with a capacitor and a transducer in diagrams/stages/electromechanical.json.");
  d.remembers("q", "the charge w_i by which each element has slipped");
  d.input("q", "C", "charge that has flowed through all elements");
  d.output("u", "V", "voltage across all elements");
  d.list("yield_charges", "C", "largest charge on each element, where it begins to slip")
      .increasing()
      .positive()
      .difference();
  d.list("elastances", "1/F", "elastance of each element, 1/C_i")
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
