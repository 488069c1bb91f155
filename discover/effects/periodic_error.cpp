// The effect periodic_error: an error of a position that comes again at the same positions.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "discover/hypotheses/effect_terms.h"
#include "fit/signals/unit_words.h"

namespace hysteron::effects {
namespace {

constexpr double fewest_periods = 3, most_periods = 400;  // passed on the way from the lowest to the highest position

/// Two levels of the column make a period at least; what comes again with every step between them is its rounding.
double shortest_period(const Excitation& at) { return std::max(at.range() / most_periods, 2 * at.resolution); }

bool is_position(const Unit& unit) {
  return unit.dimension == parse_unit("m").dimension || unit.dimension == parse_unit("rad").dimension;
}

/// Amplitudes of one harmonic, of a tenth of the range at most: what is larger is no error of a position. Where each
/// recording has a zero of its own, the scale begins somewhere else in each, and so does its error.
void add_harmonic(Law& law, const Excitation& at, const char* cosine, const char* sine) {
  const double range = at.range() > 0 ? at.range() : 1;
  for (const char* path : {cosine, sine}) {
    LawParameter a;
    a.path = path;
    a.start = 0;
    a.per_recording = at.zero_of_recording;
    if (!a.per_recording) {
      a.lower = -0.1 * range;
      a.upper = 0.1 * range;
    }
    give(law.block, path, with_unit(0.0, at.unit));
    law.free.push_back(a);
  }
}

Law harmonics(const Excitation& at, int n) {
  Law law;
  law.name = n == 1 ? "once a period" : "once and twice a period";
  law.block.type = "periodic_error";
  const double range = at.range() > 0 ? at.range() : 1;
  LawParameter period;
  period.path = "period";
  period.start = range / 10;
  period.lower = at.range() > 0 ? shortest_period(at) : range / most_periods;
  period.upper = range / (fewest_periods - 1);
  period.log_scale = true;
  period.period_of_wire = true;
  for (double k = fewest_periods; range / k >= period.lower; k *= 1.3) period.scan.push_back(range / k);
  give(law.block, "period", with_unit(period.start, at.unit));
  law.free = {period};
  add_harmonic(law, at, "cosine", "sine");
  if (n > 1) add_harmonic(law, at, "second_cosine", "second_sine");
  return law;
}

}  // namespace

Effect periodic_error() {
  Effect e;
  e.id = e.family = "periodic_error";
  e.title = "Error periodic in the position";
  e.cause = "Interpolation of an encoder, a resolver or an interferometer; the pitch of a screw, an eccentric wheel.";
  e.equation = "y = u + sum_k cosine_k*cos(2*pi*k*u/period) + sine_k*sin(2*pi*k*u/period), k = 1, 2";
  e.source = "Heydemann, Applied Optics 20 (1981) 3382-3384; Slocum, Precision Machine Design (1992), chapter 10";
  e.residual =
      "A ripple whose frequency is the speed's, at the same positions whichever way and however fast it moves.";
  e.needs = "Motion through three periods or more, at more than one speed.";
  e.way = Way::insert;
  e.block_type = "periodic_error";
  e.places = {"measured"};
  e.parameters = {
      {"period", "unit of the signal", "after which it comes again", "pitch of the scale, the screw, the poles"},
      {"cosine, sine", "unit of the signal", "of the error once a period", "0.1 .. 5 % of the period"},
      {"second_cosine, second_sine", "unit of the signal", "twice a period", "as cosine"}};
  e.look_alikes = {
      {"mains_interference", "triangle", "a line of the mains keeps its frequency when the motion is slower"},
      {"cogging", "triangle", "a torque is softened by the inertia the more the faster it turns; a reading is not"},
      {"quantization", "triangle", "rounding comes again with every step of the column, and is a saw tooth"},
      {"sensor_nonlinearity", "triangle", "a curve of few orders does not come again"}};
  e.summary = [](const Law&, const std::vector<double>& values, const Excitation& at) {
    return fmt::format("{} every {:.4g} {}{}", size_text(std::hypot(values[1], values[2]), at.unit),
                       at.unit.difference_from_si(values[0]), at.unit.text,
                       at.zero_of_recording ? ", in the last recording" : "");
  };
  e.laws = [](const Excitation& at) { return std::vector<Law>{harmonics(at, 1), harmonics(at, 2)}; };
  e.unseen = [](const Excitation& at) -> std::string {
    if (const auto still = stands_still(at); !still.empty() || !at.from_data) return still;
    if (!is_position(at.unit))
      return fmt::format("what is measured in {} is no position: a length, an angle or counts", at.unit.text);
    if (shortest_period(at) * fewest_periods > at.range())
      return "the column has fewer levels than three periods need, two each; record it more finely";
    return "";
  };
  return e;
}

}  // namespace hysteron::effects
