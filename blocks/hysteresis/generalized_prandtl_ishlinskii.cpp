#include "blocks/hysteresis/generalized_prandtl_ishlinskii.h"

#include <fmt/format.h>

#include "blocks/hysteresis/prandtl_ishlinskii.h"

namespace hysteron::blocks {

void GeneralizedPrandtlIshlinskii::describe(Declaration& d) {
  d.name("generalized_prandtl_ishlinskii", "play operators that follow a bent drive, beside a linear part")
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
      "The curve is a cubic through (lower, lower) and (upper, upper) with these slopes there, straight on beyond, and "
      "moved so that it is 0 at 0. With both slopes 1 the block is prandtl_ishlinskii.");
  d.remark("Its loops are wider at one end of the drive, and their middle lines are bent.");
  d.remembers("u", "what each operator holds: of threshold 0 the drive, of the others along the curve");
  d.input("u", "$a", "drive");
  d.output("y", "$b", "displacement");
  d.list("thresholds", "$a", "threshold of each operator, 0 = linear part").increasing().not_negative().difference();
  d.list("weights", "$b/$a", "weight of each operator").linear().as_long_as("thresholds");
  d.text("sides", {"one", "two"}, "dead zone below the input only, or on both sides");
  d.parameter("lower", "$a", "end of the range of the drive");
  d.parameter("upper", "$a", "other end of the range, above lower");
  d.parameter("slope_at_lower", "", "slope of the curve at lower, over that of the straight line: 0 .. 3")
      .optional("1")
      .not_negative();
  d.parameter("slope_at_upper", "", "slope of the curve at upper: 0 .. 3").optional("1").not_negative();
  d.parameter("before", "$a", "an input that was visited before the start").optional("0");
}

Sizes GeneralizedPrandtlIshlinskii::sizes(const Shape& shape) { return PrandtlIshlinskii::sizes(shape); }

std::string GeneralizedPrandtlIshlinskii::check(const View<double>& v) {
  if (!(v.parameter(lower) < v.parameter(upper)))
    return "lower, {lower}, is not below upper, {upper}; give the range of the drive, its lower end first";
  const double steepest = std::max(v.parameter(slope_at_lower), v.parameter(slope_at_upper));
  if (steepest > curved_drive::steepest)
    return fmt::format("a slope of {:.4g}: the curve would fall in between; take at most {:.0f}", steepest,
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
