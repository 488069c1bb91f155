// Decides how numbers look to people: always with a unit, never with more digits than are worth reading.
// Does not convert into other units than those the user's files speak.
#include "report/pages/numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

namespace hysteron {

std::string number_text(double value, int digits) {
  if (!std::isfinite(value)) return std::isnan(value) ? "-" : (value > 0 ? "infinite" : "-infinite");
  if (value == 0 || digits <= 0) return "0";
  // Whole numbers of six digits are read at a glance, 1.234e+04 is not.
  if (std::abs(value) >= 1000 && std::abs(value) < 999999.5 && std::abs(value) >= std::pow(10, digits))
    return fmt::format("{:.0f}", value);
  return fmt::format("{:.{}g}", value, digits);
}

int digits_within(double value, double low, double high) {
  constexpr int fewest = 2, most = 10;
  const double half = (high - low) / 2;
  if (!(half > 0) || value == 0 || !std::isfinite(value) || !std::isfinite(half)) return 5;
  const auto decade = [](double v) { return static_cast<int>(std::floor(std::log10(std::abs(v)))); };
  const int digits = decade(value) - decade(half) + 2;
  return digits < 0 ? 0 : std::clamp(digits, fewest, most);
}

std::string unit_text(const Unit& unit) { return unit.text.empty() || unit.text == "1" ? "" : unit.text; }

namespace {

/// Where a number is so small that it would be written as 5.04e-06 m: the same with the prefix that makes it 5.04 um.
/// Of units that begin with a symbol of SI alone; none = there is no such prefix.
std::optional<std::string> with_prefix(double value, const std::string& unit, int digits) {
  static const std::set<std::string> plain{"m",  "s",   "V", "A",   "N",   "W",     "J",
                                           "Pa", "rad", "T", "N m", "m/s", "rad/s", "m/s^2"};
  static const std::pair<const char*, double> prefixes[] = {{"m", 1e-3}, {"u", 1e-6}, {"n", 1e-9}, {"p", 1e-12}};
  if (value == 0 || !(std::abs(value) < 1e-4) || !plain.contains(unit)) return {};
  for (const auto& [prefix, factor] : prefixes)
    if (std::abs(value) >= 0.9995 * factor) return number_text(value / factor, digits) + " " + prefix + unit;
  return {};
}

std::string with_unit_text(double value, const Unit& unit, int digits) {
  const std::string text = unit_text(unit);
  if (const auto prefixed = with_prefix(value, text, digits)) return *prefixed;
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
