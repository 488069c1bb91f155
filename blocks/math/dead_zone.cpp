#include "blocks/math/dead_zone.h"

#include <fmt/format.h>

namespace hysteron::blocks {

void DeadZone::describe(BlockSpec<DeadZone>& spec) {
  spec.name("dead_zone", "nothing within a zone, and what goes beyond it outside").in_group("math").elementwise();
  spec.law("y = u - max(lower, min(upper, u))").from("definition");
  spec.remark("A joint with play remembers where it was: \"backlash\".");
  spec.input(&In<double>::u, "u", "$a", "the signal");
  spec.output(&Out<double>::y, "y", "$a", "what goes beyond the zone");
  spec.param(&Params<double>::lower, "lower", "$a", "lower end of the zone");
  spec.param(&Params<double>::upper, "upper", "$a", "upper end of the zone");
}

std::string DeadZone::check(const Params<double>& p) {
  if (p.lower < p.upper) return "";
  return "lower, {lower}, is not below upper, {upper}; exchange them";
}

void Wrap::describe(BlockSpec<Wrap>& spec) {
  spec.name("wrap", "a signal within one period, as an angle within a turn").in_group("math").elementwise();
  spec.law("y = u - period floor((u - lower)/period): lower <= y < lower + period").from("definition");
  spec.remark("An angle from -180 to 180 deg: \"period\": \"360 deg\", \"lower\": \"-180 deg\".");
  spec.remark("It jumps: a law that is driven by the rate of its input (bouc_wen) stands before it.");
  spec.input(&In<double>::u, "u", "$a", "the signal");
  spec.output(&Out<double>::y, "y", "$a", "the same within a period");
  spec.param(&Params<double>::period, "period", "$a", "after which it comes again").positive().difference();
  spec.param(&Params<double>::lower, "lower", "$a", "where a period begins").optional("0");
}

Kernel dead_zone_block() { return kernel<DeadZone>(); }
Kernel wrap_block() { return kernel<Wrap>(); }

}  // namespace hysteron::blocks
