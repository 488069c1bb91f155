// Decides how numbers look to people: always with a unit, never with more digits than are worth reading.
// Does not convert into other units than those the user's files speak.
#include "report/pages/numbers.h"

#include <fmt/format.h>

#include <cmath>

namespace hysteron {

std::string number_text(double value, int digits) {
  if (!std::isfinite(value)) return std::isnan(value) ? "-" : (value > 0 ? "infinite" : "-infinite");
  if (value == 0) return "0";
  return fmt::format("{:.{}g}", value, digits);
}

std::string unit_text(const Unit& unit) { return unit.text.empty() || unit.text == "1" ? "" : unit.text; }

namespace {
std::string with_unit_text(double value, const Unit& unit, int digits) {
  const std::string text = unit_text(unit);
  return text.empty() ? number_text(value, digits) : number_text(value, digits) + " " + text;
}
}  // namespace

std::string quantity_text(double si, const Unit& unit, int digits) {
  return with_unit_text(unit.from_si(si), unit, digits);
}

std::string difference_text(double si, const Unit& unit, int digits) {
  return with_unit_text(unit.difference_from_si(si), unit, digits);
}

std::string percent_text(double share) {
  const double percent = 100 * share;
  if (!std::isfinite(percent)) return "-";
  if (std::abs(percent) >= 99.95 || percent == 0) return fmt::format("{:.0f} %", percent);
  return std::abs(percent) < 1 ? fmt::format("{:.2g} %", percent) : fmt::format("{:.1f} %", percent);
}

std::string count_text(long n, const std::string& noun) { return fmt::format("{} {}{}", n, noun, n == 1 ? "" : "s"); }

std::string axis_text(const std::string& name, const Unit& unit) {
  const std::string text = unit_text(unit);
  return text.empty() ? name + " [1]" : fmt::format("{} [{}]", name, text);
}

}  // namespace hysteron
