#include "fit/signals/unit_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/diagram/readable_unit.h"

namespace hysteron {
namespace {

/// Three digits; whole numbers of up to six digits as they are read: 2350, not 2.35e+03.
std::string three_digits(double number) {
  if (std::abs(number) < 1e-300) return "0";
  if (std::abs(number) < 1000 || std::abs(number) >= 999'500) return fmt::format("{:.3g}", number);
  const double unit_of_third = std::pow(10, std::floor(std::log10(std::abs(number))) - 2);
  return fmt::format("{:.0f}", std::round(number / unit_of_third) * unit_of_third);
}

std::string with_unit(double number, const std::string& unit) {
  return unit.empty() ? three_digits(number) : three_digits(number) + " " + unit;
}

}  // namespace

std::string size_text(double si, const Unit& unit) {
  const double number = unit.difference_from_si(si);
  const ReadableUnit readable = readable_unit(number, unit.text);
  return with_unit(readable.times * number, readable.text);
}

std::string fall_text(double from, double to, const Unit& unit) {
  const double large = unit.difference_from_si(from), small = unit.difference_from_si(to);
  ReadableUnit readable = readable_unit(small, unit.text);
  // Of two sizes that lie far apart each is read alone.
  if (std::abs(readable.times * large) >= 1e4) return size_text(from, unit) + " -> " + size_text(to, unit);
  return with_unit(readable.times * large, readable.text) + " -> " + with_unit(readable.times * small, readable.text);
}

std::string fraction_text(double share) {
  constexpr double least_percent = 1e-4;
  return share != 0 && std::abs(share) < least_percent ? three_digits(1e6 * share) + " ppm"
                                                       : three_digits(100 * share) + " %";
}

std::string level_text(double si, const Unit& unit) { return with_unit(unit.from_si(si), unit.text); }

std::string range_text(double low, double high, const Unit& unit) {
  return fmt::format("{} .. {}", three_digits(unit.from_si(low)), level_text(high, unit));
}

}  // namespace hysteron
