#include "discover/hypotheses/effect_terms.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/diagram/number_text.h"

namespace hysteron::effects {

void give(Node& block, const std::string& parameter, Value value) { block.parameters[parameter] = std::move(value); }

double rounded(double value) {
  if (value == 0 || !std::isfinite(value)) return value;
  const double scale = std::pow(10.0, 2 - std::floor(std::log10(std::abs(value))));
  if (!std::isfinite(scale)) return rounded_to_digits(value, 3);
  // Through text, so that the number in the file is the shortest that means this value.
  return rounded_to_digits(std::round(value * scale) / scale, 6);
}

std::vector<double> per_decade(double from, double to, double per_decade) {
  const double decades = std::log10(to / from);
  const int n = std::max(2, static_cast<int>(std::lround(decades * per_decade)) + 1);
  std::vector<double> values;
  for (int i = 0; i < n; ++i) values.push_back(rounded(from * std::pow(10.0, decades * i / (n - 1))));
  return values;
}

Number per_second(double si, const Unit& unit) {
  const std::string text = unit_text(unit);
  return {rounded(unit.difference_from_si(si)), text.find('/') == std::string::npos ? text + "/s" : "(" + text + ")/s"};
}

std::string unit_text(const Unit& unit) { return unit.text.empty() ? to_text(unit.dimension) : unit.text; }

Number level(double si, const Unit& unit) { return {rounded(unit.from_si(si)), unit_text(unit)}; }

Number level_within(double range, double si, const Unit& unit) {
  const double per_unit = std::pow(10, 1 - std::floor(std::log10(std::abs(unit.difference_from_si(range)))));
  return {std::round(unit.from_si(si) * per_unit) / per_unit + 0.0, unit_text(unit)};  // no "-0"
}

std::string few_sizes(const Excitation& at, const char* what) {
  if (!at.from_data || at.swings.sizes >= 3) return "";
  return fmt::format("swings of {} size{}, three would {}", at.swings.sizes, at.swings.sizes == 1 ? "" : "s", what);
}

std::string one_speed(const Excitation& at, double ratio, const char* what) {
  if (!at.from_data || at.swings.speed_ratio >= ratio) return "";
  return fmt::format("the fastest swing is {:.2g} times as fast as the slowest, {:.2g} times would {}",
                     at.swings.speed_ratio, ratio, what);
}

std::string stands_still(const Excitation& at) {
  return at.from_data && at.range() <= 0 ? "the signal does not move" : "";
}

}  // namespace hysteron::effects
