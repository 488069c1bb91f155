#include "blocks/sources/pulse.h"

#include <fmt/format.h>

#include <cmath>

namespace hysteron::blocks {

void Pulse::describe(BlockSpec<Pulse>& spec) {
  spec.name("pulse", "rectangular pulses, or a square wave").in_group("sources");
  spec.law("y = high for time + k period <= t < time + (k + duty) period, k = 0, 1 ..., else low").from("definition");
  spec.remark("For a symmetric square wave use \"duty\": 0.5 and low = -high.");
  spec.remark(
      "The output jumps: a block that is driven by the rate of its input (e.g. bouc_wen) needs a lag in "
      "between.");
  spec.output(&Out<double>::y, "y", "$a", "the signal");
  spec.param(&Params<double>::low, "low", "$a", "level before, between and after the pulses").optional("0").offset();
  spec.param(&Params<double>::high, "high", "$a", "level during the pulses").offset();
  spec.param(&Params<double>::period, "period", "s", "period: from the start of one pulse to that of the next")
      .positive();
  spec.param(&Params<double>::duty, "duty", "", "duty cycle: pulse length over period, between 0 and 1")
      .optional("0.5")
      .positive();
  spec.param(&Params<double>::time, "time", "s", "start of the first pulse").optional("0 s");
  spec.param(&Params<double>::pulses, "pulses", "", "number of pulses; 0 = unlimited").optional("0").not_negative();
}

std::string Pulse::check(const Params<double>& p) {
  if (!(p.duty < 1))
    return fmt::format("a duty of {:.4g} leaves no time between the pulses; write less than 1, e.g. 0.5", p.duty);
  if (p.pulses != std::floor(p.pulses))
    return fmt::format("{} is not a number of pulses; write a whole number, or 0 for unlimited", p.pulses);
  return "";
}

void Trapezoid::describe(BlockSpec<Trapezoid>& spec) {
  spec.name("trapezoid", "trapezoidal pulse, single or periodic").in_group("sources");
  spec.law(
          "rises linearly from low to high in rise, stays at high for top, falls linearly to low in fall; "
          "starts at time + k period, k = 0, 1 ...; low in between")
      .from("the pulse of SPICE 3f.5, User's Manual, section 3.2.1.1");
  spec.remark(
      "For rectangular pulses use \"pulse\", for a motion with limited velocity and acceleration "
      "\"motion_profile\".");
  spec.output(&Out<double>::y, "y", "$a", "the signal");
  spec.param(&Params<double>::low, "low", "$a", "level before, between and after the pulses").optional("0").offset();
  spec.param(&Params<double>::high, "high", "$a", "level of the flat top").offset();
  spec.param(&Params<double>::rise, "rise", "s", "rise time from low to high").positive();
  spec.param(&Params<double>::top, "top", "s", "duration at high").not_negative();
  spec.param(&Params<double>::fall, "fall", "s", "fall time from high to low").positive();
  spec.param(&Params<double>::period, "period", "s",
             "period: from the start of one pulse to that of the next; inf = a single pulse")
      .optional("inf s")
      .positive();
  spec.param(&Params<double>::time, "time", "s", "start of the first pulse").optional("0 s");
}

std::string Trapezoid::check(const Params<double>& p) {
  const double length = p.rise + p.top + p.fall;
  if (p.period >= length * (1 - 1e-12)) return "";
  return fmt::format("rise, top and fall take {:.4g} s, more than the period, {:.4g} s; give a longer period", length,
                     p.period);
}

Kernel pulse_block() { return kernel<Pulse>(); }
Kernel trapezoid_block() { return kernel<Trapezoid>(); }

}  // namespace hysteron::blocks
