#include "blocks/hysteresis/prandtl_ishlinskii.h"

#include <fmt/format.h>

namespace hysteron::blocks {

void PrandtlIshlinskii::describe(Declaration& d) {
  d.name("prandtl_ishlinskii", "rate-independent hysteresis: weighted sum of play operators")
      .in_group("hysteresis")
      .elementwise()
      .at("core");
  d.law(
       "y = sum weights[i] w_i; one: w_i = max(u - thresholds[i], min(u, w_i before)); two: with min(u + "
       "thresholds[i], w_i before)")
      .from("thesis Eqs. 2.3 to 2.5; Kuhnen, Eur. J. Control 9 (2003) 407-418");
  d.remark("Threshold 0 is the linear part: its operator is the input itself.");
  d.remark("One-sided thresholds spread over the whole span of the input, two-sided ones over half of it.");
  d.remark(
      "The memory starts at zero, visits \"before\", then the first input: that is the initial remanence. "
      "One-sided operators keep of it only what lies below the first input.");
  d.remembers("u", "the output w_i of each operator");
  d.input("u", "$a", "drive");
  d.output("y", "$b", "displacement");
  d.list("thresholds", "$a", "threshold of each operator, 0 = linear part").increasing().not_negative().difference();
  d.list("weights", "$b/$a", "weight of each operator").linear().as_long_as("thresholds");
  d.text("sides", {"one", "two"}, "dead zone below the input only, or on both sides");
  d.parameter("before", "$a", "an input that was visited before the start").optional("0");
  d.variation("late", "late_prandtl_ishlinskii", {{"share", "0"}});
}

Sizes PrandtlIshlinskii::sizes(const Shape& shape) {
  Sizes s;
  s.memory = shape.length("thresholds");
  if (s.memory < 1 || s.memory != shape.length("weights"))
    s.error = "\"thresholds\" and \"weights\" must be lists of one length; give one weight per threshold";
  return s;
}

void PrandtlIshlinskii::initial_memory(const View<double>& v) {
  const auto r = v.list(thresholds);
  for (std::size_t i = 0; i < r.size(); ++i) v.out[i] = play::follow(sides_of(v), r[i], 0.0, v.parameter(before));
}

std::string check_nested(play::Sides sides, std::span<const double> thresholds, std::span<const double> memory) {
  const double slack = 1e-9 * thresholds.back();
  const std::size_t i = prandtl_ishlinskii::nested_until(sides, thresholds, memory, slack);
  if (i == memory.size()) return "";
  return fmt::format(
      "the operators of the thresholds {{{} in thresholds}} and {{{} in thresholds}} cannot stand at {{{} in thresholds}} "
      "and {{{} in thresholds}}: the first less the second must lie between {{{} in thresholds}} and {{{} in thresholds}}",
      thresholds[i], thresholds[i + 1], memory[i], memory[i + 1],
      sides == play::Sides::one ? 0 : thresholds[i] - thresholds[i + 1], thresholds[i + 1] - thresholds[i]);
}

std::string PrandtlIshlinskii::check_memory(const View<double>& v) {
  return check_nested(sides_of(v), v.list(thresholds), v.memory());
}

Kernel prandtl_ishlinskii_block() { return kernel<PrandtlIshlinskii>(); }

}  // namespace hysteron::blocks
