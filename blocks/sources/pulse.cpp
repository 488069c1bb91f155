#include "blocks/sources/pulse.h"

#include <fmt/format.h>

#include <cmath>

namespace hysteron::blocks {

void Pulse::describe(BlockSpec<Pulse>& spec) {
  spec.name("pulse", "rectangular pulses, or a square wave").in_group("sources");
  spec.law("y = high for time + k period <= t < time + (k + duty) period, k = 0, 1 ..., else low").from("definition");
  spec.remark("A square wave is \"duty\": 0.5 with \"low\": the opposite of high.");
  spec.remark("It jumps: a law that is driven by the rate of its input (bouc_wen) needs a lag in between.");
  spec.output(&Out<double>::y, "y", "$a", "the signal");
  spec.param(&Params<double>::low, "low", "$a", "level before, between and behind the pulses").optional("0").offset();
  spec.param(&Params<double>::high, "high", "$a", "level of the pulses").offset();
  spec.param(&Params<double>::period, "period", "s", "from the begin of a pulse to that of the next").positive();
  spec.param(&Params<double>::duty, "duty", "", "share of the period that a pulse lasts, between 0 and 1")
      .optional("0.5")
      .positive();
  spec.param(&Params<double>::time, "time", "s", "begin of the first pulse").optional("0 s");
  spec.param(&Params<double>::pulses, "pulses", "", "how many; 0 = for ever").optional("0").not_negative();
}

std::string Pulse::check(const Params<double>& p) {
  if (!(p.duty < 1))
    return fmt::format("a duty of {:.4g} leaves nothing between the pulses; write less than 1, e.g. 0.5", p.duty);
  if (p.pulses != std::floor(p.pulses))
    return fmt::format("{} is no number of pulses; write a whole number, or 0 for pulses without end", p.pulses);
  return "";
}

void Trapezoid::describe(BlockSpec<Trapezoid>& spec) {
  spec.name("trapezoid", "pulses that rise and fall in straight lines, one or over and over").in_group("sources");
  spec.law(
          "from low to high within rise, stays for top, back within fall; again at time + k period, k = 0, 1 ...; low "
          "in between")
      .from("the pulse of SPICE 3f.5, User's Manual, section 3.2.1.1");
  spec.remark("Pulses that jump are \"pulse\". A move within limits of speed and acceleration is \"motion_profile\".");
  spec.output(&Out<double>::y, "y", "$a", "the signal");
  spec.param(&Params<double>::low, "low", "$a", "level before, between and behind").optional("0").offset();
  spec.param(&Params<double>::high, "high", "$a", "level of the top").offset();
  spec.param(&Params<double>::rise, "rise", "s", "how long it rises").positive();
  spec.param(&Params<double>::top, "top", "s", "how long it stays at high").not_negative();
  spec.param(&Params<double>::fall, "fall", "s", "how long it falls").positive();
  spec.param(&Params<double>::period, "period", "s", "from one begin to the next; inf = once")
      .optional("inf s")
      .positive();
  spec.param(&Params<double>::time, "time", "s", "begin of the first").optional("0 s");
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
