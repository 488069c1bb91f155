#include "blocks/hysteresis/one_sided_plays.h"

#include <fmt/format.h>

#include "blocks/hysteresis/prandtl_ishlinskii.h"

namespace hysteron::blocks {

Sizes one_play_per_threshold(const Shape& shape, int Sizes::*where) {
  Sizes s;
  s.*where = shape.length("thresholds");
  if (s.*where < 1 || s.*where != shape.length("weights"))
    s.error = "\"thresholds\" and \"weights\" must be lists of one length; give one weight per threshold";
  return s;
}

void start_one_sided_plays(const View<double>& v, std::span<const double> thresholds, double before) {
  for (std::size_t i = 0; i < thresholds.size(); ++i) v.out[i] = play::follow_one_sided(thresholds[i], 0.0, before);
}

std::string begins_at_zero(double first) {
  if (first != 0)
    return fmt::format("the first threshold is {{{} in thresholds}}; begin with 0, the linear part, which saturates",
                       first);
  return "";
}

}  // namespace hysteron::blocks
