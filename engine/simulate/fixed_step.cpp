#include "engine/simulate/fixed_step.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

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

constexpr long most_foretold_steps = 32;
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
        t_(options.begin),
        remembers_(program.remembers()),
        watches_(crossings_.watches()),
        has_histories_(histories_.any()),
        has_guards_(events_.guards() > 0) {
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
    phases.integrate = std::max(0.0, phases.integrate - (phases.events + phases.output));
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
      next_event_ = events_.next();
    }
    for (long grid = 1;;) {
      look_up_();
      how_far_(t_);
      while (next_event_ <= t_ + same_instant(t_)) {
        const Stopwatch watch(traces_.statistics.phases.events);
        events_.take(t_, run_);
        events_.pass(run_, work_, t_, x_);
        commit();
        next_event_ = events_.next();
        crossings_.forget();
      }
      record_until(t_);
      if (next_ == traces_.t.size()) return;
      const auto grid_time = [&] { return options_.begin + static_cast<double>(grid) * options_.step; };
      double stop = grid_time();
      for (const double now = t_ + same_instant(t_); stop <= now; stop = grid_time()) ++grid;
      foretell(grid);
      step(std::min(stop, next_event_));
    }
  }
  /// Tells the kernel the instants of the steps before us, up to the next event, if the last ones that it was told have
  /// come: twice as many as then, so that little is asked in vain where steps are cut short.
  void foretell(long grid) {
    if (t_ < foretold_until_ || !derivative_.has_sources()) return;
    foretold_steps_ = t_ == foretold_until_ ? std::min(2 * foretold_steps_, most_foretold_steps) : 1;
    ahead_.clear();
    double from = t_;
    for (long k = grid; k < grid + foretold_steps_ && from < traces_.t.back(); ++k) {
      const double to = options_.begin + static_cast<double>(k) * options_.step;
      if (to > next_event_) break;
      if (ahead_.empty()) ahead_.push_back(from);
      if (options_.method == Method::rk4) ahead_.push_back(from + (to - from) / 2);
      ahead_.push_back(to);
      from = to;
    }
    foretold_until_ = from;
    if (!ahead_.empty()) derivative_.foretell(run_, ahead_);
  }
  /// The slope at (t, x) into k.
  void derivative(double t, const std::vector<double>& x, std::vector<double>& k) {
    std::copy(x.begin(), x.end(), derivative_.states());
    slope(t);
    std::copy(work_.dx.begin(), work_.dx.end(), k.begin());
  }
  /// The slope at t where the states of the kernel are, into work_.dx.
  void slope(double t) {
    ++traces_.statistics.evaluations;
    derivative_(run_, t);
    if (work_.unsolved >= 0) throw_if_unsolved(program_, work_, t);
  }
  /// A stage of Runge-Kutta's formula: the slope into k, and the states of the kernel to where the next stage wants
  /// them, `ahead` [s] along it.
  void stage(double t, std::vector<double>& k, double ahead) {
    slope(t);
    const double *dx = work_.dx.data(), *before = before_.data();
    double *slopes = k.data(), *x = derivative_.states();
    for (std::size_t i = 0, n = x_.size(); i != n; ++i) {
      const double slope = dx[i];
      slopes[i] = slope;
      x[i] = before[i] + ahead * slope;
    }
  }

  void step(double end) {
    const double from = t_;
    before_.swap(x_);
    move_states(end);
    std::vector<int> fell;
    if (watches_) {
      end_slope_known_ = false;
      const auto crossing = crossings_.first(run_, work_, {from, end, states_inside_, false}, {});
      if (crossing) {  // the step ends where the first mode changes
        fell = crossing->guards;
        x_ = before_;
        move_states(end = crossing->t);
      }
    }
    ++traces_.statistics.steps;
    if (has_histories_) {
      end_slope_known_ = false;
      histories_.fill(run_, work_, from, end, states_inside_);
    }
    if (next_ < traces_.t.size() && traces_.t[next_] < end - same_instant(end)) record_between(from, end);
    t_ = end;
    if (!(zeros_ == 0)) explain(t_, x_);
    growth_.see(t_, x_);
    commit();
    if (!has_guards_ || (fell.empty() && !events_.due(run_, work_, t_, x_))) return;
    const bool changed = events_.settle(run_, work_, t_, x_, fell);
    next_event_ = events_.next();  // what jumped may have an echo
    if (!changed) return;
    commit();
    crossings_.forget();
  }

  /// From t_ to the end; `before_` keeps where they began.
  void move_states(double end) {
    const double h = end - t_;
    step_begin_ = t_;
    step_end_ = end;
    in_step_ = true;
    const std::size_t n = x_.size();
    if (n == 0) return;
    const double *before = before_.data(), *dx = work_.dx.data();
    double *x = x_.data(), *states = derivative_.states();
    for (std::size_t i = 0; i < n; ++i) states[i] = before[i];
    zeros_ = 0;
    if (options_.method == Method::euler) {
      stage(t_, k1_, h);
      for (std::size_t i = 0; i < n; ++i) zeros_ += 0 * (x[i] = states[i]);
      return;
    }
    stage(t_, k1_, h / 2);
    stage(t_ + h / 2, k2_, h / 2);
    stage(t_ + h / 2, k3_, h);
    slope(end);
    const double *k1 = k1_.data(), *k2 = k2_.data(), *k3 = k3_.data();
    const double sixth = h / 6;
    double zeros = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double reached = before[i] + sixth * (k1[i] + 2 * (k2[i] + k3[i]) + dx[i]);
      x[i] = reached;
      zeros += reached * 0;
    }
    zeros_ = zeros;
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
    // A clock costs as much as a record: of many one in sixteen is timed.
    constexpr std::size_t timed_all = 64, timed_one_in = 16;
    const bool all = next_ < timed_all;
    if (!all && next_ % timed_one_in != 0) return record_all(t);
    double seconds = 0;
    {
      const Stopwatch watch(seconds);
      record_all(t);
    }
    traces_.statistics.phases.output += (all ? 1 : timed_one_in) * seconds;
  }
  void record_all(double t) {
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
    if (in_step_) look_for_bad_slope();
    not_finite(program_, run_, work_, t, x.data());
  }
  /// Throws for the first slope of the last step that is not finite. States behind it are not either, so it is enough
  /// to look for it then: once more along the step.
  void look_for_bad_slope() {
    if (x_.empty()) return;
    std::vector<double> k(x_.size()), x = before_;
    const auto look = [&](double t) {
      derivative(t, x, k);
      if (std::any_of(k.begin(), k.end(), [](double slope) { return !std::isfinite(slope); }))
        not_finite(program_, run_, work_, t, x.data());
    };
    const auto go = [&](double ahead) {
      for (std::size_t i = 0; i < x.size(); ++i) x[i] = before_[i] + ahead * k[i];
    };
    const double h = step_end_ - step_begin_, middle = step_begin_ + h / 2;
    look(step_begin_);
    if (options_.method == Method::rk4) {
      go(h / 2);
      look(middle);
      go(h / 2);
      look(middle);
      go(h);
      look(step_end_);
    }
    x = x_;
    look(step_end_);
  }
  void commit() {
    if (remembers_) accept(program_, run_, work_, t_, x_.data());
    run_.t = t_;
    in_step_ = false;
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
  std::vector<double> ahead_;                                         // instants that the kernel was told
  double foretold_until_ = -std::numeric_limits<double>::infinity();  // [s]
  long foretold_steps_ = 1;
  double t_ = 0, step_begin_ = 0, step_end_ = 0;
  bool remembers_, watches_, has_histories_, has_guards_;  // what steps have to look at besides
  double next_event_ = 0;                                  // events_.next() [s]
  double zeros_ = 0;              // each state at the end of the last step times zero: not zero if one is not finite
  bool in_step_ = false;          // its end is not accepted yet
  bool end_slope_known_ = false;  // k4_ is the slope at the end of the last step
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
