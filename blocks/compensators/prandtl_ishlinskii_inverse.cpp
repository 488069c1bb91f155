#include "blocks/compensators/prandtl_ishlinskii_inverse.h"

#include <fmt/format.h>

#include <vector>

#include "blocks/hysteresis/prandtl_ishlinskii.h"

namespace hysteron::blocks {

void PrandtlIshlinskiiInverse::describe(Declaration& d) {
  d.name("prandtl_ishlinskii_inverse", "inverse of Prandtl-Ishlinskii: command for a desired displacement")
      .in_group("compensators")
      .elementwise()
      .at("command");
  d.law(
       "u = sum c'_j w'_j, w'_j a play operator of threshold r'_j driven by y; r'_j = sum_{i<=j} c_i (r_j - r_i), c'_j "
       "= "
       "1/m_j - 1/m_(j-1), m_j = c_0 + ... + c_j")
      .from("thesis Eqs. 2.8, 2.13, 2.14 as corrected; Kuhnen, Eur. J. Control 9 (2003) 407-418");
  d.remark("Takes the parameters of the block prandtl_ishlinskii that it compensates, its memory included.");
  d.remark("The inverse is exact, minor loops included, as long as both blocks have the same memory.");
  d.remembers("u", "the output w_i of each operator of the actuator");
  d.input("y", "$b", "desired displacement");
  d.output("u", "$a", "command");
  d.list("thresholds", "$a", "threshold of each play operator of the actuator; the first is 0 (linear part)")
      .increasing()
      .not_negative()
      .difference();
  d.list("weights", "$b/$a", "weight of each play operator of the actuator").as_long_as("thresholds");
  d.text("sides", {"one", "two"}, "one: one-sided play operators (dead zone below the input); two: symmetric ones");
  d.parameter("before", "$a", "an input that the actuator has visited before the start").optional("0");
}

Sizes PrandtlIshlinskiiInverse::sizes(const Shape& shape) {
  Sizes s;
  s.memory = shape.length("thresholds");
  if (s.memory < 1 || s.memory != shape.length("weights"))
    s.error = "\"thresholds\" and \"weights\" must be lists of one length; give one weight per threshold";
  return s;
}

std::string PrandtlIshlinskiiInverse::check(const View<double>& v) {
  const auto r = v.list(thresholds);
  if (r[0] != 0)
    return fmt::format(
        "the first threshold is {{{} in thresholds}}, so small motions have no inverse; begin with 0, the "
        "linear part",
        r[0]);
  const std::size_t rising = prandtl_ishlinskii::rising_slopes(v.list(weights));
  if (rising < r.size())
    return fmt::format(
        "the first {} weights add up to a slope that is not positive, so the actuator has no inverse; give a "
        "larger first weight",
        rising + 1);
  return "";
}

void PrandtlIshlinskiiInverse::initial_memory(const View<double>& v) {
  const auto r = v.list(thresholds);
  std::vector<double> actuator(r.size());
  for (std::size_t i = 0; i < r.size(); ++i) actuator[i] = play::follow(sides_of(v), r[i], 0.0, v.parameter(before));
  prandtl_ishlinskii::inverse_memory<double>(v.list(weights), actuator, v.out);
}

void PrandtlIshlinskiiInverse::given_memory(const View<double>& v) {
  prandtl_ishlinskii::inverse_memory<double>(v.list(weights), v.memory(), v.out);
}

std::string PrandtlIshlinskiiInverse::check_memory(const View<double>& v) {
  return check_nested(sides_of(v), v.list(thresholds), v.memory());
}

Kernel prandtl_ishlinskii_inverse_block() { return kernel<PrandtlIshlinskiiInverse>(); }

}  // namespace hysteron::blocks
