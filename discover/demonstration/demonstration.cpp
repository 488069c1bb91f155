// Decides how an effect is shown to a person without any data. See demonstration.h.
#include "discover/demonstration/demonstration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "discover/demonstration/demo_rig.h"
#include "discover/demonstration/trial.h"
#include "engine/diagram/error.h"

namespace hysteron {
namespace {

constexpr int points_over_time = 800, points_of_loop = 2000;

std::vector<double> between(double from, double to, int points) {
  std::vector<double> t;
  for (int k = 0; k < points; ++k) t.push_back(from + (to - from) * k / (points - 1));
  return t;
}

/// The times that show it: all of them where it goes on, else as long as it takes to settle, or a few periods.
struct Window {
  double from = 0, to = 0;
  bool goes_on = false;
};

Window window_of(const std::vector<double>& t, const std::vector<double>& difference, bool periodic) {
  const double little = 0.02 * span_of(difference), last = difference.back();
  std::size_t begin = 0, end = t.size() - 1;
  while (begin + 1 < t.size() && std::abs(difference[begin] - difference.front()) <= little) ++begin;
  while (end > begin && std::abs(difference[end] - last) <= little) --end;
  if (periodic) {
    end = t.size() - 1;
    int changes = 0;
    for (std::size_t i = begin + 1; i < t.size() && changes < 12; ++i)
      if (difference[i] * difference[i - 1] < 0 && ++changes == 12) end = i;
  }
  if (t[end] - t[begin] > 0.5 * (t.back() - t[begin])) return {0, t.back(), true};
  const double length = std::max(t[end] - t[begin], 5 * (t[1] - t[0]));
  return {std::max(0.0, t[begin] - 0.3 * length), std::min(t.back(), t[begin] + 1.5 * length), false};
}

std::string numbers_text(const Effect& effect, const DemoRun& trial) {
  std::vector<double> values = trial.values();
  if (std::any_of(values.begin(), values.end(), [](double v) { return !std::isfinite(v); })) return trial.law().name;
  if (effect.summary)
    if (std::string text = effect.summary(trial.law(), values, trial.excitation()); !text.empty()) return text;
  std::string text;
  for (std::size_t i = 0; i < values.size(); ++i)
    text += fmt::format("{}{} {:.3g}", i > 0 ? ", " : "", trial.law().free[i].path, values[i]);
  return text;
}

void set_times(Demonstration& d, const DemoRun& trial, const Stimulus& stimulus, Nature nature) {
  if (nature == Nature::memory || nature == Nature::curve) {
    d.against_input = true;
    d.t = between(0, stimulus.length, points_of_loop);
    return;
  }
  d.t = between(0, stimulus.length, points_over_time);
  if (nature != Nature::settling && nature != Nature::clock) return;
  const auto difference = minus(trial.with(trial.rows()), trial.plain());
  const Window w = window_of(trial.rows(), difference, nature == Nature::clock);
  d.log_time = w.goes_on && stimulus.step_at > 0;
  if (!d.log_time) {
    d.t = between(w.from, w.to, points_over_time);
    return;
  }
  for (double& t : d.t) {  // decades of time behind the step
    const double part = t / stimulus.length, longest = stimulus.length - stimulus.step_at;
    t = stimulus.step_at + stimulus.row * std::pow(longest / stimulus.row, part);
  }
}

Demonstration show(const Effect& effect, const DemoRig& demo_rig, const Stimulus& stimulus, const DemoRun& trial,
                   Nature nature) {
  Demonstration d;
  d.signal = stimulus.text;
  d.device = demo_rig.device;
  d.law = trial.law().name;
  d.numbers = numbers_text(effect, trial);
  d.null_value = neutral_values(trial);
  d.in_unit = demo_rig.unit;
  d.out_unit = trial.out_unit();
  d.side_name = demo_rig.side;
  d.side_unit = demo_rig.side_unit;
  set_times(d, trial, stimulus, nature);
  d.without = trial.without(d.t);
  d.with = trial.with(d.t);
  d.span = span_of(trial.plain());
  for (const double t : d.t) {
    d.in.push_back(stimulus.in.value(t, t));
    if (!demo_rig.side.empty()) d.side.push_back(stimulus.side.value(t, t));
  }
  if (d.log_time)
    for (double& t : d.t) t -= stimulus.step_at;
  return d;
}

}  // namespace

std::vector<double> Demonstration::difference() const { return minus(with, without); }

double Demonstration::share() const { return span > 0 ? largest(difference()) / span : 0; }

Demonstration demonstrate(const Effect& effect, const Effects& library, const Registry& registry) {
  const Nature nature = nature_of(effect, registry);
  std::string why = "no signal brings it out";
  for (const auto& demo_rig : demo_rigs(effect, library, registry))
    for (const double length : {100.0, 10.0, 1000.0})  // [s]
      for (const Waveform waveform : waveforms_for(nature)) {
        const Stimulus signal = stimulus(waveform, demo_rig, length);
        try {
          DemoRun trial(effect, demo_rig, signal, registry);
          if (auto unseen = effect.unseen(trial.excitation()); !unseen.empty())
            why = unseen;
          else if (trial.find_values())
            return show(effect, demo_rig, signal, trial, nature);
        } catch (const Error& error) {  // a bench in a unit that its law does not take
          why = error.problems.empty() ? error.what() : error.problems.front().what;
        }
      }
  fail("not_shown", effect.id, fmt::format("no standard signal shows {}: {}", effect.id, why),
       "add it to a diagram of yours and simulate that");
}

}  // namespace hysteron
