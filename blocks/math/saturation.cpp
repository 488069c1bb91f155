#include "blocks/math/saturation.h"

#include <fmt/format.h>

#include <cmath>

namespace hysteron::blocks {

void Saturation::describe(BlockSpec<Saturation>& spec) {
  spec.name("saturation", "saturation: limits a signal").in_group("math").elementwise().at("command");
  spec.law("y = max(lower, min(upper, u))").from("definition");
  spec.remark("For no limit on one side write \"-inf V\" or \"inf V\", in the unit of the signal.");
  spec.input(&In<double>::u, "u", "$a", "the signal");
  spec.output(&Out<double>::y, "y", "$a", "the limited signal");
  spec.param(&Params<double>::lower, "lower", "$a", "lower limit of the output");
  spec.param(&Params<double>::upper, "upper", "$a", "upper limit of the output");
}

std::string Saturation::check(const Params<double>& p) {
  if (std::isinf(p.lower) && std::isinf(p.upper)) return "neither limit is finite; give one, or use a pass block";
  if (!(p.lower < p.upper)) return "lower, {lower}, is not below upper, {upper}; exchange them";
  return "";
}

Kernel saturation_block() { return kernel<Saturation>(); }

}  // namespace hysteron::blocks
