#include "blocks/measurement/wheatstone_bridge.h"

namespace hysteron::blocks {

namespace {

constexpr char source[] = "thesis Eqs. 3.1, 3.2 as corrected; two gauges in opposite arms, two fixed resistors";

template <class Spec, class Params>
void bridge_parameters(Spec& spec) {
  spec.param(&Params::supply, "supply", "V", "supply (excitation) voltage of the bridge").positive();
  spec.param(&Params::resistance, "resistance", "ohm",
             "resistance of each fixed resistor, and of each unstrained gauge")
      .positive();
  spec.param(&Params::gauge_factor, "gauge_factor", "", "gauge factor: relative change of resistance per strain")
      .positive();
}

}  // namespace

void WheatstoneBridge::describe(BlockSpec<WheatstoneBridge>& spec) {
  spec.name("wheatstone_bridge", "Wheatstone bridge with two strain gauges in opposite arms")
      .in_group("measurement")
      .elementwise()
      .at("measured");
  spec.law("u = supply (resistance - gauge)/(resistance + gauge), gauge = resistance (1 + gauge_factor strain)")
      .from(source);
  spec.remark("A positive strain (elongation) gives a negative voltage.");
  spec.input(&In<double>::strain, "strain", "", "strain of both gauges");
  spec.output(&Out<double>::u, "u", "V", "bridge voltage, between the two dividers");
  spec.output(&Out<double>::gauge, "gauge", "ohm", "resistance of each gauge");
  bridge_parameters<BlockSpec<WheatstoneBridge>, Params<double>>(spec);
}

void WheatstoneBridgeInverse::describe(BlockSpec<WheatstoneBridgeInverse>& spec) {
  spec.name("wheatstone_bridge_inverse", "strain from the voltage of a wheatstone_bridge")
      .in_group("measurement")
      .elementwise();
  spec.law("gauge = resistance (2 supply/(supply + u) - 1), strain = (gauge/resistance - 1)/gauge_factor").from(source);
  spec.remark("Takes the parameters of the wheatstone_bridge that it reads.");
  spec.input(&In<double>::u, "u", "V", "bridge voltage, between the two dividers");
  spec.output(&Out<double>::strain, "strain", "", "strain of both gauges");
  spec.output(&Out<double>::gauge, "gauge", "ohm", "resistance of each gauge");
  bridge_parameters<BlockSpec<WheatstoneBridgeInverse>, Params<double>>(spec);
}

Kernel wheatstone_bridge_block() { return kernel<WheatstoneBridge>(); }
Kernel wheatstone_bridge_inverse_block() { return kernel<WheatstoneBridgeInverse>(); }

}  // namespace hysteron::blocks
