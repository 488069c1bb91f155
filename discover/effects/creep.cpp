// The effect creep: slow further motion after a change, in proportion to it, growing with the logarithm of time.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "discover/effects/library.h"

namespace hysteron::effects {

Effect creep() {
  Effect e;
  e.id = "creep";
  e.title = "Creep";
  e.cause = "Polarisation goes on changing slowly after a change of the drive.";
  e.equation = "y = u + sum c_k*x_k,  tau_k*x_k' = u - x_k,  c_k >= 0: together about gamma*log10(t) after a step";
  e.source = "Croft, Shed, Devasia, JDSMC 123 (2001) 35; Jung, Gweon, Rev. Sci. Instrum. 71 (2000) 1896";
  e.residual =
      "During holds the residual drifts on in the direction of the last move, linearly in log t, in proportion to the "
      "move.";
  e.needs = "A hold at least 100 times as long as its sample step, after a move.";
  e.way = Way::insert;
  e.commutes = Commutes::linear;
  e.block_type = "creep";
  e.places = {"core"};
  e.behind_core = true;
  e.parameters = {
      {"amounts", "", "final amount of each relaxation per unit of change; two relaxations make one decade",
       "0.01 .. 0.02 per decade (PI Ceramic catalogue, physikinstrumente.com tutorial); at most 0.1 for soft ceramics"},
      {"times", "s", "fixed: two per decade from the sample step (not below 1 ms) to twice the longest recording", ""}};
  e.look_alikes = {
      {"hysteresis", "sine_amplitudes", "phase of a loop grows with the amplitude, that of creep does not"},
      {"amplifier_lag", "step_hold", "a lag settles after a few time constants, creep goes on with log t"},
      {"sensor_lag", "step_hold", "a lag settles after a few time constants, creep goes on with log t"},
      {"dead_time", "low_frequencies", "a delay has no gain that falls with frequency"}};
  e.family = "creep";
  e.implausible = [](const Law& law, const std::vector<double>& values, const Circumstances& at) -> std::string {
    // Creep goes by the logarithm of time: what shows nothing within the longest hold and much behind it is a drift.
    const auto* times = std::get_if<NumberList>(&law.block.parameters.find("times")->content);
    double shown = 0;
    double all = 0;
    for (std::size_t k = 0; times != nullptr && k < std::min(times->size(), values.size()); ++k) {
      all += values[k];
      if ((*times)[k].value <= at.longest_hold) shown += values[k];
    }
    if (shown >= 0.1 * all) return "";
    return fmt::format("{:.0f} % of it would lie beyond the longest hold of {}: that is a drift, not creep",
                       100 * (1 - shown / all), time_text(at.longest_hold));
  };
  e.summary = [](const Law& law, const std::vector<double>& values, const Circumstances& at) {
    // Two relaxations make a decade; those slower than the longest hold are extrapolated and do not count, nor those
    // before creep sets in.
    const auto* times = std::get_if<NumberList>(&law.block.parameters.find("times")->content);
    const double hold = std::max(at.longest_hold, 10 * at.shortest_step);
    const double largest = values.empty() ? 0 : *std::max_element(values.begin(), values.end());
    double sum = 0;
    double first = 0;
    double last = 0;
    for (std::size_t k = 0; times != nullptr && k < std::min(times->size(), values.size()); ++k) {
      if ((*times)[k].value > hold || (first == 0 && values[k] < 0.05 * largest)) continue;
      sum += values[k];
      if (first == 0) first = (*times)[k].value;
      last = (*times)[k].value;
    }
    if (!(last > first)) return std::string();
    const double decades = std::log10(last / first) + 0.5;
    return fmt::format(
        "{:.2g} % of the move per decade between {} and {}; what lies beyond the longest hold of {} is extrapolated",
        100 * sum / decades, time_text(first), time_text(last), time_text(at.longest_hold));
  };
  e.laws = [](const Circumstances& at) {
    const double fastest = std::max(at.shortest_step, 1e-3);
    const auto times = per_decade(fastest, std::max(2 * at.longest_recording, 10 * fastest), 2);
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
      c.upper = 0.2;  // twenty times what is reported: what moves on by more is no creep but another plant
      c.plausible_upper = 0.05;
      law.free.push_back(c);
    }
    give(law.block, "amounts", std::move(amounts));
    give(law.block, "times", with_unit(times, parse_unit("s")));
    return std::vector<Law>{law};
  };
  e.unseen = [](const Circumstances& at) -> std::string {
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
