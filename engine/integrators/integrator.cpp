#include "engine/integrators/integrator.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "engine/diagram/error.h"
#include "engine/integrators/integrator_parts.h"
#include "engine/integrators/vector_operations.h"

namespace hysteron {
namespace {

// Steps that do not advance the time beyond rounding before we give up: the solution has no continuation there.
constexpr int standing_steps_allowed = 20;
constexpr std::size_t states_in_a_message = 10;  // those of the largest error

}  // namespace

void expect(int flag, const char* call) {
  if (flag != 0) throw std::runtime_error(fmt::format("{} failed with code {}", call, flag));
}
void expect(const void* made, const char* call) {
  if (made == nullptr) throw std::runtime_error(fmt::format("{} failed", call));
}

double InitialValueProblem::parameter_size(int k) const {
  if (system.parameter_sizes.empty()) return 1.0;
  const double size = std::abs(system.parameter_sizes[static_cast<std::size_t>(k)]);
  return size > 0 ? size : 1.0;
}

Vector InitialValueProblem::view(double* data, sunindextype length) const {
  Vector v(made(N_VMake_Serial(length, data, context.get()), "N_VMake_Serial"));
  use_own_operations(v.get());
  return v;
}

int InitialValueProblem::derivative(realtype t, N_Vector x, N_Vector dx, void* user) {
  InitialValueProblem& self = of(user);
  return self.guarded([&] { return self.system.derivative(t, NV_DATA_S(x), NV_DATA_S(dx)); });
}

int InitialValueProblem::indicators(realtype t, N_Vector x, realtype* g, void* user) {
  InitialValueProblem& self = of(user);
  ++self.indicator_evaluations;
  return self.guarded([&] {
    self.system.indicators(t, NV_DATA_S(x), g);
    return true;
  });
}

int InitialValueProblem::weights(N_Vector x, N_Vector w, void* user) {
  InitialValueProblem& self = of(user);
  error_weights(self.options.relative_tolerance, self.tolerance.data(), x, w);
  return 0;
}

void InitialValueProblem::keep_message(int, const char*, const char*, char* text, void* user) {
  of(user).message = text;
}

struct Integrator::Memory {
  InitialValueProblem problem;
  std::unique_ptr<Stepper> stepper;
  double t = 0, previous_t = 0;
  int standing = 0;
  long restarts = -1;  // -1 = not yet started

  std::size_t states() const { return static_cast<std::size_t>(problem.states()); }
  std::span<const double> x() const { return {problem.values.data(), states()}; }
  std::span<const double> sensitivities() const { return std::span(problem.values).subspan(states()); }
  void check_progress();
  void check_interpolation(int flag, double time);
  [[noreturn]] void raise(int flag);
  std::string where() const;
  std::string largest_errors() const;
};

std::string Integrator::Memory::largest_errors() const {
  std::vector<double> w(states()), e(states());
  const auto n = static_cast<sunindextype>(states());
  if (!stepper->local_errors(problem.view(w.data(), n).get(), problem.view(e.data(), n).get())) return "";
  const auto size = [&](std::size_t i) {
    const double s = std::abs(w[i] * e[i]);
    return std::isfinite(s) ? s : std::numeric_limits<double>::max();
  };
  std::vector<std::size_t> order(w.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return size(a) > size(b); });
  order.resize(std::min(order.size(), states_in_a_message));
  std::vector<std::string> parts;
  for (const auto i : order) {
    const auto& name_of = problem.system.state_name;
    const auto name = name_of ? name_of(static_cast<int>(i)) : fmt::format("state {}", i);
    parts.push_back(fmt::format("{} = {:.6g} (error {:.3g} tolerances)", name, x()[i], w[i] * e[i]));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string Integrator::Memory::where() const {
  auto text = fmt::format("t = {:.9g} s, step {:.3g} s, order {}", t, stepper->next_step(), stepper->order());
  if (const auto states = largest_errors(); !states.empty())
    text += fmt::format("; states with the largest error [SI]: {}", states);
  return text;
}

void Integrator::Memory::raise(int flag) {
  if (problem.thrown) {
    try {
      std::rethrow_exception(std::exchange(problem.thrown, nullptr));
    } catch (const Error& e) {
      auto problems = e.problems;
      if (!problems.empty()) problems.front().what += "\n  while integrating: " + where();
      throw Error(e.fault, std::move(problems));
    }
  }
  std::string said = problem.message.empty() ? fmt::format("code {}", flag) : problem.message;
  while (!said.empty() && (said.back() == '\n' || said.back() == ' ')) said.pop_back();
  fail_numerics(
      "solver_failed", "simulate/solver",
      fmt::format("the integrator cannot go on at {}. {} says: {}", where(), stepper->library(), said),
      "look at the blocks named: a loop with too high a gain, a jump inside it or a wrong parameter does this; "
      "else try another relative_tolerance, max_step or method");
}

void Integrator::Memory::check_progress() {
  const double ulp = std::abs(t) * std::numeric_limits<double>::epsilon();
  standing = t - previous_t > 2 * ulp ? 0 : standing + 1;
  if (standing <= standing_steps_allowed) return;
  fail_numerics(
      "step_too_small", "simulate/solver",
      fmt::format("the steps have become too small to advance the time at {}", where()),
      "a state runs away in finite time, or a loop jumps to and fro: check gain and sign of the loop through the "
      "states named");
}

void Integrator::Memory::check_interpolation(int flag, double time) {
  if (flag == 0) return;
  if (problem.thrown) raise(flag);
  throw std::logic_error(
      fmt::format("no states at t = {:.17g} s: the last step went from {:.17g} s to {:.17g} s", time, previous_t, t));
}

Integrator::Integrator(OdeSystem system, const IntegratorOptions& options, std::span<const double> absolute_tolerance)
    : memory_(std::make_unique<Memory>()) {
  InitialValueProblem& p = memory_->problem;
  p.system = std::move(system);
  p.options = options;
  SUNContext made = nullptr;
  expect(SUNContext_Create(nullptr, &made), "SUNContext_Create");
  p.context.reset(made);
  const auto n = static_cast<std::size_t>(p.states());
  p.values.assign(n * (1 + static_cast<std::size_t>(p.parameters())), 0.0);
  p.tolerance.assign(p.values.size(), 0.0);
  for (std::size_t i = 0; i < p.tolerance.size(); ++i) {
    const double size = i < n ? 1.0 : p.parameter_size(static_cast<int>(i / n) - 1);
    p.tolerance[i] = absolute_tolerance[i % n] / size;
  }
  p.x = p.view(p.values.data(), p.states());
  memory_->stepper = options.formula == Formula::runge_kutta ? make_arkode_stepper(p) : make_cvodes_stepper(p);
}
Integrator::~Integrator() = default;

void Integrator::start(double t, std::span<const double> x, std::span<const double> sensitivities) {
  Memory& m = *memory_;
  auto& values = m.problem.values;
  const auto behind_x = values.begin() + m.problem.states();
  if (x.data() != values.data()) std::copy(x.begin(), x.end(), values.begin());
  if (sensitivities.empty())
    std::fill(behind_x, values.end(), 0.0);
  else if (sensitivities.data() != m.sensitivities().data())
    std::copy(sensitivities.begin(), sensitivities.end(), behind_x);
  m.t = m.previous_t = t;
  m.standing = 0;
  ++m.restarts;
  m.problem.message.clear();
  m.stepper->start(t);
}

Integrator::Outcome Integrator::step(double stop) {
  Memory& m = *memory_;
  m.previous_t = m.t;
  const auto done = m.stepper->step(stop);
  if (done.flag < 0 || m.problem.thrown) m.raise(done.flag);
  m.t = done.t;
  if (done.outcome == Outcome::step) m.check_progress();
  return done.outcome;
}

double Integrator::t() const { return memory_->t; }
double Integrator::previous_t() const { return memory_->previous_t; }
std::span<const double> Integrator::x() const { return memory_->x(); }
std::span<const double> Integrator::sensitivities() const { return memory_->sensitivities(); }
bool Integrator::fired(int root) const { return memory_->stepper->fired(root); }
std::string Integrator::where() const { return memory_->where(); }
double Integrator::next_step() const { return memory_->stepper->next_step(); }

void Integrator::interpolate(double time, std::span<double> x) const {
  memory_->check_interpolation(memory_->stepper->interpolate(time, 0, x.data()), time);
}

void Integrator::interpolate_sensitivities(double time, std::span<double> sensitivities) const {
  Memory& m = *memory_;
  for (int k = 0; k < m.problem.parameters(); ++k)
    m.check_interpolation(
        m.stepper->interpolate(time, k + 1, sensitivities.data() + static_cast<std::size_t>(k) * m.states()), time);
}

double Integrator::weighted_norm(std::span<const double> v) const {
  const InitialValueProblem& p = memory_->problem;
  double sum = 0;
  for (std::size_t i = 0; i < v.size(); ++i) {
    const double w = v[i] / (p.options.relative_tolerance * std::abs(p.values[i]) + p.tolerance[i]);
    sum += w * w;
  }
  return std::sqrt(sum / static_cast<double>(v.size()));
}

Integrator::Counters Integrator::counters() const {
  auto c = memory_->stepper->counters();
  c.evaluations += memory_->problem.indicator_evaluations;
  c.restarts = std::max(0L, memory_->restarts);
  return c;
}

}  // namespace hysteron
