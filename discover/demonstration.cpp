// Decides how an effect is shown to a person without any data. See demonstration.h.
#include "discover/demonstration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "discover/add.h"
#include "discover/bench.h"
#include "discover/circumstances.h"
#include "engine/error.h"
#include "engine/simulate.h"

namespace hysteron {
namespace {

/// A difference of one per cent is the least that can be seen in a picture.
constexpr double visible = 0.01;
constexpr int points_over_time = 800, points_of_loop = 2000;

double span_of(const std::vector<double>& v) {
  const auto [low, high] = std::minmax_element(v.begin(), v.end());
  return v.empty() ? 0 : *high - *low;
}

std::vector<double> minus(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> d(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) d[i] = a[i] - b[i];
  return d;
}

double largest(const std::vector<double>& v) {
  double most = 0;
  for (const double x : v) most = std::max(most, std::abs(x));
  return most;
}

std::vector<double> between(double from, double to, int points) {
  std::vector<double> t;
  for (int k = 0; k < points; ++k) t.push_back(from + (to - from) * k / (points - 1));
  return t;
}

/// One effect on one bench under one signal.
class Trial {
 public:
  Trial(const Effect& effect, const Bench& bench, const Stimulus& stimulus, const Registry& registry)
      : bench_(bench), stimulus_(stimulus) {
    at_ = circumstances_at(bench.diagram, registry, recorded(stimulus, bench), bench.place);
    law_ = effect.laws(at_).front();
    Added added = add_effect(bench.diagram, registry, effect, law_, bench.place);
    paths_ = added.free;
    on_ = compile(added.diagram, registry);
    added.diagram.blocks.find(added.name)->choose = "off";
    off_ = compile(added.diagram, registry);
    rows_ = between(0, stimulus.length, static_cast<int>(std::lround(stimulus.length / stimulus.row)) + 1);
    plain_ = without(rows_);
    for (const auto& p : law_.free) values_.push_back(p.start);
  }

  const Circumstances& circumstances() const { return at_; }
  const Law& law() const { return law_; }
  const std::vector<double>& values() const { return values_; }
  const std::vector<double>& rows() const { return rows_; }
  const std::vector<double>& plain() const { return plain_; }
  std::vector<double> with(const std::vector<double>& t) const { return response(*on_, t, values_); }
  std::vector<double> without(const std::vector<double>& t) const { return response(*off_, t, {}); }
  Unit out_unit() const { return off_->signals[static_cast<std::size_t>(off_->output_signals.front())].unit; }

  /// Sets values at which the effect can be seen: those at which it starts, else others of its scan, else an amplitude
  /// of a tenth of the signal. False if it shows at none of them.
  bool find_values() {
    if (shows(values_)) return true;
    for (const double part : {0.75, 0.5, 0.25, 1.0, 0.0}) {
      std::vector<double> values = values_;
      for (std::size_t i = 0; i < values.size(); ++i)
        if (const auto& scan = law_.free[i].scan; !scan.empty())
          values[i] = scan[static_cast<std::size_t>(std::lround(part * static_cast<double>(scan.size() - 1)))];
      if (shows(values)) return values_ = values, true;
    }
    return find_amplitudes();
  }

 private:
  std::vector<double> response(const Program& program, const std::vector<double>& t,
                               const std::vector<double>& values) const {
    Run run = start(program);
    for (std::size_t i = 0; i < values.size(); ++i)
      if (std::isfinite(values[i])) set_parameter(program, run, paths_[i], values[i]);
    prepare(program, run);
    reset(program, run);
    bind_input(program, run, "in", std::make_shared<const Series>(stimulus_.in));
    if (!bench_.side.empty()) bind_input(program, run, bench_.side, std::make_shared<const Series>(stimulus_.side));
    SimulateOptions options;
    options.until = t.back();
    options.instants = t;
    options.signals = {program.output_signals.front()};
    options.at_rest = true;  // as a recording begins where nothing else is said of it
    return simulate(program, run, options).values.front();
  }

  bool shows(const std::vector<double>& values) const {
    const double most = largest(minus(response(*on_, rows_, values), plain_));
    return std::isfinite(most) && most >= visible * span_of(plain_);
  }

  /// What starts at zero is an amplitude: such that it makes a tenth of the signal.
  bool find_amplitudes() {
    std::vector<double> values = values_;
    for (std::size_t i = 0; i < values.size(); ++i)
      if (values[i] == 0) values[i] = std::min(1.0, law_.free[i].upper);
    const double most = largest(minus(response(*on_, rows_, values), plain_));
    if (!std::isfinite(most) || !(most > 0)) return false;
    for (std::size_t i = 0; i < values.size(); ++i)
      if (values_[i] == 0) values[i] *= 0.1 * span_of(plain_) / most;
    if (!shows(values)) return false;
    values_ = values;
    return true;
  }

  const Bench& bench_;
  const Stimulus& stimulus_;
  Circumstances at_;
  Law law_;
  std::vector<std::string> paths_;
  ProgramPointer on_, off_;
  std::vector<double> rows_, plain_, values_;
};

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

std::string numbers_text(const Effect& effect, const Trial& trial) {
  std::vector<double> values = trial.values();
  if (std::any_of(values.begin(), values.end(), [](double v) { return !std::isfinite(v); })) return trial.law().name;
  if (effect.summary)
    if (std::string text = effect.summary(trial.law(), values, trial.circumstances()); !text.empty()) return text;
  std::string text;
  for (std::size_t i = 0; i < values.size(); ++i)
    text += fmt::format("{}{} {:.3g}", i > 0 ? ", " : "", trial.law().free[i].path, values[i]);
  return text;
}

void set_times(Demonstration& d, const Trial& trial, const Stimulus& stimulus, Nature nature) {
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

Demonstration show(const Effect& effect, const Bench& bench, const Stimulus& stimulus, const Trial& trial,
                   Nature nature) {
  Demonstration d;
  d.signal = stimulus.text;
  d.device = bench.device;
  d.law = trial.law().name;
  d.numbers = numbers_text(effect, trial);
  d.in_unit = bench.unit;
  d.out_unit = trial.out_unit();
  d.side_name = bench.side;
  d.side_unit = bench.side_unit;
  set_times(d, trial, stimulus, nature);
  d.without = trial.without(d.t);
  d.with = trial.with(d.t);
  d.span = span_of(trial.plain());
  for (const double t : d.t) {
    d.in.push_back(stimulus.in.value(t, t));
    if (!bench.side.empty()) d.side.push_back(stimulus.side.value(t, t));
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
  for (const auto& bench : benches(effect, library, registry))
    for (const double length : {100.0, 10.0, 1000.0})  // [s]
      for (const Waveform waveform : waveforms_for(nature)) {
        const Stimulus signal = stimulus(waveform, bench, length);
        try {
          Trial trial(effect, bench, signal, registry);
          if (auto unseen = effect.unseen(trial.circumstances()); !unseen.empty())
            why = unseen;
          else if (trial.find_values())
            return show(effect, bench, signal, trial, nature);
        } catch (const Error& error) {  // a bench in a unit that its law does not take
          why = error.problems.empty() ? error.what() : error.problems.front().what;
        }
      }
  fail("not_shown", effect.id, fmt::format("no standard signal shows {}: {}", effect.id, why),
       "add it to a diagram of yours and simulate that");
}

}  // namespace hysteron
