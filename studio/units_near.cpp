#include "studio/units_near.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "engine/diagram/error.h"
#include "engine/diagram/units.h"

namespace hysteron::studio {
namespace {

/// Prefixes that are written before the first unit of a product or quotient.
constexpr std::array<const char*, 7> prefixes{"", "n", "u", "m", "k", "M", "G"};
constexpr std::size_t most = 6;

/// "um" -> "m", "mV/um" -> "V/um": the part without its prefix, where one can be told.
std::vector<std::string> bare_forms(const std::string& unit) {
  std::vector<std::string> forms{unit};
  for (const char* prefix : prefixes)
    if (*prefix != 0 && unit.size() > 1 && unit.starts_with(prefix)) forms.push_back(unit.substr(1));
  return forms;
}

}  // namespace

nlohmann::ordered_json same_in_other_units(const std::string& quantity) {
  auto list = nlohmann::ordered_json::array();
  double number = 0;
  std::string unit;
  if (!split_quantity(quantity, number, unit) || unit.empty()) return list;
  try {
    const Unit from = parse_unit(unit);
    std::vector<std::pair<double, std::string>> found;  // how far from one, text
    std::vector<std::string> tried = {"deg", "rad", "degC", "K", "min", "s", "h"};
    for (const auto& bare : bare_forms(unit))
      for (const char* prefix : prefixes) tried.push_back(prefix + bare);
    for (const auto& text : tried) {
      if (text == unit) continue;
      try {
        const Unit to = parse_unit(text);
        if (to.dimension != from.dimension) continue;
        const double value = to.from_si(from.to_si(number));
        const double far = value == 0 ? 0 : std::abs(std::log10(std::abs(value)) - 1);
        if (far > 7) continue;
        found.emplace_back(far, fmt::format("{:.12g} {}", value, text));
      } catch (const Error&) {  // a prefix that makes no unit
      }
    }
    std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& [far, text] : found) {
      const nlohmann::ordered_json entry{{"text", text}};
      if (std::find(list.begin(), list.end(), entry) == list.end() && list.size() < most) list.push_back(entry);
    }
  } catch (const Error&) {
  }
  return list;
}

}  // namespace hysteron::studio
