// Decides how numbers look to people: always with a unit, never with more digits than are worth reading.
// Does not convert into other units than those the user's files speak.
#include "report/pages/numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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

// Below, another prefix is read more easily. A level or a parameter is told as its file has it a little longer.
constexpr double smallest_level = 1e-3, smallest_size = 1e-2;

std::string with_unit_text(double value, const Unit& unit, int digits, double least) {
  const ReadableUnit readable = readable_unit(value, unit_text(unit), least);
  const std::string number = number_text(readable.times * value, digits);
  return readable.text.empty() ? number : number + " " + readable.text;
}
}  // namespace

std::string quantity_text(double si, const Unit& unit, int digits) {
  return with_unit_text(unit.from_si(si), unit, digits, smallest_level);
}

std::string difference_text(double si, const Unit& unit, int digits) {
  return with_unit_text(unit.difference_from_si(si), unit, digits, smallest_size);
}

ReadableUnit readable_unit_of_range(double small, double large, const Unit& unit) {
  constexpr double five_digits = 1e4;
  const double most = unit.difference_from_si(large);
  ReadableUnit of_small = readable_unit(unit.difference_from_si(small), unit_text(unit), smallest_size);
  return std::abs(of_small.times * most) < five_digits ? of_small : readable_unit(most, unit_text(unit), smallest_size);
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
