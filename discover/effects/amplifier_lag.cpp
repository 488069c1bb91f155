// The effect amplifier_lag: the amplifier follows its command late, with a time constant. Also the laws of any lag.
#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "discover/effects/library.h"

namespace hysteron::effects {
namespace {

LawParameter time_constant(const Excitation& at, int index) {
  LawParameter tau;
  tau.path = element("times", index);
  tau.log_scale = true;
  // The lower bound must be as good as none, however quiet the sensor; what is slower than the recordings integrates.
  tau.lower = at.shortest_step * 1e-4;
  tau.upper = std::max(at.longest_recording, 10 * at.shortest_step);
  tau.start = at.shortest_step;
  if (index == 0) tau.scan = per_decade(at.shortest_step / 50, tau.upper / 2, 3);
  return tau;
}

}  // namespace

std::vector<Law> lag_laws(const Excitation& at) {
  Law one;
  one.name = "one pole";
  one.block.type = "lag";
  give(one.block, "times", NumberList{with_unit(at.shortest_step, parse_unit("s"))});
  one.free = {time_constant(at, 0)};

  Law two = one;
  two.name = "two poles";
  give(two.block, "times", with_unit({at.shortest_step, at.shortest_step / 10}, parse_unit("s")));
  two.free = {time_constant(at, 0), time_constant(at, 1)};
  two.free[1].start = at.shortest_step / 10;
  for (auto& tau : two.free) tau.interchangeable = true;
  return {one, two};
}

std::string lag_summary(const Law&, const std::vector<double>& values, const Excitation&) {
  std::string text;
  double total = 0;
  for (const double tau : values) {
    text += (text.empty() ? "" : " and ") + time_text(tau);
    total += tau;
  }
  return fmt::format("time constant{} {}, corner near {:.3g} Hz", values.size() > 1 ? "s" : "", text,
                     1 / (2 * std::numbers::pi * total));
}

std::string lag_without_end(const Law& law, const std::vector<double>& values, const Excitation&) {
  const double slowest = *std::max_element(values.begin(), values.end());
  if (slowest < 0.99 * law.free.front().upper) return "";
  return fmt::format("its time constant is at the length of the longest recording, {}: that is no lag, it integrates",
                     time_text(law.free.front().upper));
}

Effect amplifier_lag() {
  Effect e;
  e.id = "amplifier_lag";
  e.title = "Lag of the amplifier";
  e.cause = "The amplifier's bandwidth, and its output resistance into the capacitance of the actuator.";
  e.equation = "tau*dv/dt = u - v (one pole), two such in series (two poles)";
  e.source =
      "Devasia, Eleftheriou, Moheimani, IEEE Trans. Control Syst. Technol. 15 (2007) 802 (bandwidth of the drive)";
  e.residual =
      "In proportion to the rate of the drive at all amplitudes; phase in proportion to frequency, no harmonics.";
  e.needs = "Motion at a twentieth of the corner frequency or faster.";
  e.way = Way::insert;
  e.commutes = Commutes::linear;
  e.block_type = "lag";
  e.places = {"command"};
  e.parameters = {
      {"times", "s", "time constants of the poles",
       "8 us .. 0.5 ms for piezo amplifiers (0.3 .. 20 kHz; PD200 with 10 uF: 7.4 kHz small, 300 Hz large signal)"}};
  e.look_alikes = {{"dead_time", "multisine", "gain drops with the phase of a lag, and stays 1 with a delay"},
                   {"sensor_lag", "monitor", "the drive measured behind the amplifier decides"},
                   {"hysteresis", "high_frequencies", "phase of a lag grows with frequency, that of a loop does not"},
                   {"creep", "step_hold", "a lag settles after a few time constants, creep goes on with log t"}};
  e.family = "lag";
  e.summary = lag_summary;
  e.implausible = lag_without_end;
  e.laws = [](const Excitation& at) {
    auto laws = lag_laws(at);
    // The prior speaks of amplifiers for piezo actuators: volts.
    if (at.unit.dimension == parse_unit("V").dimension)
      for (auto& law : laws) {
        law.free.front().plausible_lower = 8e-6;
        law.free.front().plausible_upper = 5e-4;
      }
    return laws;
  };
  e.unseen = [](const Excitation& at) -> std::string {
    return at.from_data && at.range() <= 0 ? "the drive does not move" : "";
  };
  return e;
}

}  // namespace hysteron::effects
