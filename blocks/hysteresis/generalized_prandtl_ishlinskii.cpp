#include "blocks/hysteresis/generalized_prandtl_ishlinskii.h"

#include <fmt/format.h>

#include "blocks/hysteresis/prandtl_ishlinskii.h"

namespace hysteron::blocks {

void GeneralizedPrandtlIshlinskii::describe(Declaration& d) {
  d.name("generalized_prandtl_ishlinskii", "Prandtl-Ishlinskii hysteresis with a nonlinear envelope curve")
      .in_group("hysteresis")
      .elementwise()
      .at("core");
  d.law(
       "y = sum weights[i] w_i; one: w_i = max(c - thresholds[i], min(c, w_i before)); two: with min(c + "
       "thresholds[i], w_i before); c = curve of u; threshold 0: w = u")
      .from(
          "Al Janaideh, Rakheja, Su, IEEE/ASME Trans. Mechatronics 16 (2011) 734-744 (one envelope for both "
          "branches); curve: Fritsch, Carlson, SIAM J. Numer. Anal. 17 (1980) 238-246");
  d.remark(
      "The curve is a cubic through (lower, lower) and (upper, upper) with the given end slopes, extended "
      "by its tangents outside, and shifted so that it is 0 at 0. With both slopes 1 the block is "
      "prandtl_ishlinskii.");
  d.remark("The loops are wider at one end of the input range, and their centre lines are curved.");
  d.remembers("u", "output of each operator: the input for threshold 0, along the curve for the others");
  d.input("u", "$a", "drive");
  d.output("y", "$b", "displacement");
  d.list("thresholds", "$a", "threshold of each play operator; 0 = linear part")
      .increasing()
      .not_negative()
      .difference();
  d.list("weights", "$b/$a", "weight of each play operator").linear().as_long_as("thresholds");
  d.text("sides", {"one", "two"}, "one: one-sided play operators (dead zone below the input); two: symmetric ones");
  d.parameter("lower", "$a", "lower end of the input range");
  d.parameter("upper", "$a", "upper end of the input range");
  d.parameter("slope_at_lower", "", "slope of the curve at lower: 0 .. 3, 1 = straight line")
      .optional("1")
      .not_negative();
  d.parameter("slope_at_upper", "", "slope of the curve at upper: 0 .. 3, 1 = straight line")
      .optional("1")
      .not_negative();
  d.parameter("before", "$a", "input value visited before the start, which sets the initial memory").optional("0");
}

Sizes GeneralizedPrandtlIshlinskii::sizes(const Shape& shape) { return PrandtlIshlinskii::sizes(shape); }

std::string GeneralizedPrandtlIshlinskii::check(const View<double>& v) {
  if (!(v.parameter(lower) < v.parameter(upper)))
    return "lower, {lower}, is not below upper, {upper}; give the range of the input, its lower end first";
  const double steepest = std::max(v.parameter(slope_at_lower), v.parameter(slope_at_upper));
  if (steepest > curved_drive::steepest)
    return fmt::format("with a slope of {:.4g} the curve would not be monotonic; take at most {:.0f}", steepest,
                       curved_drive::steepest);
  return "";
}

void GeneralizedPrandtlIshlinskii::initial_memory(const View<double>& v) {
  const auto r = v.list(thresholds);
  const double visited = v.parameter(before), along = bent(v, visited);
  for (std::size_t i = 0; i < r.size(); ++i)
    v.out[i] = r[i] == 0 ? visited : play::follow(sides_of(v), r[i], 0.0, along);
}

std::string GeneralizedPrandtlIshlinskii::check_memory(const View<double>& v) {
  const std::size_t n = linear(v);
  return v.list(thresholds).size() <= n
             ? ""
             : check_nested(sides_of(v), v.list(thresholds).subspan(n), v.memory().subspan(n));
}

Kernel generalized_prandtl_ishlinskii_block() { return kernel<GeneralizedPrandtlIshlinskii>(); }

}  // namespace hysteron::blocks
