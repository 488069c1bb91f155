// The effect creep: slow further motion after a change, in proportion to it, growing with the logarithm of time.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "discover/hypotheses/effect_terms.h"

namespace hysteron::effects {

namespace {

struct Relaxation {
  double time = 0;    ///< [s]
  double amount = 0;  ///< [-] that it adds per unit of change
};
std::vector<Relaxation> relaxations(const Law& law, const std::vector<double>& values) {
  std::vector<double> times;
  if (const auto* list = written<NumberList>(law, "times"))
    for (const auto& t : *list) times.push_back(t.value);
  std::vector<Relaxation> all;
  for (std::size_t k = 0; k < times.size(); ++k) {
    const bool logarithm = law.block.type == "logarithmic_creep";
    all.push_back({times[k], logarithm ? values.at(0) / 2 * std::exp(-values.at(1) / times[k]) : values.at(k)});
  }
  return all;
}

/// Creep goes by the logarithm of time: what shows nothing within the longest hold and much behind it is a drift.
std::string why_no_creep(const Law& law, const std::vector<double>& values, const Excitation& at) {
  double shown = 0, all = 0;
  for (const auto& [time, amount] : relaxations(law, values)) {
    all += amount;
    if (time <= at.longest_hold) shown += amount;
  }
  if (shown >= 0.1 * all) return "";
  return fmt::format("{:.0f} % of it would lie beyond the longest hold of {}: that is a drift, not creep",
                     100 * (1 - shown / all), time_text(at.longest_hold));
}

/// Two relaxations make a decade; those slower than the longest hold are extrapolated and do not count, nor those
/// before creep sets in.
std::string creep_summary(const Law& law, const std::vector<double>& values, const Excitation& at) {
  const auto all = relaxations(law, values);
  const double hold = std::max(at.longest_hold, 10 * at.shortest_step);
  double largest = 0, sum = 0, first = 0, last = 0;
  for (const auto& r : all) largest = std::max(largest, r.amount);
  for (const auto& [time, amount] : all) {
    if (time > hold || (first == 0 && amount < 0.05 * largest)) continue;
    sum += amount;
    if (first == 0) first = time;
    last = time;
  }
  if (!(last > first)) return "";
  const double decades = std::log10(last / first) + 0.5;
  return fmt::format(
      "{:.2g} % of the move per decade between {} and {}; what lies beyond the longest hold of {} is extrapolated",
      100 * sum / decades, time_text(first), time_text(last), time_text(at.longest_hold));
}

double shortest_time(const Excitation& at) { return std::max(at.shortest_step, 1e-3); }

/// Two relaxations per decade, up to so many times the longest recording.
std::vector<double> times_up_to(double recordings, const Excitation& at) {
  return per_decade(shortest_time(at), std::max(recordings * at.longest_recording, 10 * shortest_time(at)), 2);
}

/// Two numbers, as catalogues tell it.
Law by_the_logarithm(const Excitation& at) {
  const auto times = times_up_to(10, at);  // an end there is missed by 2 % of what a decade adds
  Law law;
  law.name = "logarithm of time";
  law.block.type = "logarithmic_creep";
  LawParameter amount;
  amount.path = "per_decade";
  amount.is_size = true;
  amount.start = 0.01;
  amount.lower = 0;
  amount.upper = 0.4;  // twenty times what is reported: what moves on by more is no creep but another plant
  amount.plausible_upper = 0.1;
  LawParameter first;
  first.path = "first_time";
  first.start = times.front();
  first.lower = times.front();
  // What sets in later than a tenth of the longest hold shows less than a decade: that would be a drift.
  first.upper = std::max(at.longest_hold / 10, 10 * times.front());
  first.scan = per_decade(times.front(), first.upper, 1);
  first.log_scale = true;
  give(law.block, "per_decade", Number{amount.start, {}});
  give(law.block, "first_time", with_unit(first.start, parse_unit("s")));
  give(law.block, "times", with_unit(times, parse_unit("s")));
  law.free = {amount, first};
  return law;
}

/// What is no logarithm: each relaxation has an amount of its own.
Law by_relaxations(const Excitation& at) {
  const auto times = times_up_to(2, at);
  Law law;
  law.name = "two relaxations per decade";
  law.block.type = "creep";
  NumberList amounts;
  for (std::size_t k = 0; k < times.size(); ++k) {
    amounts.push_back(Number{0.005, {}});
    LawParameter c;
    c.path = element("amounts", static_cast<int>(k));
    c.start = 0.005;
    c.lower = 0;
    c.upper = 0.2;  // see the logarithm: two make a decade
    c.plausible_upper = 0.05;
    law.free.push_back(c);
  }
  give(law.block, "amounts", std::move(amounts));
  give(law.block, "times", with_unit(times, parse_unit("s")));
  return law;
}

}  // namespace

Effect creep() {
  Effect e;
  e.id = "creep";
  e.title = "Creep";
  e.cause = "Polarisation goes on changing slowly after a change of the drive.";
  e.equation =
      "after a step y = u*(1 + gamma*log10(1 + t/t0)) (logarithm of time); y = u + sum c_k*x_k, tau_k*x_k' = u - x_k, "
      "c_k >= 0 (two relaxations per decade)";
  e.source = "Croft, Shed, Devasia, JDSMC 123 (2001) 35; Jung, Gweon, Rev. Sci. Instrum. 71 (2000) 1896";
  e.residual =
      "During holds the residual drifts on in the direction of the last move, linearly in log t, in proportion to the "
      "move.";
  e.needs = "A hold at least 100 times as long as its sample step, after a move.";
  e.way = Way::insert;
  e.commutes = Commutes::linear;
  e.block_type = "logarithmic_creep";
  e.places = {"core"};
  e.behind_core = true;
  e.parameters = {
      {"per_decade", "", "gamma: share of the move that each decade of time adds",
       "0.01 .. 0.02 (PI Ceramic catalogue, physikinstrumente.com tutorial); at most 0.1 for soft ceramics"},
      {"first_time", "s", "t0: when after a move creep sets in", "not within the last decade of the longest hold"},
      {"amounts", "", "final amount of each relaxation per unit of change; two relaxations make one decade",
       "0.01 .. 0.02 per decade (PI Ceramic catalogue, physikinstrumente.com tutorial); at most 0.1 for soft ceramics"},
      {"times", "s",
       "fixed: two per decade from the sample step (not below 1 ms) to twice the longest recording (to ten times for "
       "the logarithm)",
       ""}};
  e.look_alikes = {
      {"hysteresis", "sine_amplitudes", "phase of a loop grows with the amplitude, that of creep does not"},
      {"amplifier_lag", "step_hold", "a lag settles after a few time constants, creep goes on with log t"},
      {"sensor_lag", "step_hold", "a lag settles after a few time constants, creep goes on with log t"},
      {"dead_time", "low_frequencies", "a delay has no gain that falls with frequency"}};
  e.plainer = {"calibration"};  // where nothing holds long, it comes all at once
  e.family = "creep";
  e.implausible = why_no_creep;
  e.summary = creep_summary;
  e.laws = [](const Excitation& at) { return std::vector<Law>{by_the_logarithm(at), by_relaxations(at)}; };
  e.seen_by_degrees = true;
  e.unseen = [](const Excitation& at) -> std::string {
    if (!at.from_data) return "";
    const double needed = 100 * at.step_at_longest_hold;
    if (at.longest_hold < needed)
      return fmt::format("longest hold {}, creep needs {} (100 samples) at one level after a move",
                         time_text(at.longest_hold), time_text(needed));
    return "";
  };
  return e;
}

}  // namespace hysteron::effects
