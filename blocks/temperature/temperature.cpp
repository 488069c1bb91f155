#include "blocks/temperature/temperature.h"

namespace hysteron::blocks {

namespace {

template <class B>
void ports(BlockSpec<B>& spec) {
  spec.in_group("temperature").elementwise();
  spec.input(&SignalAndTemperature<double>::u, "u", "$a", "the signal at the reference temperature");
  spec.input(&SignalAndTemperature<double>::temperature, "temperature", "K", "temperature that acts on it");
  spec.output(&WarmSignal<double>::y, "y", "$a", "the signal at this temperature");
}

template <class B>
void reference(BlockSpec<B>& spec) {
  spec.param(&B::template Params<double>::reference, "reference", "K", "temperature at which nothing is changed")
      .optional("20 degC");
}

}  // namespace

void TemperatureGain::describe(BlockSpec<TemperatureGain>& spec) {
  spec.name("temperature_gain", "gain that changes with temperature");
  spec.law("y = u (1 + sensitivity dT + curvature dT^2), dT = temperature - reference")
      .from("expansion about the reference; the gain of a piezo ceramic grows almost linearly near room temperature");
  ports(spec);
  spec.param(&Params<double>::sensitivity, "sensitivity", "1/K", "relative change of the gain per kelvin").linear();
  reference(spec);
  spec.param(&Params<double>::curvature, "curvature", "1/K^2", "relative change of the gain per squared kelvin")
      .optional("0")
      .linear();
}

void ThermalExpansion::describe(Declaration& d) {
  d.name("thermal_expansion", "offset that follows a temperature late")
      .in_group("temperature")
      .elementwise()
      .linear()
      .at("core");
  d.law("y = u + sum coefficients[k] (w_k - reference), times[k] dw_k/dt = temperature - w_k")
      .from("linear expansion, L alpha (T - T0), of parts with one thermal time constant each");
  d.input("u", "$a", "the signal at the reference temperature");
  d.input("temperature", "K", "temperature of the surroundings");
  d.output("y", "$a", "the signal at this temperature");
  d.state("w", "K", "temperature of each part").nominal(300);
  d.list("coefficients", "$a/K", "expansion of each part per kelvin: length times alpha").linear();
  d.list("times", "s", "time constant with which each part warms up").positive().as_long_as("coefficients");
  d.parameter("reference", "K", "temperature at which nothing is changed").optional("20 degC");
}

Sizes ThermalExpansion::sizes(const Shape& shape) {
  Sizes s;
  s.states = shape.length("times");
  if (s.states < 1 || s.states != shape.length("coefficients"))
    s.error = "\"coefficients\" and \"times\" must be lists of one length; give one coefficient per time constant";
  return s;
}

Kernel temperature_gain_block() { return kernel<TemperatureGain>(); }
void PyroCharge::describe(BlockSpec<PyroCharge>& spec) {
  spec.name("pyro_charge", "charge that a change of temperature makes, and that leaks away")
      .in_group("temperature")
      .elementwise()
      .linear()
      .at("command");
  spec.law("y = u + w, dw/dt = coefficient dT/dt - w/time; kept as w = coefficient (T - T_s), time dT_s/dt = T - T_s")
      .from("pyroelectric charge q = p A dT on C with R_leak: Lang, Phys. Today 58-8 (2005) 31");
  spec.remark("Behind a voltage amplifier the charge is taken away at once: then there is none of it.");
  spec.input(&In<double>::u, "u", "$a", "the drive");
  spec.input(&In<double>::temperature, "temperature", "K", "of the ceramics");
  spec.state(&State<double>::forgotten, "forgotten", "K", "temperature whose charge has leaked away").nominal(300);
  spec.output(&Out<double>::y, "y", "$a", "what acts on the ceramics");
  spec.param(&Params<double>::coefficient, "coefficient", "$a/K", "p A/C: of the open electrodes").linear();
  spec.param(&Params<double>::time, "time", "s", "R_leak C, or one over the cut-off of a charge drive").positive();
}

Kernel pyro_charge_block() { return kernel<PyroCharge>(); }
Kernel thermal_expansion_block() { return kernel<ThermalExpansion>(); }

}  // namespace hysteron::blocks
