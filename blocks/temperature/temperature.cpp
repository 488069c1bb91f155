#include "blocks/temperature/temperature.h"

namespace hysteron::blocks {

namespace {

template <class B>
void ports(BlockSpec<B>& spec) {
  spec.in_group("temperature").elementwise();
  spec.input(&SignalAndTemperature<double>::u, "u", "$a", "the signal at the reference temperature");
  spec.input(&SignalAndTemperature<double>::temperature, "temperature", "K", "temperature of the device");
  spec.output(&WarmSignal<double>::y, "y", "$a", "the signal at the present temperature");
}

template <class B>
void reference(BlockSpec<B>& spec) {
  spec.param(&B::template Params<double>::reference, "reference", "K",
             "reference temperature, at which the signal is unchanged")
      .optional("20 degC");
}

}  // namespace

void TemperatureGain::describe(BlockSpec<TemperatureGain>& spec) {
  spec.name("temperature_gain", "gain that changes with temperature");
  spec.law("y = u (1 + sensitivity dT + curvature dT^2), dT = temperature - reference")
      .from("expansion about the reference; the gain of a piezo ceramic grows almost linearly near room temperature");
  ports(spec);
  spec.param(&Params<double>::sensitivity, "sensitivity", "1/K", "relative change of gain per kelvin").linear();
  reference(spec);
  spec.param(&Params<double>::curvature, "curvature", "1/K^2", "relative change of gain per kelvin squared")
      .optional("0")
      .linear();
}

void ThermalExpansion::describe(Declaration& d) {
  d.name("thermal_expansion", "thermal expansion: offset that follows a temperature with lags")
      .in_group("temperature")
      .elementwise()
      .linear()
      .at("core");
  d.law("y = u + sum coefficients[k] (w_k - reference), times[k] dw_k/dt = temperature - w_k")
      .from("linear expansion, L alpha (T - T0), of parts with one thermal time constant each");
  d.input("u", "$a", "the signal at the reference temperature");
  d.input("temperature", "K", "ambient temperature");
  d.output("y", "$a", "the signal at the present temperature");
  d.state("w", "K", "temperature of each part").nominal(300);
  d.list("coefficients", "$a/K", "expansion of each part per kelvin: length times expansion coefficient").linear();
  d.list("times", "s", "thermal time constant of each part").positive().as_long_as("coefficients");
  d.parameter("reference", "K", "reference temperature, at which the signal is unchanged").optional("20 degC");
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
  spec.name("pyro_charge", "pyroelectric charge, which leaks away")
      .in_group("temperature")
      .elementwise()
      .linear()
      .at("command");
  spec.law("y = u + w, dw/dt = coefficient dT/dt - w/time; kept as w = coefficient (T - T_s), time dT_s/dt = T - T_s")
      .from("pyroelectric charge q = p A dT on C with R_leak: Lang, Phys. Today 58-8 (2005) 31");
  spec.remark("With a voltage amplifier the charge is compensated at once: then the effect does not occur.");
  spec.input(&In<double>::u, "u", "$a", "the drive signal");
  spec.input(&In<double>::temperature, "temperature", "K", "temperature of the ceramic");
  spec.state(&State<double>::forgotten, "forgotten", "K", "temperature at which there would be no pyroelectric charge")
      .nominal(300);
  spec.output(&Out<double>::y, "y", "$a", "effective drive of the ceramic");
  spec.param(&Params<double>::coefficient, "coefficient", "$a/K", "voltage at open electrodes per kelvin: p A/C")
      .linear();
  spec.param(&Params<double>::time, "time", "s",
             "discharge time constant: R_leak C, or 1/(2 pi cut-off frequency) of a charge amplifier")
      .positive();
}

Kernel pyro_charge_block() { return kernel<PyroCharge>(); }
Kernel thermal_expansion_block() { return kernel<ThermalExpansion>(); }

}  // namespace hysteron::blocks
