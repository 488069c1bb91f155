#include "fit/signals/unit_words.h"

#include <fmt/format.h>

#include <cmath>

namespace hysteron {
namespace {

std::string in_unit(double number, const Unit& unit) {
  const std::string text = fmt::format("{:.3g}", std::abs(number) < 1e-300 ? 0.0 : number);
  return unit.text.empty() ? text : text + " " + unit.text;
}

}  // namespace

std::string size_text(double si, const Unit& unit) { return in_unit(unit.difference_from_si(si), unit); }
std::string level_text(double si, const Unit& unit) { return in_unit(unit.from_si(si), unit); }
std::string range_text(double low, double high, const Unit& unit) {
  return fmt::format("{:.3g} .. {}", unit.from_si(low), level_text(high, unit));
}

}  // namespace hysteron
