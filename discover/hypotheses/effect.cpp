// Decides how effects are looked up and how their numbers are written into a diagram. Does not know any single effect.
#include "discover/hypotheses/effect.h"

#include <fmt/format.h>

#include "discover/hypotheses/effect_terms.h"
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

const VariationDeclaration* varied_by(const Effect& effect, const Declaration& block) {
  for (const auto& name : {effect.variation, effect.or_variation})
    for (const auto& v : block.variations)
      if (!name.empty() && v.name == name) return &v;
  return nullptr;
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

Number value_in_unit(double si, const Unit& unit) {
  const double value = std::stod(fmt::format("{:.10g}", unit.from_si(si)));
  if (unit.text.empty() && unit.dimension.none()) return {value, {}};
  return {value, effects::unit_text(unit)};
}

NumberList with_unit(const std::vector<double>& si, const Unit& unit) {
  NumberList list;
  for (const double v : si) list.push_back(with_unit(v, unit));
  return list;
}

std::string element(const std::string& list, int index) { return fmt::format("{}[{}]", list, index); }

}  // namespace hysteron
