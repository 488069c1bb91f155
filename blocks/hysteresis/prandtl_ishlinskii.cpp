#include "blocks/hysteresis/prandtl_ishlinskii.h"

#include <fmt/format.h>

namespace hysteron::blocks {

void PrandtlIshlinskii::describe(Declaration& d) {
  d.name("prandtl_ishlinskii", "Prandtl-Ishlinskii hysteresis: weighted sum of play operators")
      .in_group("hysteresis")
      .elementwise()
      .at("core");
  d.law(
       "y = sum weights[i] w_i; one: w_i = max(u - thresholds[i], min(u, w_i before)); two: with min(u + "
       "thresholds[i], w_i before)")
      .from("thesis Eqs. 2.3 to 2.5; Kuhnen, Eur. J. Control 9 (2003) 407-418");
  d.remark("An operator of threshold 0 passes the input through: it is the linear part.");
  d.remark("Choose one-sided thresholds over the whole range of the input, two-sided ones over half of it.");
  d.remark(
      "Initial memory: the operators start at zero, move to \"before\", then to the first input; this sets "
      "the initial remanence. One-sided operators keep only what lies below the first input.");
  d.remembers("u", "the output w_i of each operator");
  d.input("u", "$a", "drive");
  d.output("y", "$b", "displacement");
  d.list("thresholds", "$a", "threshold of each play operator; 0 = linear part")
      .increasing()
      .not_negative()
      .difference();
  d.list("weights", "$b/$a", "weight of each play operator").linear().as_long_as("thresholds");
  d.text("sides", {"one", "two"}, "one: one-sided play operators (dead zone below the input); two: symmetric ones");
  d.parameter("before", "$a", "input value visited before the start, which sets the initial memory").optional("0");
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
      "the operators of the thresholds {{{} in thresholds}} and {{{} in thresholds}} cannot have the "
      "outputs {{{} in thresholds}} and {{{} in thresholds}}: the first minus the second must lie between "
      "{{{} in thresholds}} and {{{} in thresholds}}",
      thresholds[i], thresholds[i + 1], memory[i], memory[i + 1],
      sides == play::Sides::one ? 0 : thresholds[i] - thresholds[i + 1], thresholds[i + 1] - thresholds[i]);
}

std::string PrandtlIshlinskii::check_memory(const View<double>& v) {
  return check_nested(sides_of(v), v.list(thresholds), v.memory());
}

Kernel prandtl_ishlinskii_block() { return kernel<PrandtlIshlinskii>(); }

}  // namespace hysteron::blocks
