// The loop of ENGINE 5. At every accepted point, in this order:
//   1. outputs are taken on [t_old, t_new) from the step's own interpolation, with the memory as it was during the
//   step;
//   2. the memory is accepted, still with the formulas of the piece that ends here;
//   3. what is due at the instant happens (events.h): corners of the sources, sampled blocks, changes of mode;
//   directions of memory turn where rates did;
//   4. the integrator starts again only if states were changed, dx/dt jumped by more than the tolerance sees, or an
//   event was located.
// An instant at an event is therefore taken after it: outputs are continuous from the right.
#include "engine/simulate/simulate.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "engine/events/events.h"
#include "engine/events/rest.h"
#include "engine/events/reversals.h"
#include "engine/integrators/integrator.h"
#include "engine/program/corners.h"
#include "engine/program/loop_plan.h"
#include "engine/program/loops.h"
#include "engine/program/needed.h"
#include "engine/program/nominal.h"
#include "engine/simulate/choose_method.h"
#include "engine/simulate/fixed_step.h"
#include "engine/simulate/folded.h"
#include "engine/simulate/jacobian.h"
#include "engine/simulate/simulate_parts.h"
#include "engine/simulate/twins.h"

namespace hysteron {
namespace {

// A jump of dx/dt that moves the states by more than this share of the tolerance in one step restarts the integrator;
// its error control deals with smaller ones.
constexpr double noticed_jump = 0.1;
// So many steps on end that together advance less than this share of the span: it would never come to an end.
constexpr long crawl_steps = 200'000;
constexpr double crawl_share = 1e-4;
constexpr double runaway = 1e8;  // times its nominal size: a state so large explains a failing solver

// The integrators hold the error of each step, and errors of many steps add up. Measured by benchmarks/accuracy.cpp on
// four memory models: up to 17 times the tolerance with half of it, up to 7 times with a quarter, the largest of the
// shares tried that stayed within ten (docs/performance.md; no bound). Doubles carry no more than the last of these.
constexpr double share_of_tolerance = 0.25;
constexpr double tightest_tolerance = 1e-13;

/// The options as the integrators get them; the absolute tolerance is a multiple of the relative one.
SimulateOptions held_tolerance(SimulateOptions options) {
  const double asked = options.relative_tolerance;
  options.relative_tolerance = std::max(share_of_tolerance * asked, std::min(asked, tightest_tolerance));
  return options;
}

Formula formula_of(Method method) {
  return method == Method::adams ? Formula::adams : method == Method::runge_kutta ? Formula::runge_kutta : Formula::bdf;
}

class Simulation {
 public:
  Simulation(const Program& program, Run run, const SimulateOptions& options, std::vector<double> instants,
             std::vector<int> signals);
  Traces operator()();

 private:
  std::unique_ptr<Integrator> make_solver();
  int reversals() const { return options_.reversal_events ? reversals_.count() : 0; }
  bool derivative(double t, const double* x, double* dx);
  void indicate(double t, const double* x, double* g);
  void record(double t, const double* x, bool inside = false);
  void record_inside(double from, double to);
  void make_twins();
  void restart() { solver_->start(t_, x_, s_); }
  void record_slopes(double t, const double* x, std::span<const double> s);
  void take_step(double stop);
  void pass_instant();
  void pass_root();
  void check_guards();
  void follow_directions();
  void record_due();
  void walk();
  void commit();
  void check_pace();
  [[noreturn]] void explain(const Error& error);

  const Program& program_;
  Run run_;
  const SimulateOptions& options_;
  Work work_;
  FoldedDerivative derivative_;
  std::vector<Step> recording_;
  NominalSizes sizes_;
  std::vector<double> tolerance_;  // absolute, per state
  Events events_;
  Reversals reversals_;
  std::unique_ptr<Jacobian> jacobian_;  // before the solver, which calls it
  std::unique_ptr<Twins> twins_;        // as well; null if no slopes are asked for
  std::vector<double> s_, s_inside_;    // dx/dp by columns
  std::vector<std::vector<double>> slopes_now_;
  std::unique_ptr<Integrator> solver_;
  Traces traces_;
  std::vector<double> x_, before_, after_, interpolated_;  // x_ has one dummy state where the program has none
  std::size_t next_instant_ = 0;
  double t_ = 0, until_ = 0, milestone_ = 0;
  long steps_since_milestone_ = 0;
  bool not_finite_ = false;  // the last derivative was not; then these are where
  double bad_t_ = 0;
  std::vector<double> bad_x_;
};

Simulation::Simulation(const Program& program, Run run, const SimulateOptions& options, std::vector<double> instants,
                       std::vector<int> signals)
    : program_(program),
      run_(std::move(run)),
      options_(options),
      work_(program),
      derivative_(program, run_, work_),
      recording_(steps_for(program, signals)),
      sizes_(nominal_sizes(program, run_)),
      tolerance_(absolute_tolerances(sizes_, options)),
      events_(program, run_, options.begin, std::max(options.begin, instants.back()), options.relative_tolerance,
              tolerance_),
      reversals_(program, sizes_, options.relative_tolerance),
      t_(options.begin),
      until_(std::max(options.begin, instants.back())),
      milestone_(t_) {
  run_.t = t_;
  run_.branch = events_.branch();
  x_ = run_.x;
  if (x_.empty()) x_.push_back(0.0);
  before_ = after_ = interpolated_ = bad_x_ = x_;
  traces_.t = std::move(instants);
  traces_.values.assign(signals.size(), std::vector<double>(traces_.t.size()));
  traces_.signals = std::move(signals);
  if (!options.slopes_for.empty()) make_twins();
  solver_ = make_solver();
}

void Simulation::make_twins() {
  twins_ = std::make_unique<Twins>(program_, run_, options_.slopes_for);
  s_ = twins_->start(run_, [&](Run& run) {
    if (options_.at_rest) settle_at_rest(program_, run, options_.begin);
  });
  if (s_.empty()) s_.assign(static_cast<std::size_t>(twins_->count()), 0.0);  // of the dummy state
  s_inside_ = s_;
  traces_.slopes.assign(
      static_cast<std::size_t>(twins_->count()),
      std::vector<std::vector<double>>(traces_.signals.size(), std::vector<double>(traces_.t.size())));
  events_.on_change = [this](std::span<const ModeChange> changes) {
    const double step = 1e-3 * (solver_->t() - solver_->previous_t());
    const double least = 1e-10 * (until_ - options_.begin);
    twins_->change_modes(events_, run_, t_, x_, s_, changes, std::max(step, least));
  };
}

std::unique_ptr<Integrator> Simulation::make_solver() {
  OdeSystem system;
  system.states = static_cast<int>(x_.size());
  system.roots = reversals() + events_.guards();
  system.derivative = [this](double t, const double* x, double* dx) { return derivative(t, x, dx); };
  system.indicators = [this](double t, const double* x, double* g) { indicate(t, x, g); };
  system.state_name = [this](int i) {
    return program_.n_x == 0 ? std::string("(no state)") : program_.state_names[static_cast<std::size_t>(i)];
  };
  if (program_.n_x > 0 && formula_of(options_.method) == Formula::bdf && options_.exact_jacobian) {
    jacobian_ = std::make_unique<Jacobian>(program_);
    system.pattern = jacobian_->pattern();
    system.jacobian = [this](double t, const double* x, double* entries) { return (*jacobian_)(run_, t, x, entries); };
  }
  if (twins_ != nullptr) {
    system.parameters = twins_->count();
    system.parameter_sizes = twins_->parameter_sizes();
    system.sensitivity_derivative = [this](double t, const double* x, const double* const* s, double* const* ds) {
      return twins_->derivative(run_, t, x, s, ds);
    };
  }
  IntegratorOptions options;
  options.formula = formula_of(options_.method);
  options.relative_tolerance = options_.relative_tolerance;
  const double span = until_ - t_;
  const double longest = options_.max_step > 0 ? options_.max_step : longest_step(program_, run_, span);
  options.max_step = std::isfinite(longest) ? longest : 0.0;
  return std::make_unique<Integrator>(std::move(system), options, tolerance_);
}

bool Simulation::derivative(double t, const double* x, double* dx) {
  if (program_.n_x == 0) {
    dx[0] = 0;
    return true;
  }
  derivative_(run_, t, x);
  double sum = 0;  // of zeros: not zero if one of them is not finite
  for (std::size_t i = 0; i < work_.dx.size(); ++i) {
    dx[i] = work_.dx[i];
    sum += dx[i] * 0;
  }
  not_finite_ = !(sum == 0);
  if (not_finite_) {
    bad_t_ = t;
    std::copy(x, x + program_.n_x, bad_x_.begin());
  }
  return !not_finite_;
}

void Simulation::indicate(double t, const double* x, double* g) {
  evaluate_derivatives(program_, run_, work_, t, x);
  evaluate_memory_rates(program_, run_, work_, t, x);
  if (reversals() > 0) reversals_.indicate(run_, work_, g);
  if (events_.guards() == 0) return;
  evaluate_guards(program_, run_, work_, t, x);
  std::copy(work_.guard.begin(), work_.guard.end(), g + reversals());
}

void Simulation::record(double t, const double* x, bool inside) {
  evaluate_steps(program_, run_, work_, t, x, recording_);
  for (std::size_t s = 0; s < traces_.signals.size(); ++s) {
    const double value = work_.y[static_cast<std::size_t>(traces_.signals[s])];
    if (!std::isfinite(value)) not_finite(program_, run_, work_, t, x);
    traces_.values[s][next_instant_] = value;
  }
  if (twins_ != nullptr) record_slopes(t, x, inside ? s_inside_ : s_);
  ++next_instant_;
}

void Simulation::record_slopes(double t, const double* x, std::span<const double> s) {
  twins_->outputs(run_, t, {x, static_cast<std::size_t>(program_.n_x)}, s, traces_.signals, slopes_now_);
  for (std::size_t k = 0; k < slopes_now_.size(); ++k)
    for (std::size_t i = 0; i < slopes_now_[k].size(); ++i) traces_.slopes[k][i][next_instant_] = slopes_now_[k][i];
}

void Simulation::record_inside(double from, double to) {
  const auto& instants = traces_.t;
  if (next_instant_ == instants.size() || instants[next_instant_] >= to - same_instant(to)) return;
  const Stopwatch watch(traces_.statistics.phases.output);
  for (; next_instant_ < instants.size() && instants[next_instant_] < to - same_instant(to);) {
    solver_->interpolate(std::max(instants[next_instant_], from), interpolated_);
    if (twins_ != nullptr) solver_->interpolate_sensitivities(std::max(instants[next_instant_], from), s_inside_);
    record(instants[next_instant_], interpolated_.data(), true);
  }
}

/// Outputs at the present time.
void Simulation::record_due() {
  const auto due = [this] {
    return next_instant_ < traces_.t.size() && traces_.t[next_instant_] <= t_ + same_instant(t_);
  };
  if (!due()) return;
  const Stopwatch watch(traces_.statistics.phases.output);
  while (due()) record(t_, x_.data());
}

void Simulation::commit() {
  if (program_.remembers() && twins_ != nullptr)
    twins_->accept(run_, t_, {x_.data(), static_cast<std::size_t>(program_.n_x)}, s_);
  if (program_.remembers()) accept(program_, run_, work_, t_, x_.data());
  run_.t = t_;
}

/// Inputs that begin to move get a direction.
void Simulation::follow_directions() {
  evaluate_derivatives(program_, run_, work_, t_, x_.data());
  evaluate_memory_rates(program_, run_, work_, t_, x_.data());
  traces_.statistics.reversals += reversals_.follow(run_, work_);
}

/// A known instant: corners, samples. What is due there happens; the integrator starts again if it must.
void Simulation::pass_instant() {
  const bool states = program_.n_x > 0;
  if (states) derivative(t_, x_.data(), before_.data());
  events_.take(t_, run_);
  if (twins_ != nullptr) twins_->cross(events_, run_, t_, {x_.data(), static_cast<std::size_t>(program_.n_x)}, s_);
  const bool moved = events_.pass(run_, work_, t_, x_);
  commit();
  if (reversals_.count() > 0) follow_directions();
  if (!states || solver_->counters().steps == 0) return;
  if (!moved && twins_ == nullptr) {
    derivative(t_, x_.data(), after_.data());
    const double step = solver_->next_step();
    for (std::size_t i = 0; i < after_.size(); ++i) after_[i] = (after_[i] - before_[i]) * step;
    if (solver_->weighted_norm(after_) <= noticed_jump) return;
  }
  restart();
}

/// The integrator has located reversals or falling guards.
void Simulation::pass_root() {
  std::vector<int> turned, fell;
  for (int i = 0; i < reversals(); ++i)
    if (solver_->fired(i)) turned.push_back(i);
  for (int i = 0; i < events_.guards(); ++i)
    if (solver_->fired(reversals() + i)) fell.push_back(i);
  commit();
  for (const int i : turned) reversals_.turn(run_, i);
  traces_.statistics.reversals += static_cast<long>(turned.size());
  if (events_.settle(run_, work_, t_, x_, fell)) {
    commit();
    if (reversals_.count() > 0) follow_directions();
  }
  restart();
}

/// A guard may have fallen and risen within rounding of a step's end, unseen by the integrator.
void Simulation::check_guards() {
  if (events_.guards() == 0 || !events_.due(run_, work_, t_, x_)) return;
  if (!events_.settle(run_, work_, t_, x_, {})) return;
  commit();
  if (reversals_.count() > 0) follow_directions();
  restart();
}

void Simulation::check_pace() {
  if (++steps_since_milestone_ < crawl_steps) return;
  if (t_ - milestone_ < crawl_share * (until_ - options_.begin))
    fail_numerics("step_too_small", "simulate/solver",
                  fmt::format("the last {} steps advanced from t = {:.12g} s by {:.3g} s only; now at {}",
                              steps_since_milestone_, milestone_, t_ - milestone_, solver_->where()),
                  "something jumps to and fro: check the loop through the states named, or ask for less accuracy");
  milestone_ = t_;
  steps_since_milestone_ = 0;
}

void Simulation::take_step(double stop) {
  check_pace();
  const auto outcome = solver_->step(stop);
  const double from = t_;
  record_inside(from, solver_->t());
  t_ = solver_->t();
  std::copy(solver_->x().begin(), solver_->x().end(), x_.begin());
  if (twins_ != nullptr) std::copy(solver_->sensitivities().begin(), solver_->sensitivities().end(), s_.begin());
  if (outcome == Integrator::Outcome::root) {
    const Stopwatch watch(traces_.statistics.phases.events);
    return pass_root();
  }
  commit();
  if (reversals_.open(run_)) follow_directions();
  check_guards();
}

void Simulation::walk() {
  {
    const Stopwatch watch(traces_.statistics.phases.events);
    events_.take(t_, run_);
    events_.starting(true);
    if (twins_ != nullptr) twins_->cross(events_, run_, t_, {x_.data(), static_cast<std::size_t>(program_.n_x)}, s_);
    events_.starting(false);
    events_.begin(run_, work_, t_, x_);
    commit();
    if (reversals_.count() > 0) follow_directions();
    restart();
  }
  for (;;) {
    while (events_.next() <= t_ + same_instant(t_)) {
      const Stopwatch watch(traces_.statistics.phases.events);
      pass_instant();
    }
    record_due();
    if (next_instant_ == traces_.t.size()) return;
    take_step(std::min(events_.next(), until_));
  }
}

Traces Simulation::operator()() {
  auto& phases = traces_.statistics.phases;
  try {
    const Stopwatch all(phases.integrate);
    walk();
  } catch (const Error& error) {
    explain(error);
  }
  phases.integrate -= phases.events + phases.output;
  const auto counters = solver_->counters();
  auto& s = traces_.statistics;
  s.method = method_name(options_.method);
  s.steps = counters.steps;
  s.rejected = counters.rejected;
  s.evaluations = counters.evaluations;
  s.jacobians = counters.jacobians;
  s.restarts = counters.restarts;
  tell_counts(program_, events_, work_, s);
  if (program_.n_x > 0) run_.x = x_;
  traces_.end = std::move(run_);
  return std::move(traces_);
}

/// A solver that failed says what it tried; the reader wants to know which block made it fail.
void Simulation::explain(const Error& error) {
  const auto& code = error.problems.front().code;
  if (code != "solver_failed" && code != "step_too_small") throw error;
  if (not_finite_) not_finite(program_, run_, work_, bad_t_, bad_x_.data());
  if (std::abs(bad_t_ - t_) <= crawl_share * (until_ - options_.begin)) {
    // Steps crept up to where a loop has no solution: the last evaluation was still this side of it.
    evaluate_derivatives(program_, run_, work_, bad_t_, bad_x_.data());
    throw_if_unsolved(program_, work_, bad_t_);
  }
  std::size_t worst = 0;
  double largest = 0;
  for (std::size_t i = 0; i < sizes_.states.size(); ++i) {
    const double size = std::abs(x_[i]) / sizes_.states[i];
    if (size > largest) largest = size, worst = i;
  }
  if (!(largest > runaway)) throw error;
  const auto& name = program_.state_names[worst];
  const auto block = std::find_if(program_.blocks.begin(), program_.blocks.end(), [&](const BlockInstance& b) {
    return static_cast<int>(worst) >= b.x_begin && static_cast<int>(worst) < b.x_begin + b.sizes.states;
  });
  fail_numerics(
      "diverged", block->path,
      fmt::format("the simulation runs away at t = {:.9g} s: {} = {:.6g} [SI], {:.1g} times its usual size\n  {}", t_,
                  name, x_[worst], largest, error.problems.front().what),
      fmt::format("check gain and sign of the loop through \"{}\"", block->path));
}

}  // namespace

std::vector<double> absolute_tolerances(const NominalSizes& sizes, const SimulateOptions& options) {
  std::vector<double> absolute(std::max<std::size_t>(1, sizes.states.size()), 1.0);
  for (std::size_t i = 0; i < sizes.states.size(); ++i)
    absolute[i] = options.absolute_tolerance * options.relative_tolerance * sizes.states[i];
  return absolute;
}

void tell_counts(const Program& program, const Events& events, const Work& work, Statistics& s) {
  s.samples = events.hits();
  s.paths = events.paths();
  for (std::size_t i = 0; i < program.modal_blocks.size(); ++i)
    s.mode_changes.emplace_back(program.blocks[static_cast<std::size_t>(program.modal_blocks[i])].path,
                                events.changes()[i]);
  for (std::size_t i = 0; i < program.loops.size(); ++i) {
    const LoopCounters& c = work.loops->counters[i];
    s.loops.push_back({to_text(program, program.loops[i].path), c.solved, c.failed, c.evaluations, c.bracketed,
                       c.most_evaluations, c.worst_residual});
  }
}

void not_finite(const Program& program, const Run& run, Work& work, double t, const double* x) {
  evaluate_derivatives(program, run, work, t, x);
  throw_if_unsolved(program, work, t);
  evaluate_values(program, run, work, t, x);
  throw_if_unsolved(program, work, t);
  const auto bad = [](const std::vector<double>& v, int begin, int count) {
    for (int i = begin; i < begin + count; ++i)
      if (!std::isfinite(v[static_cast<std::size_t>(i)])) return i;
    return -1;
  };
  const auto tell = [&](const BlockInstance& block, const std::string& of, double value) {
    std::vector<std::string> near;
    const auto name_state = [&](int i) {
      near.push_back(fmt::format("state {} = {:.6g}", program.state_names[static_cast<std::size_t>(i)], x[i]));
    };
    for (const int s : block.source)
      near.push_back(fmt::format("{} = {:.6g}", program.signals[static_cast<std::size_t>(s)].path,
                                 work.y[static_cast<std::size_t>(s)]));
    for (int i = block.x_begin; i < block.x_begin + block.sizes.states; ++i) name_state(i);
    if (block.sizes.states == 0 && program.n_x > 0) {
      const auto* largest =
          std::max_element(x, x + program.n_x, [](double a, double b) { return std::abs(a) < std::abs(b); });
      name_state(static_cast<int>(largest - x));
    }
    fail_numerics(
        "diverged", block.path,
        fmt::format("{} is {} at t = {:.9g} s (of block type {}); there [SI]: {}", of, value, t,
                    block.kernel->declaration.type, fmt::join(near, ", ")),
        fmt::format("the simulation runs away or leaves the range of \"{}\": check its parameters, and gain and sign "
                    "of the loop around it",
                    block.path));
  };
  for (const int b : program.value_order) {
    const auto& block = program.blocks[static_cast<std::size_t>(b)];
    if (const int s = bad(work.y, block.y_begin, block.sizes.outputs); s >= 0)
      tell(block, program.signals[static_cast<std::size_t>(s)].path, work.y[static_cast<std::size_t>(s)]);
  }
  for (const auto& block : program.blocks)
    if (const int i = bad(work.dx, block.x_begin, block.sizes.states); i >= 0)
      tell(block, "the derivative of " + program.state_names[static_cast<std::size_t>(i)],
           work.dx[static_cast<std::size_t>(i)]);
  fail_numerics("diverged", "simulate", fmt::format("a value is not finite near t = {:.9g} s", t),
                "check the parameters, and gain and sign of the loops");
}

Traces simulate(const Program& program, Run run, const SimulateOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  auto instants = output_instants(options);
  check_inputs(program, run);
  const auto held = held_tolerance(options);
  set_loop_accuracy(program, run, held.relative_tolerance, held.absolute_tolerance);
  const auto& signals = options.signals.empty() ? program.record_signals : options.signals;
  run.t = options.begin;
  std::optional<Traces> exact;
  if (!options.slopes_for.empty() && has_fixed_steps(options.method))
    fail("bad_value", "/simulate/solver/method", "slopes do not come with fixed steps",
         "choose auto, exact, bdf, adams or runge_kutta");
  if (advances_exactly(program, options)) {
    Phases phases;
    {
      const Stopwatch watch(phases.integrate);
      exact = simulate_exactly(program, run, options, instants, signals);
    }
    if (exact) exact->statistics.phases = phases;
  }
  Traces traces;
  if (exact) {
    traces = std::move(*exact);
  } else {
    if (options.at_rest) settle_at_rest(program, run, options.begin);
    if (has_fixed_steps(options.method)) {
      traces = simulate_in_fixed_steps(program, std::move(run), options, std::move(instants), signals);
    } else {
      auto how = held_tolerance(options);
      MethodChoice choice{options.method, ""};
      if (options.method == Method::automatic)
        choice = choose_method(program, run, options.begin, instants.back() - options.begin);
      how.method = choice.method;
      traces = Simulation(program, std::move(run), how, std::move(instants), signals)();
      traces.statistics.why = choice.why;
    }
  }
  traces.statistics.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return traces;
}

}  // namespace hysteron
