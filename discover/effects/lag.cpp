#include "discover/effects/lag.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "discover/hypotheses/effect_terms.h"

namespace hysteron::effects {
namespace {

LawParameter time_constant(const Excitation& at, int index) {
  LawParameter tau;
  tau.path = element("times", index);
  tau.log_scale = true;
  // The lower bound must be as good as none, however quiet the sensor; what is slower than the recordings integrates.
  tau.lower = at.shortest_step * 1e-4;
  tau.upper = std::max(at.longest_recording, 10 * at.shortest_step);
  tau.start = at.shortest_step;
  if (index == 0) tau.scan = per_decade(at.shortest_step / 50, tau.upper / 2, 3);
  return tau;
}

}  // namespace

std::vector<Law> lag_laws(const Excitation& at) {
  Law one;
  one.name = "one pole";
  one.block.type = "lag";
  give(one.block, "times", NumberList{with_unit(at.shortest_step, parse_unit("s"))});
  one.free = {time_constant(at, 0)};
  one.free.front().is_size = true;

  Law two = one;
  two.name = "two poles";
  give(two.block, "times", with_unit({at.shortest_step, at.shortest_step / 10}, parse_unit("s")));
  two.free = {time_constant(at, 0), time_constant(at, 1)};
  two.free[1].start = at.shortest_step / 10;
  for (auto& tau : two.free) tau.interchangeable = true;
  return {one, two};
}

std::string lag_summary(const Law&, const std::vector<double>& values, const Excitation&) {
  std::string text;
  double total = 0;
  for (const double tau : values) {
    text += (text.empty() ? "" : " and ") + time_text(tau);
    total += tau;
  }
  return fmt::format("time constant{} {}, corner near {:.3g} Hz", values.size() > 1 ? "s" : "", text,
                     1 / (2 * std::numbers::pi * total));
}

std::string lag_without_end(const Law& law, const std::vector<double>& values, const Excitation&) {
  const double slowest = *std::max_element(values.begin(), values.end());
  if (slowest < 0.99 * law.free.front().upper) return "";
  return fmt::format("its time constant is at the length of the longest recording, {}: that is no lag, it integrates",
                     time_text(law.free.front().upper));
}

}  // namespace hysteron::effects
