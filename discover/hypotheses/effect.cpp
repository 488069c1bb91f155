// Decides how effects are looked up and how their numbers are written. Does not know any single effect.
#include "discover/hypotheses/effect.h"

#include <fmt/format.h>

#include <cmath>

#include "discover/effects/library.h"
#include "engine/diagram/error.h"
#include "engine/diagram/number_text.h"

namespace hysteron {

std::string to_text(Way way) {
  switch (way) {
    case Way::insert:
      return "insert";
    case Way::vary:
      return "vary";
    case Way::data:
      return "data";
  }
  return "";
}

std::string parameter_path(const std::string& choice, const Law& law, const LawParameter& parameter) {
  return choice + (law.block.nested ? "/" : ".") + parameter.path;
}

Effects::Effects(std::vector<Effect> list) : list_(std::move(list)) {}

const Effect* Effects::find(const std::string& id) const {
  for (const auto& e : list_)
    if (e.id == id) return &e;
  return nullptr;
}

const Effect& Effects::get(const std::string& id) const {
  if (const Effect* found = find(id)) return *found;
  fail("unknown_effect", id, fmt::format("there is no effect \"{}\"", id), did_you_mean(id, ids()));
}

std::vector<std::string> Effects::ids() const {
  std::vector<std::string> names;
  for (const auto& e : list_) names.push_back(e.id);
  return names;
}

Number with_unit(double si, const Unit& unit) {
  // Differences: a threshold of 2 degC is a span, not a temperature.
  const double value = effects::rounded(unit.difference_from_si(si));
  if (unit.text.empty() && unit.dimension.none()) return {value, {}};
  return {value, effects::unit_text(unit)};
}

NumberList with_unit(const std::vector<double>& si, const Unit& unit) {
  NumberList list;
  for (const double v : si) list.push_back(with_unit(v, unit));
  return list;
}

std::string element(const std::string& list, int index) { return fmt::format("{}[{}]", list, index); }

namespace effects {

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

std::string few_sizes(const Circumstances& at, const char* what) {
  if (!at.from_data || at.swings.sizes >= 3) return "";
  return fmt::format("swings of {} size{}, three would {}", at.swings.sizes, at.swings.sizes == 1 ? "" : "s", what);
}

std::string one_speed(const Circumstances& at, double ratio, const char* what) {
  if (!at.from_data || at.swings.speed_ratio >= ratio) return "";
  return fmt::format("the fastest swing is {:.2g} times as fast as the slowest, {:.2g} times would {}",
                     at.swings.speed_ratio, ratio, what);
}

std::string stands_still(const Circumstances& at) {
  return at.from_data && at.range() <= 0 ? "the signal does not move" : "";
}

}  // namespace effects
}  // namespace hysteron
