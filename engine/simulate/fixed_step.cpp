#include "engine/simulate/fixed_step.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/diagram/stop.h"
#include "engine/diagram/time_text.h"
#include "engine/events/events.h"
#include "engine/events/zero_crossings.h"
#include "engine/program/histories.h"
#include "engine/program/loops.h"
#include "engine/program/needed.h"
#include "engine/program/nominal.h"
#include "engine/simulate/choose_method.h"
#include "engine/simulate/divergence.h"
#include "engine/simulate/linear_row_kernel.h"
#include "engine/simulate/simulate_parts.h"
#include "engine/simulate/step_tolerances.h"

namespace hysteron {
namespace {

constexpr double most_steps = 1e10;  // an hour of a small diagram

class FixedSteps {
 public:
  FixedSteps(const Program& program, Run run, const SimulateOptions& options, std::vector<double> instants,
             std::vector<int> signals)
      : program_(program),
        run_(std::move(run)),
        options_(options),
        work_(program),
        derivative_(program, run_, work_),
        how_far_(options_, instants.back()),
        recording_(steps_for(program, signals)),
        growth_(nominal_states(program, run_), options.begin),
        tolerance_(absolute_tolerances(nominal_sizes(program, run_), options)),
        events_(program, run_, options.begin, instants.back(), options.relative_tolerance, tolerance_),
        crossings_(program, false),
        histories_(program, nominal_sizes(program, run_).signals, options.relative_tolerance),
        t_(options.begin) {
    run_.t = t_;
    run_.branch = events_.branch();
    x_ = run_.x;
    k1_ = k2_ = k3_ = k4_ = trial_ = before_ = x_;
    states_inside_ = [this](double t, std::vector<double>& x) { interpolate(t_, t, x); };
    traces_.t = std::move(instants);
    traces_.values.assign(signals.size(), std::vector<double>(traces_.t.size()));
    traces_.signals = std::move(signals);
  }

  Traces operator()() {
    {
      const Stopwatch all(traces_.statistics.phases.integrate);
      walk();
    }
    auto& phases = traces_.statistics.phases;
    phases.integrate -= phases.events + phases.output;
    tell();
    run_.x = x_;
    traces_.end = std::move(run_);
    return std::move(traces_);
  }

 private:
  void walk() {
    {
      const Stopwatch watch(traces_.statistics.phases.events);
      events_.take(t_, run_);
      events_.begin(run_, work_, t_, x_);
      commit();
    }
    for (long grid = 1;;) {
      look_up_();
      how_far_(t_);
      while (events_.next() <= t_ + same_instant(t_)) {
        const Stopwatch watch(traces_.statistics.phases.events);
        events_.take(t_, run_);
        events_.pass(run_, work_, t_, x_);
        commit();
        crossings_.forget();
      }
      record_until(t_);
      if (next_ == traces_.t.size()) return;
      double stop = options_.begin + static_cast<double>(grid) * options_.step;
      if (stop <= t_ + same_instant(t_)) {
        ++grid;
        continue;
      }
      step(std::min(stop, events_.next()));
    }
  }
  void derivative(double t, const std::vector<double>& x, std::vector<double>& k) {
    ++traces_.statistics.evaluations;
    derivative_(run_, t, x.data());
    if (work_.unsolved >= 0) throw_if_unsolved(program_, work_, t);
    double sum = 0;  // of zeros: not zero if one of them is not finite
    for (std::size_t i = 0; i < k.size(); ++i) {
      k[i] = work_.dx[i];
      sum += k[i] * 0;
    }
    if (!(sum == 0) && bad_x_.empty()) {
      bad_t_ = t;
      bad_x_ = x;
    }
  }
  void move(double h, const std::vector<double>& k) {
    for (std::size_t i = 0; i < x_.size(); ++i) trial_[i] = before_[i] + h * k[i];
  }

  void step(double end) {
    const double from = t_;
    before_ = x_;
    move_states(end);
    std::vector<int> fell;
    if (crossings_.watches()) {
      end_slope_known_ = false;
      const auto crossing = crossings_.first(run_, work_, {from, end, states_inside_, false}, {});
      if (crossing) {  // the step ends where the first mode changes
        fell = crossing->guards;
        x_ = before_;
        move_states(end = crossing->t);
      }
    }
    ++traces_.statistics.steps;
    if (histories_.any()) {
      end_slope_known_ = false;
      histories_.fill(run_, work_, from, end, states_inside_);
    }
    if (next_ < traces_.t.size() && traces_.t[next_] < end - same_instant(end)) record_between(from, end);
    t_ = end;
    for (const double x : x_)
      if (!std::isfinite(x)) explain(t_, x_);
    growth_.see(t_, x_);
    commit();
    if (events_.guards() == 0 || (fell.empty() && !events_.due(run_, work_, t_, x_))) return;
    if (!events_.settle(run_, work_, t_, x_, fell)) return;
    commit();
    crossings_.forget();
  }

  /// From t_ to the end; `before_` keeps where they began.
  void move_states(double end) {
    const double h = end - t_;
    step_end_ = end;
    bad_x_.clear();
    if (!x_.empty()) {
      derivative(t_, x_, k1_);
      if (options_.method == Method::euler) {
        move(h, k1_);
      } else {
        move(h / 2, k1_);
        derivative(t_ + h / 2, trial_, k2_);
        move(h / 2, k2_);
        derivative(t_ + h / 2, trial_, k3_);
        move(h, k3_);
        derivative(end, trial_, k4_);
        for (std::size_t i = 0; i < x_.size(); ++i)
          trial_[i] = before_[i] + h / 6 * (k1_[i] + 2 * (k2_[i] + k3_[i]) + k4_[i]);
      }
      x_.swap(trial_);
    }
  }

  /// Outputs inside the step that has just been taken, with the memory as it was before.
  void record_between(double from, double to) {
    const Stopwatch watch(traces_.statistics.phases.output);
    end_slope_known_ = false;
    for (; next_ < traces_.t.size() && traces_.t[next_] < to - same_instant(to);) {
      interpolate(from, traces_.t[next_], trial_);
      record(traces_.t[next_], trial_);
    }
  }
  /// The cubic through both ends of the step and their slopes.
  void interpolate(double from, double t, std::vector<double>& x) {
    if (x_.empty()) return;
    if (!end_slope_known_) derivative(step_end_, x_, k4_);
    end_slope_known_ = true;
    const double h = step_end_ - from, s = (t - from) / h;
    const double a = s * s * (3 - 2 * s), b = s * (1 - s) * (1 - s), c = -s * s * (1 - s);
    for (std::size_t i = 0; i < x_.size(); ++i)
      x[i] = before_[i] + a * (x_[i] - before_[i]) + h * (b * k1_[i] + c * k4_[i]);
  }
  void record_until(double t) {
    if (next_ == traces_.t.size() || traces_.t[next_] > t + same_instant(t)) return;
    const Stopwatch watch(traces_.statistics.phases.output);
    while (next_ < traces_.t.size() && traces_.t[next_] <= t + same_instant(t)) record(t, x_);
  }
  void record(double t, const std::vector<double>& x) {
    evaluate_steps(program_, run_, work_, t, x.data(), recording_);
    for (std::size_t s = 0; s < traces_.signals.size(); ++s) {
      const double value = work_.y[static_cast<std::size_t>(traces_.signals[s])];
      if (!std::isfinite(value)) explain(t, x);
      traces_.values[s][next_] = value;
    }
    ++next_;
  }
  /// Something is not finite at (t, x): the state that grew up to the step's begin explains it, else a block there.
  [[noreturn]] void explain(double t, const std::vector<double>& x) {
    throw_if_grown(program_, growth_.quantities(program_, before_), run_.t);
    if (!bad_x_.empty()) not_finite(program_, run_, work_, bad_t_, bad_x_.data());
    not_finite(program_, run_, work_, t, x.data());
  }
  void commit() {
    if (program_.remembers()) accept(program_, run_, work_, t_, x_.data());
    run_.t = t_;
  }
  void tell() {
    auto& s = traces_.statistics;
    s.method = options_.method == Method::euler ? "euler" : "rk4";
    tell_counts(program_, events_, work_, s);
  }

  const Program& program_;
  Run run_;
  const SimulateOptions& options_;
  Work work_;
  LinearRowKernel derivative_;
  LookUp look_up_;
  HowFar how_far_;
  std::vector<Step> recording_;
  GrowthWatch growth_;
  std::vector<double> tolerance_;  // for the paths of jumps only
  Events events_;
  ZeroCrossings crossings_;
  Histories histories_;
  std::function<void(double, std::vector<double>&)> states_inside_;  // of the last step
  Traces traces_;
  std::vector<double> x_, before_, trial_, k1_, k2_, k3_, k4_;
  std::size_t next_ = 0;
  double t_ = 0, step_end_ = 0;
  bool end_slope_known_ = false;  // k4_ is the slope at the end of the last step
  double bad_t_ = 0;
  std::vector<double> bad_x_;  // where a derivative was not finite first in the last step; empty: nowhere
};

/// How many of its fastest time constants a step may last before what decays grows instead: on the negative real axis.
/// Source: Hairer, Wanner, Solving Ordinary Differential Equations II (1996), section IV.2.
double stable_up_to(Method method) { return method == Method::euler ? 2 : 2.785; }

/// What the step and the diagram at the start say of stability; "" where nothing is known against it.
std::string why_unstable(const Program& program, const Run& run, const SimulateOptions& options) {
  const double rate = fastest_rate(program, run, options.begin);
  if (!(rate * options.step > stable_up_to(options.method))) return "";
  return fmt::format(
      "the step of {} lasts {:.3g} times the fastest time constant at the start ({}), and {} is stable up to {}: what "
      "should decay may grow. Take a step below {}, or the method \"auto\"",
      time_text(options.step), rate * options.step, time_text(1 / rate), method_name(options.method),
      stable_up_to(options.method), time_text(stable_up_to(options.method) / rate));
}

}  // namespace

void check_step(const SimulateOptions& options, double end) {
  const auto bad = [](const std::string& what, const std::string& cure) {
    fail("bad_value", "/simulate/solver/step", what, cure);
  };
  const double step = options.step, span = end - options.begin;
  if (!(step > 0) || !std::isfinite(step))
    bad("a method with fixed steps needs the step", "give one, such as \"step\": \"10 us\"");
  if (!(span > 0)) return;
  if (step > span)
    bad(fmt::format("a step of {:.6g} s is longer than the whole run ({:.6g} s)", step, span),
        "give a step well below the fastest time constant, such as \"step\": \"10 us\"");
  if (span / step > most_steps)
    bad(fmt::format("{:.3g} steps of {:.3g} s would be taken, at most {:.0e} can be waited for", span / step, step,
                    most_steps),
        "give a longer step, or the method \"auto\", which chooses its own");
  if (step < 4 * same_instant(std::max(std::abs(options.begin), std::abs(end))))
    bad(fmt::format("times a step of {:.3g} s apart cannot be told from each other near {:.6g} s", step, end),
        "give a longer step, or begin nearer to 0 s");
}

Traces simulate_in_fixed_steps(const Program& program, Run run, const SimulateOptions& options,
                               std::vector<double> instants, const std::vector<int>& signals) {
  check_step(options, instants.back());
  const std::string unstable = why_unstable(program, run, options);
  auto traces = FixedSteps(program, std::move(run), options, std::move(instants), signals)();
  if (!unstable.empty()) traces.statistics.warnings.push_back(unstable);
  return traces;
}

}  // namespace hysteron
