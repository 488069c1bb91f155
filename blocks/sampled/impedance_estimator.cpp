#include "blocks/sampled/impedance_estimator.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hysteron::blocks {

void ImpedanceEstimator::describe(Declaration& d) {
  d.name("impedance_estimator", "capacitance and polarisation of a piezo stack from a voltage ripple")
      .in_group("sampled");
  d.law(
       "per window: phasors (A, B) of voltage and current by least squares of 1, t, cos, sin; C = -(A_I^2 + "
       "B_I^2)/(w (A_I B_V - A_V B_I)); secant = (C d/(N A) - eps_0) E; polarisation = initial + integral of (C d/(N "
       "A) "
       "- eps_0) dE, E = voltage/d")
      .from("thesis Eqs. 3.5 to 3.8; the joint fit and the integral stand in place of a Fourier bin and of the secant");
  d.remark(
      "A window holds a whole number of ripple periods: 200 samples of 0.1 ms with \"cycles\": 1 suit a "
      "ripple of 50 Hz. The outputs are those of the last complete window, and zero before the first one "
      "is complete.");
  d.remark(
      "The ripple measures the incremental capacitance. The secant formula of the thesis is valid for a "
      "linear material only: for hysteresis it gives a loop with the wrong direction; the integral does "
      "not.");
  d.remark(
      "A ripple that is steeper than the drive reverses the field twice per cycle and makes a "
      "Jiles-Atherton material drift towards its anhysteretic curve.");
  d.remark(
      "With \"phasors\": \"fourier\", the method of the thesis, the ramp of the drive leaks into the "
      "ripple and causes false loops.");
  d.input("voltage", "V", "voltage across the stack, ripple included");
  d.input("current", "A", "current into the stack");
  d.output("capacitance", "F", "incremental capacitance of the stack");
  d.output("voltage", "V", "mean voltage over the window");
  d.output("secant", "C/m^2", "polarisation by the secant formula");
  d.output("polarisation", "C/m^2", "polarisation by the integral");
  d.state("voltage_a", "V", "voltage phasor accumulated so far, in phase with the middle of the window");
  d.state("voltage_b", "V", "voltage phasor accumulated so far, 90 deg ahead");
  d.state("current_a", "A", "current phasor accumulated so far, in phase");
  d.state("current_b", "A", "current phasor accumulated so far, 90 deg ahead");
  d.state("sum", "V", "sum of the voltages in the window so far");
  d.state("capacitance", "F", "capacitance of the last window");
  d.state("mean", "V", "mean voltage of the last window");
  d.state("polarisation", "C/m^2", "polarisation by the integral, up to the last window");
  d.parameter("samples", "", "whole number of samples per window").minimum = 5;
  d.parameter("cycles", "", "whole number of ripple periods per window").optional("1").minimum = 1;
  d.parameter("layers", "", "number of wafers of the stack, electrically in parallel").positive();
  d.parameter("area", "m^2", "area of one wafer").positive();
  d.parameter("thickness", "m", "thickness of one wafer").positive();
  d.parameter("initial", "C/m^2", "polarisation in the first window").optional("0 C/m^2").difference();
  d.text("phasors", {"joint", "fourier"},
         "joint: fitted together with a ramp; fourier: Fourier coefficient over the window");
  d.sampled();
}

Sizes ImpedanceEstimator::sizes(const Shape&) {
  Sizes s;
  s.sampled_states = count;
  s.outputs = 4;
  s.feedthrough = false;
  return s;
}

std::string ImpedanceEstimator::check(const View<double>& v) {
  const double n = v.parameter(samples), ripples = v.parameter(cycles);
  if (std::floor(n) != n || std::floor(ripples) != ripples)
    return fmt::format("a window of {:.4g} samples with {:.4g} ripple periods is not possible; give whole numbers", n,
                       ripples);
  if (2 * ripples >= n)
    return fmt::format(
        "{:.4g} samples cannot resolve {:.4g} ripple periods; give more than two samples per ripple period", n,
        ripples);
  return "";
}

void ImpedanceEstimator::initial_states(const View<double>& v) {
  std::fill(v.out, v.out + count, 0.0);
  v.out[polarisation] = v.parameter(initial);
}

Kernel impedance_estimator_block() { return kernel<ImpedanceEstimator>(); }

}  // namespace hysteron::blocks
