#include "engine/simulate/output_instants.h"

#include <fmt/format.h>

#include <cmath>

namespace hysteron {
namespace {

constexpr int default_points = 1000;
constexpr std::size_t most_instants = 50'000'000;

}  // namespace

std::vector<double> output_instants(const SimulateOptions& o) {
  Problems problems;
  const auto bad = [&](const char* key, const std::string& what, const char* cure) {
    problems.add("bad_value", std::string("/simulate/") + key, what, cure);
  };
  if (!(o.relative_tolerance > 0 && o.relative_tolerance < 1))
    bad("solver/relative_tolerance", fmt::format("a relative tolerance of {} is not possible", o.relative_tolerance),
        "choose it between 1e-12 and 1e-3");
  if (!(o.absolute_tolerance > 0) || !std::isfinite(o.absolute_tolerance))
    bad("solver/absolute_tolerance", fmt::format("an absolute tolerance of {} is not possible", o.absolute_tolerance),
        "choose a positive number (a multiple of relative_tolerance times each state's nominal size)");
  if (!(o.max_step >= 0) || !std::isfinite(o.max_step))
    bad("solver/max_step", fmt::format("a step of {} s is not possible", o.max_step), "choose a positive time");
  if (!o.instants.empty()) {
    for (std::size_t i = 0; i < o.instants.size(); ++i) {
      if (std::isfinite(o.instants[i]) && (i == 0 ? o.instants[0] >= o.begin : o.instants[i] > o.instants[i - 1]))
        continue;
      bad("instants",
          fmt::format("output time {} ({} s) is not behind the one before or the start ({} s)", i, o.instants[i],
                      o.begin),
          "give increasing times, none before the start");
      break;
    }
    problems.throw_if_any();
    return o.instants;
  }
  if (!(o.until > o.begin) || !std::isfinite(o.until))
    bad("until", fmt::format("the end ({} s) is not behind the start ({} s)", o.until, o.begin), "give a later end");
  if (!(o.every >= 0) || !std::isfinite(o.every))
    bad("every", fmt::format("an output step of {} s is not possible", o.every), "choose a positive time");
  problems.throw_if_any();
  const double span = o.until - o.begin;
  const double every = o.every > 0 ? o.every : span / default_points;
  // One part in 1e9 forgives 0.3 / 0.1 being less than 3.
  const double steps = std::floor(span / every * (1 + 1e-9));
  if (steps >= static_cast<double>(most_instants))
    fail("bad_value", "/simulate/every", fmt::format("{:.3g} output times are more than can be kept", steps),
         "choose a longer output step");
  std::vector<double> instants(static_cast<std::size_t>(steps) + 1);
  for (std::size_t k = 0; k < instants.size(); ++k) instants[k] = o.begin + static_cast<double>(k) * every;
  if (o.until - instants.back() < 1e-6 * every) instants.back() = o.until;
  return instants;
}

}  // namespace hysteron
