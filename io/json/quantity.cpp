#include "io/json/quantity.h"

#include <fmt/format.h>

#include "engine/diagram/error.h"
#include "io/json/value_text.h"

namespace hysteron {
namespace {

std::optional<Unit> unit_at(const JsonPlace& place, const std::string& text) {
  try {
    return parse_unit(text, place.pointer());
  } catch (const Error& error) {
    for (const auto& p : error.problems) place.add(p.code, p.what, p.cure);
    return {};
  }
}

std::string name_of(const Unit& unit) { return unit.text.empty() ? "a number without unit" : unit.text; }

}  // namespace

std::optional<double> to_si(const JsonPlace& place, const Number& number, const Unit& declared, QuantityKind kind) {
  const auto unit = number.unit ? unit_at(place, *number.unit) : std::optional(declared);
  if (!unit) return {};
  if (unit->dimension != declared.dimension) {
    place.add("wrong_unit", fmt::format("{} does not fit: {} was expected", name_of(*unit), name_of(declared)),
              fmt::format("write it in {}", name_of(declared)));
    return {};
  }
  return kind == QuantityKind::difference ? unit->difference_to_si(number.value) : unit->to_si(number.value);
}

std::optional<double> read_si(const JsonPlace& place, const Unit& declared, QuantityKind kind) {
  const auto number = read_number(place);
  return number ? to_si(place, *number, declared, kind) : std::nullopt;
}

std::optional<double> read_si_with_unit(const JsonPlace& place) {
  const auto number = read_number(place);
  if (!number) return {};
  if (!number->unit && number->value != 0) {
    place.add("missing_unit", fmt::format("{} has no unit", exact_number_text(number->value)),
              fmt::format("write it with its unit, such as \"{} um\" (\"{} 1\" if it has none)",
                          exact_number_text(number->value), exact_number_text(number->value)));
    return {};
  }
  const auto unit = unit_at(place, number->unit.value_or(""));
  return unit ? std::optional(unit->to_si(number->value)) : std::nullopt;
}

}  // namespace hysteron
