#include "blocks/sampled/impedance_estimator.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hysteron::blocks {

void ImpedanceEstimator::describe(Declaration& d) {
  d.name("impedance_estimator", "capacitance and polarisation of a stack from a ripple on its voltage")
      .in_group("sampled");
  d.law(
       "per window: phasors (A, B) of voltage and current by least squares of 1, t, cos, sin; C = -(A_I^2 + "
       "B_I^2)/(w (A_I B_V - A_V B_I)); secant = (C d/(N A) - eps_0) E; polarisation = initial + integral of (C d/(N "
       "A) "
       "- eps_0) dE, E = voltage/d")
      .from("thesis Eqs. 3.5 to 3.8; the joint fit and the integral stand in place of a Fourier bin and of the secant");
  d.remark(
      "A window has a whole number of ripples: 200 samples of 0.1 ms with \"cycles\": 1 are for 50 Hz. Outputs are "
      "those "
      "of the last full window, zero before there is one.");
  d.remark(
      "A ripple measures the incremental capacitance. The secant formula of the thesis is right for a linear material "
      "only: in a loop of hysteresis its polarisation turns the wrong way round; the integral does not.");
  d.remark(
      "A ripple steeper than the drive reverses the field twice in each cycle and lets a Jiles-Atherton material creep "
      "towards its curve without pinning.");
  d.remark(
      "phasors \"fourier\", as the thesis takes them, count the ramp of the drive as a ripple and make false loops.");
  d.input("voltage", "V", "across the stack, ripple included");
  d.input("current", "A", "into the stack");
  d.output("capacitance", "F", "incremental capacitance of the stack");
  d.output("voltage", "V", "mean over the window");
  d.output("secant", "C/m^2", "polarisation by the secant formula");
  d.output("polarisation", "C/m^2", "polarisation by the integral");
  d.state("voltage_a", "V", "phasor of the voltage so far, in phase with the middle of the window");
  d.state("voltage_b", "V", "phasor of the voltage so far, a quarter ahead");
  d.state("current_a", "A", "phasor of the current so far, in phase");
  d.state("current_b", "A", "phasor of the current so far, a quarter ahead");
  d.state("sum", "V", "sum of the voltages so far");
  d.state("capacitance", "F", "of the last window");
  d.state("mean", "V", "voltage of the last window");
  d.state("polarisation", "C/m^2", "by the integral, up to the last window");
  d.parameter("samples", "", "whole number of samples per window").minimum = 5;
  d.parameter("cycles", "", "whole number of ripples per window").optional("1").minimum = 1;
  d.parameter("layers", "", "wafers of the stack, side by side electrically").positive();
  d.parameter("area", "m^2", "area of one wafer").positive();
  d.parameter("thickness", "m", "thickness of one wafer").positive();
  d.parameter("initial", "C/m^2", "polarisation in the first window").optional("0 C/m^2").difference();
  d.text("phasors", {"joint", "fourier"}, "fitted together with a ramp, or the Fourier coefficient of the window");
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
    return fmt::format("{:.4g} samples with {:.4g} ripples are no window; give whole numbers", n, ripples);
  if (2 * ripples >= n)
    return fmt::format("{:.4g} samples cannot tell {:.4g} ripples apart; give more than two samples per ripple", n,
                       ripples);
  return "";
}

void ImpedanceEstimator::initial_states(const View<double>& v) {
  std::fill(v.out, v.out + count, 0.0);
  v.out[polarisation] = v.parameter(initial);
}

Kernel impedance_estimator_block() { return kernel<ImpedanceEstimator>(); }

}  // namespace hysteron::blocks
