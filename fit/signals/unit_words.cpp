#include "fit/signals/unit_words.h"

#include <fmt/format.h>

#include <cmath>

namespace hysteron {
namespace {

/// Three digits; whole numbers of up to six digits as they are read: 2350, not 2.35e+03.
std::string three_digits(double number) {
  if (std::abs(number) < 1e-300) return "0";
  if (std::abs(number) < 1000 || std::abs(number) >= 999'500) return fmt::format("{:.3g}", number);
  const double unit_of_third = std::pow(10, std::floor(std::log10(std::abs(number))) - 2);
  return fmt::format("{:.0f}", std::round(number / unit_of_third) * unit_of_third);
}

std::string in_unit(double number, const Unit& unit) {
  const std::string text = three_digits(number);
  return unit.text.empty() ? text : text + " " + unit.text;
}

}  // namespace

std::string size_text(double si, const Unit& unit) { return in_unit(unit.difference_from_si(si), unit); }
std::string level_text(double si, const Unit& unit) { return in_unit(unit.from_si(si), unit); }
std::string range_text(double low, double high, const Unit& unit) {
  return fmt::format("{} .. {}", three_digits(unit.from_si(low)), level_text(high, unit));
}

}  // namespace hysteron
