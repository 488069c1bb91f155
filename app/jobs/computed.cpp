#include "app/jobs/computed.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "engine/diagram/error.h"
#include "models/compensators/prandtl_ishlinskii_inverse.h"

namespace hysteron {
namespace {

// Thesis Table 2.3, in V and um.
constexpr std::array<double, 10> thresholds{0, 0.6, 1.2, 1.8, 2.4, 3, 3.6, 4.2, 4.8, 5.4};
constexpr std::array<double, 10> weights{0.7521, 0.1381, 0.0775, 0.0651, 0.0658, 0.0522, 0.0506, 0.0523, 0.052, 0.1169};

Quantity inverse_threshold(std::size_t i) {
  std::array<double, 10> inverse{};
  prandtl_ishlinskii::inverse_thresholds<double>(thresholds, weights, inverse.data());
  return {1e-6 * inverse[i], parse_unit("um")};
}
Quantity inverse_weight(std::size_t i) {
  std::array<double, 10> inverse{};
  prandtl_ishlinskii::inverse_weights<double>(weights, inverse.data());
  return {1e6 * inverse[i], parse_unit("V/um")};
}

/// dP/dE of Jiles-Atherton as Eqs. 2.32, 2.34 are printed, with the spurious alpha in the numerator; Table 2.2, V and
/// um. `d` is the sign of the field's change.
double printed_slope(double e, double p, double d) {
  constexpr double p_s = 55.9973, a = 48.5843, alpha = 0.2512, k = 3.8892, c = 0.6929;
  const double anhysteretic = p_s * std::tanh((e + alpha * p) / a);
  const double s = 1 - std::pow(anhysteretic / p_s, 2), r = c * p_s * alpha / a * s;
  const double gap = anhysteretic - p;
  return (gap / (k * d - alpha / (1 - c) * gap) + r) / (1 - r);
}

/// Stroke of its steady loop on 0..6 V: twenty cycles of Runge-Kutta steps of 0.01 V, 1/400 of k.
Quantity printed_stroke() {
  double p = 0, top = 0;
  for (int cycle = 0; cycle < 20; ++cycle)
    for (const double d : {1.0, -1.0}) {
      if (d < 0) top = p;
      for (int i = 0; i < 600; ++i) {
        const double h = 0.01 * d, e = d > 0 ? 0.01 * i : 6 - 0.01 * i;
        const double k1 = printed_slope(e, p, d), k2 = printed_slope(e + h / 2, p + h / 2 * k1, d);
        const double k3 = printed_slope(e + h / 2, p + h / 2 * k2, d), k4 = printed_slope(e + h, p + h * k3, d);
        p += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
      }
    }
  return {1e-6 * (top - p), parse_unit("um"), true};
}

}  // namespace

Quantity computed(const WrittenText& name) {
  static const std::map<std::string, Quantity (*)()> formulas{
      {"prandtl_ishlinskii_inverse_threshold_1", [] { return inverse_threshold(1); }},
      {"prandtl_ishlinskii_inverse_threshold_9", [] { return inverse_threshold(9); }},
      {"prandtl_ishlinskii_inverse_weight_0", [] { return inverse_weight(0); }},
      {"prandtl_ishlinskii_inverse_weight_9", [] { return inverse_weight(9); }},
      {"jiles_atherton_printed_stroke", printed_stroke},
  };
  const auto found = formulas.find(name.text);
  if (found != formulas.end()) return found->second();
  std::vector<std::string> known;
  for (const auto& [n, formula] : formulas) known.push_back(n);
  fail("unknown_figure", name.pointer, fmt::format("there is no formula \"{}\"", name.text),
       did_you_mean(name.text, known));
}

}  // namespace hysteron
