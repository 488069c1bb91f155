// The effect cogging: a torque that comes again at the same angles, or a force at the same positions.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "discover/hypotheses/effect_terms.h"
#include "discover/hypotheses/travel.h"

namespace hysteron::effects {
namespace {

bool is_along_a_line(const Excitation& at) { return at.unit.dimension == parse_unit("N").dimension; }

/// How often a turn it may come again, as slots and poles make it, where the inertia passes two periods of it.
std::vector<double> periods_seen(const Excitation& at) {
  std::vector<double> seen;
  const double turns = travelled(at) / (2 * std::numbers::pi);
  for (const double n : {1, 2, 3, 4, 6, 8, 12, 18, 24, 36, 48, 72})
    if (!at.from_data || n * turns >= 2) seen.push_back(n);
  return seen;
}

/// Along a line no number of poles bounds what may come again: from two periods over the way that was moved, as finely
/// as so long a way tells them apart.
std::vector<double> pitches_seen(const Excitation& at) {
  constexpr double finest = 24;  // each is a start of a fit; of finer ones the mass evens out the force
  std::vector<double> seen;
  for (double n = 2; n <= finest; n += 0.5) seen.push_back(travel(at) / n);
  return seen;
}

LawParameter amplitude(const std::string& path, double size) {
  LawParameter p;
  p.path = path;
  p.start = size;
  p.scan = {size, -size};
  return p;
}

LawParameter between_its_values(const std::string& path, std::vector<double> scan) {
  LawParameter p;
  p.path = path;
  p.scan = std::move(scan);
  const auto [least, most] = std::minmax_element(p.scan.begin(), p.scan.end());
  p.start = p.scan.front();
  p.lower = 0.5 * *least;
  p.upper = 2 * *most;
  return p;
}

LawParameter periods_of(const Excitation& at) {
  auto seen = periods_seen(at);
  return between_its_values("periods", seen.empty() ? std::vector<double>{12} : seen);
}

LawParameter pitch_of(const Excitation& at) { return between_its_values("period", pitches_seen(at)); }

}  // namespace

Effect cogging() {
  Effect e;
  e.id = e.family = "cogging";
  e.title = "Cogging";
  e.cause = "The teeth of a motor with magnets, turning or linear; an eccentric wheel; a ripple of torque.";
  e.equation =
      "T = cosine*cos(periods*angle) + sine*sin(periods*angle), F = cosine*cos(2*pi*x/period) + sine*sin(2*pi*x/period)";
  e.source = "Hanselman, Brushless Permanent Magnet Motor Design, 2nd ed. (2003), chapter 8";
  e.residual = "A ripple whose frequency is the speed's, at the same angles whichever way and however fast it turns.";
  e.needs = "Slow turns through several periods, both ways.";
  e.way = Way::vary;
  e.variation = "cogging";
  e.parameters = {{"cosine", "N m", "at angle 0", "0.5 .. 5 % of the rated torque"},
                  {"sine", "N m", "a quarter of a period further on", "as cosine"},
                  {"periods", "", "in a turn: the least common multiple of slots and poles", "4 .. 72"},
                  {"period", "m", "of a linear motor: the pitch of its magnets", "10 .. 60 mm"}};
  e.look_alikes = {{"friction", "triangle", "friction hangs on the way it turns, not on the angle"},
                   {"stiffening", "low_frequencies", "a spring does not come again"}};
  e.summary = [](const Law&, const std::vector<double>& values, const Excitation& at) {
    const double size = std::hypot(values[0], values[1]);
    if (is_along_a_line(at)) return fmt::format("{:.3g} N every {:.4g} mm", size, values[2] * 1e3);
    return fmt::format("{:.3g} N m, {:.4g} times a turn", size, values[2]);
  };
  e.laws = [](const Excitation& at) {
    Law law;
    const bool rotary = !is_along_a_line(at);
    law.name = rotary ? "one harmonic of the angle" : "one harmonic of the position";
    law.block.type = !at.by.empty() ? at.by : rotary ? "inertia_with_cogging" : "mass_with_cogging";
    const double size = 0.02 * std::max(at.range(), 1e-30);
    const Unit unit = parse_unit(rotary ? "N*m" : "N");
    law.free = {amplitude("cosine", size), amplitude("sine", size), rotary ? periods_of(at) : pitch_of(at)};
    give(law.block, "cosine", with_unit(size, unit));
    give(law.block, "sine", with_unit(size, unit));
    if (rotary)
      give(law.block, "periods", law.free.back().start);
    else
      give(law.block, "period", with_unit(law.free.back().start, parse_unit("m")));
    return std::vector<Law>{law};
  };
  e.unseen = [](const Excitation& at) -> std::string {
    if (const auto stand = stands(at, is_along_a_line(at) ? "the mass" : "the inertia"); !stand.empty()) return stand;
    return !is_along_a_line(at) && periods_seen(at).empty() ? "it does not turn through two periods of any usual one"
                                                            : "";
  };
  return e;
}

}  // namespace hysteron::effects
