#include "engine/simulate/fixed_step.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/events/events.h"
#include "engine/program/loops.h"
#include "engine/program/needed.h"
#include "engine/program/nominal.h"
#include "engine/simulate/folded.h"
#include "engine/simulate/simulate_parts.h"

namespace hysteron {
namespace {

class FixedSteps {
 public:
  FixedSteps(const Program& program, Run run, const SimulateOptions& options, std::vector<double> instants,
             std::vector<int> signals)
      : program_(program),
        run_(std::move(run)),
        options_(options),
        work_(program),
        derivative_(program, run_, work_),
        recording_(steps_for(program, signals)),
        tolerance_(absolute_tolerances(nominal_sizes(program, run_), options)),
        events_(program, run_, options.begin, instants.back(), options.relative_tolerance, tolerance_),
        t_(options.begin) {
    run_.t = t_;
    run_.branch = events_.branch();
    x_ = run_.x;
    k1_ = k2_ = k3_ = k4_ = trial_ = before_ = x_;
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
      while (events_.next() <= t_ + same_instant(t_)) {
        const Stopwatch watch(traces_.statistics.phases.events);
        events_.take(t_, run_);
        events_.pass(run_, work_, t_, x_);
        commit();
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
    for (std::size_t i = 0; i < k.size(); ++i) k[i] = work_.dx[i];
  }
  void move(double h, const std::vector<double>& k) {
    for (std::size_t i = 0; i < x_.size(); ++i) trial_[i] = before_[i] + h * k[i];
  }

  void step(double end) {
    const double h = end - t_, from = t_;
    before_ = x_;
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
    ++traces_.statistics.steps;
    if (next_ < traces_.t.size() && traces_.t[next_] < end - same_instant(end)) record_between(from, end);
    t_ = end;
    for (const double x : x_)
      if (!std::isfinite(x)) not_finite(program_, run_, work_, t_, x_.data());
    commit();
    if (events_.guards() > 0 && events_.due(run_, work_, t_, x_) && events_.settle(run_, work_, t_, x_, {})) commit();
  }

  /// Outputs inside the step that has just been taken, with the memory as it was before.
  void record_between(double from, double to) {
    const Stopwatch watch(traces_.statistics.phases.output);
    if (!x_.empty()) derivative(to, x_, k4_);
    for (; next_ < traces_.t.size() && traces_.t[next_] < to - same_instant(to);) {
      const double h = to - from, s = (traces_.t[next_] - from) / h;
      const double a = s * s * (3 - 2 * s), b = s * (1 - s) * (1 - s), c = -s * s * (1 - s);
      for (std::size_t i = 0; i < x_.size(); ++i)
        trial_[i] = before_[i] + a * (x_[i] - before_[i]) + h * (b * k1_[i] + c * k4_[i]);
      record(traces_.t[next_], trial_);
    }
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
      if (!std::isfinite(value)) not_finite(program_, run_, work_, t, x.data());
      traces_.values[s][next_] = value;
    }
    ++next_;
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
  FoldedDerivative derivative_;
  std::vector<Step> recording_;
  std::vector<double> tolerance_;  // for the paths of jumps only
  Events events_;
  Traces traces_;
  std::vector<double> x_, before_, trial_, k1_, k2_, k3_, k4_;
  std::size_t next_ = 0;
  double t_ = 0;
};

}  // namespace

Traces simulate_in_fixed_steps(const Program& program, Run run, const SimulateOptions& options,
                               std::vector<double> instants, const std::vector<int>& signals) {
  if (!(options.step > 0) || !std::isfinite(options.step))
    fail("bad_value", "/simulate/solver/step", "a method with fixed steps needs the step",
         "give one, such as \"step\": \"10 us\"");
  return FixedSteps(program, std::move(run), options, std::move(instants), signals)();
}

}  // namespace hysteron
