// The effect ageing: the gain falls with the logarithm of cycles, or of time.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "discover/hypotheses/effect_terms.h"
#include "fit/signals/unit_words.h"

namespace hysteron::effects {
namespace {

/// In hours where the side signal is a time, else in cycles.
bool by_hours(const Excitation& at) { return at.side_unit.dimension == parse_unit("s").dimension; }

/// Where the decades begin: a hundred cycles, or an hour [SI]. Before that a device is still settling.
double first_use(const Excitation& at) { return by_hours(at) ? 3600 : 100; }

/// Decades of use between the recordings, those that only judge among them.
double decades_of_use(const Excitation& at) {
  const double n0 = first_use(at);
  return std::log10((1 + at.side_highest / n0) / (1 + std::max(at.side_lowest, 0.0) / n0));
}

Law logarithmic(const Excitation& at, bool free_first) {
  Law law;
  law.name = free_first ? "decades that begin anywhere" : by_hours(at) ? "per decade of hours" : "per decade of cycles";
  law.block.type = "ageing";
  give(law.block, "per_decade", 0.01);
  give(law.block, "first", by_hours(at) ? Number{1, "h"} : Number{100, {}});
  // A turn by a fiftieth of the range is a cycle of the rig's counter; less is its resolution.
  if (!by_hours(at) && at.range() > 0) give(law.block, "swing", with_unit(0.02 * at.range(), at.unit));
  LawParameter a;
  a.path = "per_decade";
  a.is_size = true;
  a.start = 0.01;
  a.lower = at.from_data && decades_of_use(at) < 1 ? 0 : -0.2;  // one age alone: a gain that rose has not aged
  a.upper = 0.3;
  a.plausible_lower = 0;
  a.plausible_upper = 0.1;
  law.free = {a};
  if (!free_first) return law;
  LawParameter first;
  first.path = "first";
  first.start = first_use(at);
  first.lower = 1e-2 * first.start;
  first.upper = 1e4 * first.start;
  first.log_scale = true;
  first.scan = {0.1 * first.start, first.start, 10 * first.start};
  law.free.push_back(first);
  return law;
}

}  // namespace

Effect ageing() {
  Effect e;
  e.id = e.family = "ageing";
  e.title = "Ageing";
  e.cause = "The ceramic loses polarisation with time and use.";
  e.equation = "y = u*(1 - per_decade*log10(1 + n/first)), n cycles (or hours) so far";
  e.source =
      "Jaffe, Cook, Jaffe, Piezoelectric Ceramics (1971), chapter 7; PI Ceramic catalogue (driven actuators repole and "
      "hardly age); Zhang, Jones, Acta Mater. 58 (2010) 1584";
  e.residual = "A gain that differs between recordings, in the order of the cycles.";
  e.needs = "cycles_before or start of each recording, over a decade of use or more.";
  e.way = Way::insert;
  e.block_type = "ageing";
  e.places = {"core"};
  e.behind_core = true;
  e.side = Side::use;
  e.parameters = {{"per_decade", "", "part of the gain that a decade of use takes", "0.01 .. 0.05 (small-signal d33)"},
                  {"first", "cycles or h", "use at which the decades begin", "100 cycles, 1 h"}};
  e.look_alikes = {{"temperature_gain", "repeat_after_cycles", "ageing follows the cycles, not the temperature"},
                   {"calibration", "repeat_after_cycles", "a calibration is the same in all recordings"},
                   {"asymmetry", "repeat_after_cycles", "a curve is the same in all recordings"}};
  e.plainer = {"calibration"};  // a constant
  e.summary = [](const Law& law, const std::vector<double>& values, const Excitation& at) {
    std::string text =
        fmt::format("{} of the gain per decade of {}", fraction_text(values[0]), by_hours(at) ? "time" : "cycles");
    if (law.free.size() > 1)
      text += by_hours(at) ? " beyond " + time_text(values[1]) : fmt::format(" beyond {:.3g} cycles", values[1]);
    return text;
  };
  e.laws = [](const Excitation& at) { return std::vector<Law>{logarithmic(at, false), logarithmic(at, true)}; };
  e.unseen = [](const Excitation& at) -> std::string {
    if (!at.from_data) return "";
    if (at.range() <= 0) return stands_still(at);
    const double decades = decades_of_use(at);
    if (decades >= 1) return "";
    return fmt::format("the recordings span {:.2g} decades of {}, ageing needs one", decades,
                       by_hours(at) ? "hours" : "cycles");
  };
  // Much use behind all recordings alike; a new device has not aged.
  e.may_hide = [](const Excitation& at) { return at.side_lowest >= 10 * first_use(at); };
  return e;
}

}  // namespace hysteron::effects
