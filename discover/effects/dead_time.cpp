// The effect dead_time: everything happens later by the same time.
#include <fmt/format.h>

#include <algorithm>

#include "discover/hypotheses/effect_terms.h"

namespace hysteron::effects {

Effect dead_time() {
  Effect e;
  e.id = "dead_time";
  e.title = "Dead time";
  e.cause =
      "Converters, sample-and-hold, a field bus, transport of heat or matter, or a column written one sample late.";
  e.equation = "y(t) = u(t - delay)";
  e.source = "Ljung, System Identification (1999), section 4.2";
  e.residual = "The rate of the output times the delay.";
  e.needs = "Motion at a fiftieth of 1/delay or faster.";
  e.way = Way::insert;
  e.commutes = Commutes::time_invariant;
  e.block_type = "dead_time";
  e.places = {"command", "measured"};
  e.parameters = {{"delay", "s", "",
                   "half a sample to three samples for converters, 20 us .. 5 ms for piezo rigs; as many "
                   "samples at every sample rate is a fact of the file, not of the device"}};
  e.look_alikes = {{"amplifier_lag", "multisine", "gain drops with the phase of a lag, and stays 1 with a delay"},
                   {"sensor_lag", "multisine", "gain drops with the phase of a lag, and stays 1 with a delay"},
                   {"hysteresis", "high_frequencies", "phase of a delay grows with frequency, that of a loop does not"},
                   {"creep", "low_frequencies", "a delay has no gain that falls with frequency"}};
  e.family = "dead_time";
  e.summary = [](const Law&, const std::vector<double>& values, const Excitation& at) {
    return fmt::format("{}, {:.3g} rows of the fastest recording", time_text(values.front()),
                       values.front() / at.shortest_step);
  };
  e.laws = [](const Excitation& at) {
    Law law;
    law.name = "one delay";
    law.block.type = "dead_time";
    give(law.block, "delay", with_unit(at.shortest_step, parse_unit("s")));
    LawParameter delay;
    delay.path = "delay";
    delay.is_size = true;
    delay.start = at.shortest_step;
    delay.lower = 0;
    delay.upper = at.longest_recording / 5;
    delay.log_scale = false;
    delay.scan = per_decade(at.shortest_step / 50, delay.upper / 2, 3);
    law.free.push_back(delay);
    return std::vector<Law>{law};
  };
  e.unseen = stands_still;
  return e;
}

}  // namespace hysteron::effects
