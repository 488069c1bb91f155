// The loop in time. At every accepted point, in this order:
//   0. the step is cut where something inside of it switches that neither of its ends shows (zero_crossings.h);
//   1. outputs are taken on [t_old, t_new) from the step's own interpolation, with the memory as it was during the
//   step;
//   2. the memory is accepted, still with the formulas of the piece that ends here;
//   3. what is due at the instant happens (events.h): corners of the sources, sampled blocks, changes of mode;
//   directions of memory turn where rates did;
//   4. the integrator starts again only if states were changed, dx/dt jumped by more than the tolerance sees, or an
//   event was located.
// An instant at an event is therefore taken after it: outputs are continuous from the right.
#include "engine/simulate/adaptive_step.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/events/rest.h"
#include "engine/program/breakpoints.h"
#include "engine/simulate/adaptive_simulation.h"
#include "engine/simulate/step_tolerances.h"

namespace hysteron {
namespace {

// So many steps on end that together advance less than this share of the span: it would never come to an end.
constexpr long crawl_steps = 200'000;
constexpr double crawl_share = 1e-4;
// Of a step that is taken again this is left for the step that meets the reversal: what that makes of it wrongly is
// less by as much, and if it still shows it is taken again likewise.
constexpr double rest_before_reversal = 1.0 / 64;
constexpr double rounding = 1e-15;  // of the span: no time in which anything moves

Formula formula_of(Method method) {
  return method == Method::adams ? Formula::adams : method == Method::runge_kutta ? Formula::runge_kutta : Formula::bdf;
}

}  // namespace

AdaptiveSimulation::AdaptiveSimulation(const Program& program, Run run, SimulateOptions options,
                                       std::vector<double> instants, std::vector<int> signals)
    : program_(program),
      run_(std::move(run)),
      options_(std::move(options)),
      work_(program),
      derivative_(program, run_, work_),
      how_far_(options_, std::max(options_.begin, options_.until)),
      sizes_(nominal_sizes(program, run_)),
      growth_(sizes_.states, options_.begin),
      tolerance_(absolute_tolerances(sizes_, options_)),
      events_(program, run_, options_.begin, std::max(options_.begin, options_.until), options_.relative_tolerance,
              tolerance_),
      reversals_(program, sizes_, options_.relative_tolerance),
      crossings_(program, true),
      histories_(program, sizes_.signals, options_.relative_tolerance),
      recorder_(program, run_, work_, std::move(instants), std::move(signals)),
      t_(options_.begin),
      until_(std::max(options_.begin, options_.until)),
      milestone_(t_) {
  run_.t = t_;
  run_.branch = events_.branch();
  x_ = run_.x;
  if (x_.empty()) x_.push_back(0.0);
  before_ = after_ = bad_x_ = x_;
  noticed_.missed = [this](double seen, bool remembered) { return remembered || defects_->jumps(t_, seen); };
  noticed_.passed = [this](double before, double behind, double to) { return defects_->bends(t_, before, behind, to); };
  states_inside_ = [this](double t, std::vector<double>& x) { solver_->interpolate(t, x); };
  if (!options_.slopes_for.empty()) make_sensitivities();
  solver_ = make_solver();
  defects_.emplace(
      *solver_, formula_of(options_.method), program_.n_x,
      [this](double t, const double* x, double* dx) { return derivative(t, x, dx); }, jacobian_.get(), run_,
      tolerance_);
}

AdaptiveSimulation::AdaptiveSimulation(const AdaptiveSimulation& other, Run run)
    : AdaptiveSimulation(other.program_, std::move(run),
                         [&] {
                           SimulateOptions options = other.options_;
                           options.begin = other.t_;
                           options.until = std::max(other.until_, other.t_ + (other.until_ - other.options_.begin));
                           return options;
                         }(),
                         {std::numeric_limits<double>::infinity()}, {}) {
  events_.go_on_as(other.events_);
  run_.branch = events_.branch();
  look_at_ = other.look_at_;
  then_at_ = other.then_at_;
  restart();
}

void AdaptiveSimulation::make_sensitivities() {
  sensitivities_of_ = std::make_unique<ForwardSensitivities>(program_, run_, options_.slopes_for);
  s_ = sensitivities_of_->start(run_, [&](Run& run) {
    if (options_.at_rest) settle_at_rest(program_, run, options_.begin);
  });
  if (s_.empty()) s_.assign(static_cast<std::size_t>(sensitivities_of_->count()), 0.0);  // of the dummy state
  recorder_.record_slopes_of(*sensitivities_of_);
  events_.on_change = [this](std::span<const ModeChange> changes) {
    const double step = 1e-3 * (solver_->t() - solver_->previous_t());
    const double least = 1e-10 * (until_ - options_.begin);
    sensitivities_of_->change_modes(events_, run_, t_, x_, s_, changes, std::max(step, least));
  };
}

std::unique_ptr<Integrator> AdaptiveSimulation::make_solver() {
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
  if (sensitivities_of_ != nullptr) {
    system.parameters = sensitivities_of_->count();
    system.parameter_sizes = sensitivities_of_->parameter_sizes();
    system.sensitivity_derivative = [this](double t, const double* x, const double* const* s, double* const* ds) {
      return sensitivities_of_->derivative(run_, t, x, s, ds);
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

bool AdaptiveSimulation::derivative(double t, const double* x, double* dx) {
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

void AdaptiveSimulation::indicate(double t, const double* x, double* g) {
  evaluate_derivatives(program_, run_, work_, t, x);
  evaluate_memory_rates(program_, run_, work_, t, x);
  if (reversals() > 0) reversals_.indicate(run_, work_, g);
  if (events_.guards() == 0) return;
  evaluate_guards(program_, run_, work_, t, x);
  std::copy(work_.guard.begin(), work_.guard.end(), g + reversals());
}

void AdaptiveSimulation::commit() {
  if (program_.remembers() && sensitivities_of_ != nullptr)
    sensitivities_of_->accept(run_, t_, {x_.data(), static_cast<std::size_t>(program_.n_x)}, s_);
  if (program_.remembers()) accept(program_, run_, work_, t_, x_.data());
  run_.t = t_;
}

/// Inputs that begin to move get a direction.
void AdaptiveSimulation::follow_directions() {
  evaluate_derivatives(program_, run_, work_, t_, x_.data());
  evaluate_memory_rates(program_, run_, work_, t_, x_.data());
  statistics_.reversals += reversals_.follow(run_, work_);
}

/// A known instant: corners, samples. What is due there happens.
void AdaptiveSimulation::pass_instant() {
  happen([this] {
    events_.take(t_, run_);
    if (sensitivities_of_ != nullptr)
      sensitivities_of_->cross(events_, run_, t_, {x_.data(), static_cast<std::size_t>(program_.n_x)}, s_);
    return events_.pass(run_, work_, t_, x_);
  });
}

void AdaptiveSimulation::jump_inputs(const std::function<void()>& change) {
  happen([&] {
    const auto set = [&] {
      change();
      derivative_.forget();
    };
    return events_.jump(run_, work_, t_, x_, set);
  });
}

/// `what` happens at one instant, and says whether states or modes changed; the integrator starts again if it must.
void AdaptiveSimulation::happen(const std::function<bool()>& what) {
  const bool states = program_.n_x > 0;
  crossings_.forget();
  if (states) derivative(t_, x_.data(), before_.data());
  bool moved = what();
  commit();
  moved = crossings_.choose_sides(run_, work_, t_, x_) || moved;
  if (reversals_.count() > 0) follow_directions();
  if (!states || solver_->counters().steps == 0) return;
  if (!moved && sensitivities_of_ == nullptr) {
    derivative(t_, x_.data(), after_.data());
    const double step = solver_->next_step();
    for (std::size_t i = 0; i < after_.size(); ++i) after_[i] = (after_[i] - before_[i]) * step;
    if (solver_->weighted_norm(after_) <= noticed_jump) return;
  }
  restart();
}

/// The integrator has located reversals or falling guards.
void AdaptiveSimulation::pass_root() {
  std::vector<int> turned, fell;
  for (int i = 0; i < reversals(); ++i)
    if (solver_->fired(i)) turned.push_back(i);
  for (int i = 0; i < events_.guards(); ++i)
    if (solver_->fired(reversals() + i)) fell.push_back(i);
  switch_modes(turned, fell);
}

/// Inputs of memory that turn here, and guards that fall here.
void AdaptiveSimulation::switch_modes(const std::vector<int>& turned, const std::vector<int>& fell) {
  commit();
  for (const int i : turned) reversals_.turn(run_, i);
  statistics_.reversals += static_cast<long>(turned.size());
  if (events_.settle(run_, work_, t_, x_, fell)) {
    commit();
    if (reversals_.count() > 0) follow_directions();
  }
  restart();
}

/// Where the step that was just done passes something that switches and that the integrator has not located.
std::optional<ZeroCrossings::Found> AdaptiveSimulation::find_crossing() {
  if (!crossings_.watches()) return std::nullopt;
  return crossings_.first(run_, work_, {t_, solver_->t(), states_inside_, true}, noticed_);
}

/// A Runge-Kutta step evaluates dx/dt inside of itself, and the polynomial of Adams' formulas is of a high order: where
/// dx/dt bends neither is anything. True if the step is taken again, up to the kink.
bool AdaptiveSimulation::begin_anew(const ZeroCrossings::Found& crossing) {
  if (!crossing.bent || formula_of(options_.method) == Formula::bdf) return false;
  if (crossing.before - t_ <= 2 * root_width(t_, crossing.t)) return false;
  constexpr double never = std::numeric_limits<double>::infinity();
  look_at_ = crossing.before;
  then_at_ = crossing.seen > crossing.t + 2 * root_width(t_, crossing.seen) ? crossing.seen : never;
  crossings_.forget();
  solver_->start(t_, x_, s_);
  return true;
}

/// What leads to a reversal is taken again, up to just before, where the step did not foresee it.
bool AdaptiveSimulation::begin_anew_before_reversal() {
  const double h = solver_->t() - t_;
  if (h <= 2 * root_width(t_, solver_->t())) return false;
  bool turns = false;
  for (int i = 0; i < reversals(); ++i) turns = turns || solver_->fired(i);
  if (!turns || defects_->leads_to_its_end(t_)) return false;
  if (look_at_ < then_at_) then_at_ = look_at_;
  look_at_ = solver_->t() - h * rest_before_reversal;
  crossings_.forget();
  solver_->start(t_, x_, s_);
  return true;
}

/// The step ends at the crossing; t_ and x_ are there already.
void AdaptiveSimulation::pass_crossing(const ZeroCrossings::Found& crossing) {
  if (!crossing.guards.empty()) return switch_modes({}, crossing.guards);
  commit();
  if (events_.settle(run_, work_, t_, x_, {})) commit();  // a jump of what bends here may switch others
  if (reversals_.count() > 0) follow_directions();        // and the rate may have changed its sign
  // What is behind the kink has to be seen by the integrator too: another step may be as long.
  if (crossing.seen > t_ + 2 * root_width(t_, crossing.seen)) look_at_ = crossing.seen;
  restart();
}

/// A guard may have fallen and risen within rounding of a step's end, unseen by the integrator.
void AdaptiveSimulation::check_guards() {
  if (events_.guards() == 0 || !events_.due(run_, work_, t_, x_)) return;
  if (!events_.settle(run_, work_, t_, x_, {})) return;
  commit();
  if (reversals_.count() > 0) follow_directions();
  restart();
}

void AdaptiveSimulation::check_pace() {
  if (++steps_since_milestone_ < crawl_steps) return;
  if (t_ - milestone_ < crawl_share * (until_ - options_.begin))
    fail_numerics(
        "step_too_small", "simulate/solver",
        fmt::format("the last {} steps advanced from t = {:.12g} s by {:.3g} s only; now at {}", steps_since_milestone_,
                    milestone_, t_ - milestone_, solver_->where()),
        "something jumps to and fro: check the loop through the states named, or ask for less accuracy. Or what "
        "moves there is too fast to be followed for so long: simulate a shorter time");
  milestone_ = t_;
  steps_since_milestone_ = 0;
}

void AdaptiveSimulation::take_step(double stop) {
  look_up_();
  how_far_(t_);
  check_pace();
  const auto outcome = solver_->step(stop);
  const auto crossing = find_crossing();
  if (crossing && begin_anew(*crossing)) return;
  if (!crossing && outcome == Integrator::Outcome::root && begin_anew_before_reversal()) return;
  const double from = t_, to = crossing ? crossing->t : solver_->t();
  recorder_.inside(*solver_, from, to, statistics_.phases.output);
  if (histories_.any()) histories_.fill(run_, work_, from, to, states_inside_);
  t_ = to;
  pass_look();
  if (crossing) {
    const Stopwatch watch(statistics_.phases.events);
    solver_->interpolate(t_, x_);
    if (sensitivities_of_ != nullptr) solver_->interpolate_sensitivities(t_, s_);
    return pass_crossing(*crossing);
  }
  std::copy(solver_->x().begin(), solver_->x().end(), x_.begin());
  growth_.see(t_, x_);
  if (sensitivities_of_ != nullptr)
    std::copy(solver_->sensitivities().begin(), solver_->sensitivities().end(), s_.begin());
  if (outcome == Integrator::Outcome::root) {
    const Stopwatch watch(statistics_.phases.events);
    return pass_root();
  }
  commit();
  if (reversals_.open(run_)) follow_directions();
  check_guards();
}

void AdaptiveSimulation::begin() {
  try {
    const Stopwatch watch(statistics_.phases.events);
    events_.take(t_, run_);
    events_.begin(run_, work_, t_, x_);
    events_.starting(true);
    if (sensitivities_of_ != nullptr)
      sensitivities_of_->cross(events_, run_, t_, {x_.data(), static_cast<std::size_t>(program_.n_x)}, s_);
    events_.starting(false);
    commit();
    if (reversals_.count() > 0) follow_directions();
    restart();
  } catch (const Error& error) {
    explain(error);
  }
}

void AdaptiveSimulation::advance(double end, bool with_its_events) {
  try {
    for (;;) {
      const bool at_end = t_ + same_instant(t_) >= end;
      while ((with_its_events || !at_end) && events_.next() <= t_ + same_instant(t_)) {
        look_up_();
        const Stopwatch watch(statistics_.phases.events);
        pass_instant();
      }
      recorder_.due(t_, x_.data(), s_, statistics_.phases.output);
      if (at_end) return;
      const double stop = std::min({events_.next(), end, look_at_});
      if (stop - t_ > rounding * (until_ - options_.begin)) {
        take_step(stop);
      } else {  // too near for an integrator, and for the states to move
        t_ = stop;
        pass_look();
        commit();
      }
    }
  } catch (const Error& error) {
    explain(error);
  }
}

double AdaptiveSimulation::value(int signal) {
  evaluate_values(program_, run_, work_, t_, x_.data());
  throw_if_unsolved(program_, work_, t_);
  return work_.y[static_cast<std::size_t>(signal)];
}

Run AdaptiveSimulation::at_present() const {
  Run run = run_;
  if (program_.n_x > 0) run.x = x_;
  return run;
}

Traces AdaptiveSimulation::operator()() {
  auto& phases = statistics_.phases;
  {
    const Stopwatch all(phases.integrate);
    begin();
    advance(until_, true);
  }
  phases.integrate -= phases.events + phases.output;
  const auto counters = solver_->counters();
  auto& s = statistics_;
  s.method = method_name(options_.method);
  s.steps = counters.steps;
  s.rejected = counters.rejected;
  s.evaluations = counters.evaluations;
  s.jacobians = counters.jacobians;
  s.restarts = counters.restarts;
  tell_counts(program_, events_, work_, s);
  Traces traces = recorder_.take();
  traces.statistics = std::move(statistics_);
  traces.end = at_present();
  return traces;
}

/// A solver that failed says what it tried; the reader wants to know which state or block made it fail.
void AdaptiveSimulation::explain(const Error& error) {
  const auto& code = error.problems.front().code;
  if (code != "solver_failed" && code != "step_too_small" && code != "diverged") throw error;
  throw_if_grown(program_, growth_.quantities(program_, x_), t_, code == "diverged" ? "" : error.problems.front().what);
  if (code == "diverged") throw error;
  if (not_finite_) not_finite(program_, run_, work_, bad_t_, bad_x_.data());
  if (std::abs(bad_t_ - t_) <= crawl_share * (until_ - options_.begin)) {
    // Steps crept up to where a loop has no solution: the last evaluation was still this side of it.
    evaluate_derivatives(program_, run_, work_, bad_t_, bad_x_.data());
    throw_if_unsolved(program_, work_, bad_t_);
    // Or to where a law ends: explicit steps come to rest this side of it.
    if (std::any_of(work_.dx.begin(), work_.dx.end(), [](double v) { return !std::isfinite(v); }))
      not_finite(program_, run_, work_, bad_t_, bad_x_.data());
  }
  evaluate_derivatives(program_, run_, work_, t_, x_.data());
  // Of a span that steps would never reach the end of, the part that they got through counts.
  const double span = steps_since_milestone_ < crawl_steps ? until_ - options_.begin : t_ - milestone_;
  throw_if_upright(program_, work_, growth_.quantities(program_, x_), t_, span);
  throw error;
}

Traces simulate_in_adaptive_steps(const Program& program, Run run, SimulateOptions options,
                                  std::vector<double> instants, std::vector<int> signals) {
  options.until = instants.back();
  return AdaptiveSimulation(program, std::move(run), std::move(options), std::move(instants), std::move(signals))();
}

}  // namespace hysteron
