#include "blocks/math/dead_zone.h"

#include <fmt/format.h>

namespace hysteron::blocks {

void DeadZone::describe(BlockSpec<DeadZone>& spec) {
  spec.name("dead_zone", "dead zone: 0 within the zone, the excess outside").in_group("math").elementwise();
  spec.law("y = u - max(lower, min(upper, u))").from("definition");
  spec.remark("It has no memory. For a joint with play use \"backlash\".");
  spec.input(&In<double>::u, "u", "$a", "the signal");
  spec.output(&Out<double>::y, "y", "$a", "the part of the signal beyond the zone");
  spec.param(&Params<double>::lower, "lower", "$a", "lower end of the zone");
  spec.param(&Params<double>::upper, "upper", "$a", "upper end of the zone");
}

std::string DeadZone::check(const Params<double>& p) {
  if (p.lower < p.upper) return "";
  return "lower, {lower}, is not below upper, {upper}; exchange them";
}

void Wrap::describe(BlockSpec<Wrap>& spec) {
  spec.name("wrap", "wraps a signal to one period, e.g. an angle to one turn").in_group("math").elementwise();
  spec.law("y = u - period floor((u - lower)/period): lower <= y < lower + period").from("definition");
  spec.remark("For an angle from -180 to 180 deg: \"period\": \"360 deg\", \"lower\": \"-180 deg\".");
  spec.remark(
      "The output jumps: put a block that is driven by the rate of its input (e.g. bouc_wen) before it, "
      "not after it.");
  spec.input(&In<double>::u, "u", "$a", "the signal");
  spec.output(&Out<double>::y, "y", "$a", "the wrapped signal");
  spec.param(&Params<double>::period, "period", "$a", "length of the period").positive().difference();
  spec.param(&Params<double>::lower, "lower", "$a", "lower end of the output range").optional("0");
}

Kernel dead_zone_block() { return kernel<DeadZone>(); }
Kernel wrap_block() { return kernel<Wrap>(); }

}  // namespace hysteron::blocks
