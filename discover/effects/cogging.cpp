// The effect cogging: a torque that comes again at the same angles.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "discover/hypotheses/effect_terms.h"
#include "discover/hypotheses/travel.h"

namespace hysteron::effects {
namespace {

/// How often a turn it may come again, as slots and poles make it, where the inertia passes two periods of it.
std::vector<double> periods_seen(const Excitation& at) {
  std::vector<double> seen;
  const double turns = travelled(at) / (2 * std::numbers::pi);
  for (const double n : {1, 2, 3, 4, 6, 8, 12, 18, 24, 36, 48, 72})
    if (!at.from_data || n * turns >= 2) seen.push_back(n);
  return seen;
}

LawParameter amplitude(const std::string& path, double size) {
  LawParameter p;
  p.path = path;
  p.start = size;
  p.scan = {size, -size};
  return p;
}

}  // namespace

Effect cogging() {
  Effect e;
  e.id = e.family = "cogging";
  e.title = "Cogging";
  e.cause = "The teeth of a motor with magnets; an eccentric wheel; a ripple of torque.";
  e.equation = "T = cosine*cos(periods*angle) + sine*sin(periods*angle)";
  e.source = "Hanselman, Brushless Permanent Magnet Motor Design, 2nd ed. (2003), chapter 8";
  e.residual = "A ripple whose frequency is the speed's, at the same angles whichever way and however fast it turns.";
  e.needs = "Slow turns through several periods, both ways.";
  e.way = Way::vary;
  e.variation = "cogging";
  e.parameters = {{"cosine", "N m", "at angle 0", "0.5 .. 5 % of the rated torque"},
                  {"sine", "N m", "a quarter of a period further on", "as cosine"},
                  {"periods", "", "in a turn: the least common multiple of slots and poles", "4 .. 72"}};
  e.look_alikes = {{"friction", "triangle", "friction hangs on the way it turns, not on the angle"},
                   {"stiffening", "low_frequencies", "a spring does not come again"}};
  e.summary = [](const Law&, const std::vector<double>& values, const Excitation&) {
    return fmt::format("{:.3g} N m, {:.4g} times a turn", std::hypot(values[0], values[1]), values[2]);
  };
  e.laws = [](const Excitation& at) {
    Law law;
    law.name = "one harmonic of the angle";
    law.block.type = at.by.empty() ? "inertia_with_cogging" : at.by;
    const double size = 0.02 * std::max(at.range(), 1e-30);
    LawParameter periods;
    periods.path = "periods";
    periods.scan = periods_seen(at);
    if (periods.scan.empty()) periods.scan = {12};
    periods.start = periods.scan.front();
    periods.lower = 0.5 * periods.scan.front();
    periods.upper = 2 * periods.scan.back();
    law.free = {amplitude("cosine", size), amplitude("sine", size), periods};
    give(law.block, "cosine", with_unit(size, parse_unit("N*m")));
    give(law.block, "sine", with_unit(size, parse_unit("N*m")));
    give(law.block, "periods", periods.start);
    return std::vector<Law>{law};
  };
  e.unseen = [](const Excitation& at) -> std::string {
    if (const auto stand = stands(at, "the inertia"); !stand.empty()) return stand;
    return periods_seen(at).empty() ? "it does not turn through two periods of any usual one" : "";
  };
  return e;
}

}  // namespace hysteron::effects
