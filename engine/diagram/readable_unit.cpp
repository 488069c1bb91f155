#include "engine/diagram/readable_unit.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace hysteron {
namespace {

struct Prefix {
  std::string_view text;
  double times;
};
constexpr double least_with_prefix = 0.01;
// The largest first.
constexpr Prefix prefixes[] = {{"M", 1e6},  {"k", 1e3},  {"", 1},      {"m", 1e-3},
                               {"u", 1e-6}, {"n", 1e-9}, {"p", 1e-12}, {"f", 1e-15}};
constexpr std::string_view symbols[] = {"m", "s", "V", "A", "N", "W", "J", "Pa", "rad", "T", "Hz", "F", "C", "ohm"};

const Prefix* prefix_of(std::string_view head) {
  for (const auto symbol : symbols) {
    if (!head.ends_with(symbol)) continue;
    for (const auto& p : prefixes)
      if (head.substr(0, head.size() - symbol.size()) == p.text) return &p;
  }
  return nullptr;
}

}  // namespace

ReadableUnit readable_unit(double number, std::string_view unit, double least) {
  ReadableUnit as_it_is{1, std::string(unit)};
  const double size = std::abs(number);
  if (size == 0 || !(size < least)) return as_it_is;
  const auto end = std::min(unit.find_first_of(" /*."), unit.size());
  const std::string_view head = unit.substr(0, end);  // a power ("mm^2") is no symbol
  const Prefix* const own = prefix_of(head);
  if (own == nullptr) return as_it_is;
  const auto* const fits = std::find_if(
      own, std::end(prefixes), [&](const Prefix& p) { return size * own->times >= least_with_prefix * p.times; });
  if (fits == std::end(prefixes)) return as_it_is;
  return {own->times / fits->times,
          std::string(fits->text) + std::string(head.substr(own->text.size())) + std::string(unit.substr(end))};
}

}  // namespace hysteron
