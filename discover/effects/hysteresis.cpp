// The effect hysteresis: the response remembers turning points, at any speed.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "discover/hypotheses/effect_terms.h"

namespace hysteron::effects {
namespace {

/// Plays with thresholds from `from` to `to` of the range; the weight of threshold 0 is the wire's own gain, 1.
/// Spacing grows with the threshold: small loops need fine thresholds, large ones do not.
Law plays(const Excitation& at, const char* name, int n, double from, double to, const char* sides, double growth) {
  const double range = at.range() > 0 ? at.range() : 1.0;
  std::vector<double> thresholds{0.0};
  for (int i = 0; i < n; ++i)
    thresholds.push_back(range * (from + (to - from) * std::pow(static_cast<double>(i) / (n - 1), growth)));
  Law law;
  law.name = name;
  law.block.type = "prandtl_ishlinskii";
  give(law.block, "thresholds", with_unit(thresholds, at.unit));
  NumberList weights{Number{1.0, {}}};
  if (!at.gain_is_free) {
    LawParameter own;
    own.path = element("weights", 0);
    own.start = 1;
    own.lower = 0;
    own.beside_size = true;
    law.free.push_back(own);
  }
  for (int i = 0; i < n; ++i) {
    weights.push_back(Number{0.02, {}});
    LawParameter w;
    w.path = element("weights", i + 1);
    w.start = 0.02;
    w.lower = 0;  // domains switch with the field, never against it
    w.is_size = true;
    law.free.push_back(w);
  }
  give(law.block, "weights", std::move(weights));
  give(law.block, "sides", sides);
  return law;
}

/// The operators follow a bent drive, beside a linear part that does not: domains need not switch evenly over the
/// range, so that loops are wider at one end and their middle lines are bent (Preisach's density need not be even). Of
/// a drive to one side of zero, whose ends are not alike.
Law plays_of_a_bent_drive(const Excitation& at) {
  Law law = plays(at, "10 one-sided plays of a bent drive", 10, 0.03, 0.9, "one", 1.0);
  law.block.type = "generalized_prandtl_ishlinskii";
  give(law.block, "lower", level(at.lowest, at.unit));
  give(law.block, "upper", level(at.highest, at.unit));
  law.holds = {"asymmetry"};  // a narrow play of the bent drive is a curve
  for (const char* path : {"slope_at_lower", "slope_at_upper"}) {
    LawParameter slope;
    slope.path = path;
    slope.start = 1;
    slope.lower = 0;
    slope.upper = 3;  // a steeper curve would fall elsewhere
    slope.scan = {0.5, 1.5};
    law.free.push_back(slope);
    give(law.block, path, Number{1.0, {}});
  }
  return law;
}

/// Relays that may lie anywhere: nothing is said of how they are spread, and many numbers are. They say nothing beyond
/// the range that was driven.
Law relays(const Excitation& at, int cells) {
  Law law;
  law.name = fmt::format("relays that switch in {} cells", cells);
  law.block.type = "preisach";
  std::vector<double> levels;
  for (int i = 0; i <= cells; ++i) levels.push_back(at.lowest + at.range() * i / cells);
  give(law.block, "levels", with_unit(levels, at.unit));
  NumberList weights;
  for (int k = 0; k < cells * (cells + 1) / 2; ++k) {
    LawParameter w;
    w.path = element("weights", k);
    w.start = 0.02 * at.range() / cells;
    w.lower = 0;
    weights.push_back(with_unit(w.start, at.unit));
    law.free.push_back(w);
  }
  give(law.block, "weights", std::move(weights));
  give(law.block, "gain", Number{1.0, {}});
  if (!at.gain_is_free) {
    LawParameter own;
    own.path = "gain";
    own.start = 1;
    own.lower = 0;
    law.free.push_back(own);
  }
  law.holds = {"asymmetry"};  // relays without a loop of their own are a curve
  return law;
}

/// Is the drive to one side of zero: a tenth of its range may lie beyond.
bool is_unipolar(const Excitation& at) { return at.lowest > -0.1 * at.range() || at.highest < 0.1 * at.range(); }

/// Elements that have not slipped add to the spring, and whoever measured that over a stroke has them in it already.
LawParameter own_stiffness() {
  LawParameter spring;
  spring.path = "stiffness";
  spring.start = std::numeric_limits<double>::quiet_NaN();
  spring.lower = 0;
  return spring;
}

/// Elements that yield beside the spring of a mass. They follow the motion, as the loss in a flexure or a piezo stack
/// does; plays on the drive would ring along with the mass.
Law slip_elements(const Excitation& at) {
  const double range = at.travel_highest > at.travel_lowest ? at.travel_highest - at.travel_lowest : 1e-6;
  const double force = at.range() > 0 ? at.range() : 1;
  Law law;
  law.name = "6 slip elements in the spring";
  law.block.type = at.by;
  NumberList stiffness, distance;
  for (const double part : {0.01, 0.025, 0.06, 0.12, 0.22, 0.4}) {
    const int i = static_cast<int>(distance.size());
    distance.push_back(with_unit(part * range, parse_unit("um")));
    LawParameter k;
    k.path = element("contact_stiffness", i);
    k.is_size = true;
    k.start = 0.02 * force / range;
    k.lower = 0;
    k.upper = 100 * force / range;
    stiffness.push_back(with_unit(k.start, parse_unit("N/m")));
    law.free.push_back(k);
  }
  give(law.block, "contact_stiffness", std::move(stiffness));
  give(law.block, "slip_distance", std::move(distance));
  law.free.push_back(own_stiffness());
  return law;
}

/// The same where the spring gives way unevenly over the travel: grains and domains yield at one place more than at
/// another, as a Preisach's density says that is even along no line.
Law uneven_plays_in_the_spring(const Excitation& at) {
  const double half = 0.5 * (at.travel_highest > at.travel_lowest ? at.travel_highest - at.travel_lowest : 1e-6);
  const double softer = 0.01 * (at.range() > 0 ? at.range() : 1) / half;
  Law law;
  law.name = "6 uneven plays in the spring";
  law.block.type = "mass_on_spring_of_plays";
  law.holds = {"stiffening"};  // a narrow play is a curve
  NumberList thresholds;
  for (const double part : {0.02, 0.08, 0.2, 0.4, 0.6, 0.8})
    thresholds.push_back(with_unit(part * half, parse_unit("um")));
  for (const char* list : {"at_lower", "in_middle", "at_upper"}) {
    NumberList strengths;
    for (int i = 0; i < static_cast<int>(thresholds.size()); ++i) {
      strengths.push_back(with_unit(softer, parse_unit("N/m")));
      LawParameter k;
      k.path = element(list, i);
      k.start = softer;
      k.lower = 0;
      k.upper = 1e4 * softer;
      law.free.push_back(k);
    }
    give(law.block, list, std::move(strengths));
  }
  give(law.block, "thresholds", std::move(thresholds));
  const double middle = 0.5 * (at.travel_lowest + at.travel_highest);
  give(law.block, "lower", with_unit(middle - half, parse_unit("um")));
  give(law.block, "upper", with_unit(middle + half, parse_unit("um")));
  law.free.push_back(own_stiffness());
  return law;
}

/// A law of three numbers whose loops soften or harden with the travel and need not close at turning points: joints,
/// wire ropes, dampers. Elements that yield, and plays, only soften.
Law bouc_wen_in_the_spring(const Excitation& at) {
  const double range = at.travel_highest > at.travel_lowest ? at.travel_highest - at.travel_lowest : 1e-6;
  Law law;
  law.name = "Bouc-Wen in the spring";
  law.block.type = "mass_on_bouc_wen_spring";
  law.holds = {"stiffening"};  // without a loop it is a curve
  const auto free = [&](const char* path, double start, double upper, const char* unit, std::vector<double> scan) {
    LawParameter p;
    p.path = path;
    p.start = start;
    p.lower = 0;
    p.upper = upper;
    p.scan = std::move(scan);
    law.free.push_back(p);
    give(law.block, path, with_unit(start, parse_unit(unit)));
    return law.free.size() - 1;
  };
  free("hysteretic_share", 0.3, 1, "", {0.1, 0.4, 0.8});
  free("beta", 1 / range, 100 / range, "1/m", {0.3 / range, 2 / range, 10 / range});
  const auto gamma = free("gamma", 0, 100 / range, "1/m", {-1 / range, 0, 1 / range});
  law.free[gamma].lower = -100 / range;
  law.free.push_back(own_stiffness());
  return law;
}

/// How much of the spring remembers, and how far its loop is apart in the middle of the travel, for loops that are not
/// large: the half travel times beta of what that part holds back.
std::string bouc_wen_summary(const std::vector<double>& values, const Excitation& at) {
  if (values.size() < 2) return "";
  const double half = 0.5 * (at.travel_highest - at.travel_lowest);
  return fmt::format("{:.2g} % of the stiffness remembers, in a loop of about {:.2g} % of what it holds back",
                     100 * values[0], 100 * std::min(1.0, values[1] * half));
}

/// [N] by which the force is apart there, where the motion passes the middle on its way up and down.
double apart_by_plays(const NumberList& plays, const std::vector<double>& values, const Excitation& at) {
  const std::size_t n = plays.size();
  double force = 0;  // a play stands its half width to either side, and is there about as strong as in the middle
  for (std::size_t i = 0; i < n; ++i) {
    const double strength = (values[i] + 2 * values[n + i] + values[2 * n + i]) / 4, radius = plays[i].value * 1e-6;
    force += 2 * strength * std::min(radius, (at.travel_highest - at.travel_lowest) / 2 - radius);
  }
  return force;
}

/// [N] by which elements hold the mass back: after half the travel k times its distance each, or what it was bent.
double held_back_by_elements(const NumberList& distances, const std::vector<double>& values, const Excitation& at) {
  double force = 0;
  for (std::size_t i = 0; i < distances.size(); ++i)
    force += values[i] * std::min(distances[i].value * 1e-6, (at.travel_highest - at.travel_lowest) / 2);
  return force;
}

/// Of laws in the spring of a mass.
struct SpringLoop {
  double share = 0;  ///< of the force of the drive by which it is apart
  std::string text;
};
std::optional<SpringLoop> spring_loop(const Law& law, const std::vector<double>& values, const Excitation& at) {
  if (!(at.travel_highest > at.travel_lowest) || !(at.range() > 0)) return std::nullopt;
  if (law.block.type == "mass_on_bouc_wen_spring") {
    if (values.size() < 2) return std::nullopt;
    return SpringLoop{values[0] * values[1] * (at.travel_highest - at.travel_lowest) / 2, bouc_wen_summary(values, at)};
  }
  if (const auto* plays = written<NumberList>(law, "thresholds"); plays != nullptr) {
    if (values.size() < 3 * plays->size()) return std::nullopt;
    const double share = apart_by_plays(*plays, values, at) / at.range();
    return SpringLoop{share, fmt::format("a loop of about {:.2g} % of the force at full travel", 100 * share)};
  }
  const auto* list = written<NumberList>(law, "slip_distance");
  if (list == nullptr || list->size() > values.size()) return std::nullopt;
  const double share = held_back_by_elements(*list, values, at) / at.range();
  return SpringLoop{share,
                    fmt::format("elements that hold back {:.2g} % of the force at the end of a stroke", 100 * share)};
}

/// The loops of all plays at half the range, where a rising branch lags by min(r, R - r) [SI of the wire]. Of laws on a
/// wire.
struct Loop {
  double stroke = 0, gap = 0;
  double narrow = 0;  ///< part of the gap by plays that a short way takes along
};
/// The same of relays: behind a rising branch lag those that switch up above half the range and down below it.
Loop loop_of_relays(const Law& law, const std::vector<double>& values, const Excitation& at) {
  Loop loop;
  loop.stroke = (law.free.back().path == "gain" ? values.back() : 1) * at.range();
  const auto* levels = written<NumberList>(law, "levels");
  const std::size_t cells = levels != nullptr ? levels->size() - 1 : 0;
  for (std::size_t i = 0, k = 0; i < cells; ++i)
    for (std::size_t j = 0; j <= i; ++j, ++k) {
      loop.stroke += values[k];
      if (2 * i >= cells && 2 * j < cells) loop.gap += values[k];
    }
  return loop;
}

std::optional<Loop> loop_of(const Law& law, const std::vector<double>& values, const Excitation& at) {
  const double range = at.range();
  if (law.block.type == "preisach") return loop_of_relays(law, values, at);
  const auto* list = written<NumberList>(law, "thresholds");
  const auto* sides = written<std::string>(law, "sides");
  if (list == nullptr || sides == nullptr || !(range > 0)) return std::nullopt;
  // The weight of threshold 0 may be fixed at one.
  const std::size_t own = law.free.front().path == element("weights", 0) ? 0 : 1;
  Loop loop;
  loop.stroke = own == 1 ? range : 0;
  for (std::size_t i = own; i < list->size(); ++i) {
    const double r = at.unit.difference_to_si((*list)[i].value) * (*sides == "two" ? 2 : 1);
    const double w = values[i - own], gap = w * std::max(std::min(r, range - r), 0.0);
    loop.stroke += w * std::max(range - r, 0.0);
    loop.gap += gap;
    if (r < short_way * range) loop.narrow += gap;
  }
  return loop;
}

/// Width of the largest loop over the stroke.
std::string loop_width(const Law& law, const std::vector<double>& values, const Excitation& at) {
  if (!at.by.empty()) {
    const auto in_the_spring = spring_loop(law, values, at);
    return in_the_spring ? in_the_spring->text : "";
  }
  const auto loop = loop_of(law, values, at);
  if (!loop || !(loop->stroke > 0)) return "";
  return fmt::format("a loop of about {:.2g} % of the stroke at full drive", 100 * loop->gap / loop->stroke);
}

constexpr double no_loop = 1e-6;     // of the stroke: what a fit leaves on plays that it does not need
constexpr double nearly_all = 0.95;  // of a loop: what noise puts on the other plays is less than a twentieth

/// Domains switch over the whole range; what has followed after a tenth of it is a clearance. Without a loop only what
/// the law finds anew besides is left: a gain, a stiffness, a curve.
std::string why_no_hysteresis(const Law& law, const std::vector<double>& values, const Excitation& at) {
  const std::string no_memory = "it has no loop: nothing of it remembers";
  if (!at.by.empty()) {
    const auto in_the_spring = spring_loop(law, values, at);
    return in_the_spring && !(in_the_spring->share > no_loop) ? no_memory : "";
  }
  const auto loop = loop_of(law, values, at);
  if (!loop) return "";
  if (!(loop->gap > no_loop * loop->stroke)) return no_memory;
  return loop->narrow < nearly_all * loop->gap ? ""
                                               : "its loop closes within a tenth of the stroke: that is backlash, "
                                                 "not hysteresis";
}

}  // namespace

Effect hysteresis() {
  Effect e;
  e.id = "hysteresis";
  e.title = "Hysteresis";
  e.cause =
      "Polarisation domains switch with the history of the field; the response remembers its turning points, at any "
      "speed.";
  e.equation =
      "y = w0*u + sum w_i*z_i;  one-sided play z = max(u - r, min(u, z)), two-sided z = max(u - r, min(u + r, z)),  "
      "w_i >= 0";
  e.source =
      "Kuhnen, Eur. J. Control 9 (2003) 407; thesis Eqs. 2.15-2.19; bent drive: Al Janaideh, Rakheja, Su, IEEE/ASME "
      "Trans. Mechatronics 16 (2011) 734; relays: Banks, Kurdila, Webb, Math. Probl. Eng. 3 (1997) 287";
  e.residual =
      "A lens of the residual against the drive, closed at turning points, that shrinks with the amplitude; odd "
      "harmonics only.";
  e.needs =
      "At least two reversals of the drive. One amplitude gives the width of the loop only; minor loops need several.";
  e.way = Way::insert;
  e.commutes = Commutes::gains;
  e.block_type = "prandtl_ishlinskii";
  e.places = {"core"};
  e.is_memory = true;
  e.moves_zero = true;
  e.parameters = {
      {"thresholds", "unit of the wire", "of the plays; fixed over 4 .. 65 % of the range (richer: 2 .. 90 %)", ""},
      {"weights", "", "of the plays, relative to the wire's own gain",
       "each 0.01 .. 0.2; the loop is 2 % of the stroke at small and 10 .. 15 % at full drive (piceramic.com "
       "tutorial)"},
      {"at_lower, in_middle, at_upper", "N/m",
       "of a mass, richer than slip elements: by how much plays soften its spring over the travel", ""},
      {"hysteretic_share", "",
       "of a mass: what part of its stiffness follows a Bouc-Wen law, which may harden with the travel", "0 .. 1"},
      {"beta, gamma", "1/m", "of that law: the loop, and whether it softens (beta + gamma > 0) or hardens", ""},
      {"slope_at_lower, slope_at_upper", "", "richer: of the bent drive that the plays follow", "0 .. 3"},
      {"weights (relays)", "unit of the wire",
       "richest: of Preisach's relays that switch up in one cell of the range and down in another, 6 or 10 cells; "
       "nothing is said of how they are spread, and nothing beyond the range that was driven",
       ""}};
  e.look_alikes = {
      {"amplifier_lag", "high_frequencies", "phase of a loop does not grow with frequency, that of a lag does"},
      {"sensor_lag", "high_frequencies", "phase of a loop does not grow with frequency, that of a lag does"},
      {"dead_time", "high_frequencies", "phase of a loop does not grow with frequency, that of a delay does"},
      {"creep", "sine_amplitudes", "phase of a loop grows with the amplitude, that of creep does not"},
      {"initial_remanence", "precycle", "everywhere against first cycle only"}};
  e.family = "hysteresis";
  e.contains = {"calibration", "friction"};
  e.variation = "hysteretic_spring";
  e.summary = loop_width;
  e.implausible = why_no_hysteresis;
  e.laws = [](const Excitation& at) {
    if (!at.by.empty())
      return std::vector<Law>{slip_elements(at), uneven_plays_in_the_spring(at), bouc_wen_in_the_spring(at)};
    const Law one_sided = plays(at, "18 one-sided plays", 18, 0.03, 0.90, "one", 1.0);
    const Law two_sided = plays(at, "18 two-sided plays", 18, 0.015, 0.45, "two", 1.0);
    // From rest at zero what is driven to one side slips that way only, what is driven about zero either way.
    std::vector<Law> laws;
    if (is_unipolar(at))
      laws = {plays(at, "6 one-sided plays", 6, 0.04, 0.65, "one", 1.0), one_sided, two_sided,
              plays_of_a_bent_drive(at)};
    else
      laws = {plays(at, "6 two-sided plays", 6, 0.02, 0.325, "two", 1.0), two_sided, one_sided};
    if (at.range() > 0)
      for (const int cells : {6, 10}) laws.push_back(relays(at, cells));
    return laws;
  };
  e.unsure = [](const Excitation& at) { return few_sizes(at, "tell its loop from a lag and from lost motion"); };
  e.unseen = [](const Excitation& at) -> std::string {
    if (at.springless) return "the mass is on no spring: what remembers its turning points there is friction";
    if (!at.memory_blocks.empty())
      return fmt::format(
          "the diagram has memory already ({}): another shape of it would be an asymmetry, not a missing hysteresis",
          fmt::join(at.memory_blocks, ", "));
    if (at.from_data && at.reversals < 2)
      return fmt::format("the drive turns {} times, hysteresis needs at least 2 reversals within its range",
                         at.reversals);
    return "";
  };
  return e;
}

}  // namespace hysteron::effects
