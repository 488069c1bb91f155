#include "engine/cvode.h"

#include <cvode/cvode.h>
#include <fmt/format.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>
#include <vector>

#include "engine/error.h"

namespace hysteron {
namespace {

static_assert(std::is_same_v<realtype, double>);

// Steps that do not advance the time beyond rounding before we give up: the solution has no continuation there.
constexpr int standing_steps_allowed = 20;
// Behind a corner of an input the first step may be ten thousand times too long, and each failure divides it by ten at
// most.
constexpr int error_failures_allowed = 30;
constexpr std::size_t states_in_a_message = 10;  // ENGINE 14

template <auto Destroy>
struct With {
  template <class T>
  void operator()(T* p) const {
    Destroy(p);
  }
};
void free_context(SUNContext c) { SUNContext_Free(&c); }
void free_cvode(void* memory) { CVodeFree(&memory); }

using Context = std::unique_ptr<std::remove_pointer_t<SUNContext>, With<&free_context>>;
using Vector = std::unique_ptr<std::remove_pointer_t<N_Vector>, With<&N_VDestroy>>;
using Matrix = std::unique_ptr<std::remove_pointer_t<SUNMatrix>, With<&SUNMatDestroy>>;
using LinearSolver = std::unique_ptr<std::remove_pointer_t<SUNLinearSolver>, With<&SUNLinSolFree>>;
using NonlinearSolver = std::unique_ptr<std::remove_pointer_t<SUNNonlinearSolver>, With<&SUNNonlinSolFree>>;
using CvodeMemory = std::unique_ptr<void, With<&free_cvode>>;

/// For set-up calls, which fail only if memory runs out or we misuse them.
void expect(int flag, const char* call) {
  if (flag != CV_SUCCESS) throw std::runtime_error(fmt::format("{} failed with code {}", call, flag));
}
template <class T>
T* expect(T* made, const char* call) {
  if (made == nullptr) throw std::runtime_error(fmt::format("{} failed", call));
  return made;
}

}  // namespace

// Declared in the order in which SUNDIALS needs them: destroyed from the bottom up.
struct Cvode::Memory {
  OdeSystem system;
  CvodeOptions options;
  Context context;
  Vector x, tolerance, weights, local_error, scratch;
  Matrix matrix;
  LinearSolver linear_solver;
  NonlinearSolver nonlinear_solver;
  CvodeMemory cvode;
  std::exception_ptr thrown;
  std::string message;  // the last that CVODE wrote
  double t = 0, previous_t = 0;
  int standing = 0;
  bool started = false;
  long indicator_evaluations = 0;
  Counters before;  // of the parts of the run before the last restart

  static Memory& of(void* user) { return *static_cast<Memory*>(user); }

  static int derivative(realtype time, N_Vector state, N_Vector rate, void* user) {
    Memory& self = of(user);
    try {
      return self.system.derivative(time, N_VGetArrayPointer(state), N_VGetArrayPointer(rate)) ? 0 : 1;
    } catch (...) {
      self.thrown = std::current_exception();
      return -1;
    }
  }
  static int indicators(realtype time, N_Vector state, realtype* g, void* user) {
    Memory& self = of(user);
    try {
      ++self.indicator_evaluations;
      self.system.indicators(time, N_VGetArrayPointer(state), g);
      return 0;
    } catch (...) {
      self.thrown = std::current_exception();
      return -1;
    }
  }
  static void keep_message(int, const char*, const char*, char* text, void* user) { of(user).message = text; }

  Vector vector() const { return Vector(expect(N_VNew_Serial(system.states, context.get()), "N_VNew_Serial")); }
  std::span<double> numbers(const Vector& v) const {
    return {N_VGetArrayPointer(v.get()), static_cast<std::size_t>(system.states)};
  }

  void make(std::span<const double> absolute_tolerance);
  void first_start();
  Counters of_this_part() const;
  void check_progress();
  [[noreturn]] void raise(int flag);
  std::string where() const;
  std::string largest_errors() const;
};

void Cvode::Memory::make(std::span<const double> absolute_tolerance) {
  SUNContext made = nullptr;
  expect(SUNContext_Create(nullptr, &made), "SUNContext_Create");
  context.reset(made);
  x = vector();
  tolerance = vector();
  weights = vector();
  local_error = vector();
  scratch = vector();
  std::copy(absolute_tolerance.begin(), absolute_tolerance.end(), numbers(tolerance).begin());
  cvode.reset(expect(CVodeCreate(options.formula == Formula::bdf ? CV_BDF : CV_ADAMS, context.get()), "CVodeCreate"));
}

void Cvode::Memory::first_start() {
  void* memory = cvode.get();
  expect(CVodeSetErrHandlerFn(memory, &keep_message, this), "CVodeSetErrHandlerFn");
  expect(CVodeInit(memory, &derivative, t, x.get()), "CVodeInit");
  expect(CVodeSetUserData(memory, this), "CVodeSetUserData");
  expect(CVodeSVtolerances(memory, options.relative_tolerance, tolerance.get()), "CVodeSVtolerances");
  if (options.max_step > 0) expect(CVodeSetMaxStep(memory, options.max_step), "CVodeSetMaxStep");
  expect(CVodeSetMaxErrTestFails(memory, error_failures_allowed), "CVodeSetMaxErrTestFails");
  if (options.formula == Formula::bdf) {
    matrix.reset(expect(SUNDenseMatrix(system.states, system.states, context.get()), "SUNDenseMatrix"));
    linear_solver.reset(expect(SUNLinSol_Dense(x.get(), matrix.get(), context.get()), "SUNLinSol_Dense"));
    expect(CVodeSetLinearSolver(memory, linear_solver.get(), matrix.get()), "CVodeSetLinearSolver");
  } else {
    nonlinear_solver.reset(expect(SUNNonlinSol_FixedPoint(x.get(), 0, context.get()), "SUNNonlinSol_FixedPoint"));
    expect(CVodeSetNonlinearSolver(memory, nonlinear_solver.get()), "CVodeSetNonlinearSolver");
  }
  if (system.roots > 0) {
    expect(CVodeRootInit(memory, system.roots, &indicators), "CVodeRootInit");
    std::vector<int> falling(static_cast<std::size_t>(system.roots), -1);
    expect(CVodeSetRootDirection(memory, falling.data()), "CVodeSetRootDirection");
    expect(CVodeSetNoInactiveRootWarn(memory), "CVodeSetNoInactiveRootWarn");
  }
}

Cvode::Counters Cvode::Memory::of_this_part() const {
  Counters c;
  if (!started) return c;
  void* memory = cvode.get();
  long error_failures = 0, step_failures = 0, for_jacobian = 0;
  CVodeGetNumSteps(memory, &c.steps);
  CVodeGetNumRhsEvals(memory, &c.evaluations);
  CVodeGetNumErrTestFails(memory, &error_failures);
  CVodeGetNumStepSolveFails(memory, &step_failures);
  c.rejected = error_failures + step_failures;
  if (options.formula == Formula::bdf) {
    CVodeGetNumJacEvals(memory, &c.jacobians);
    CVodeGetNumLinRhsEvals(memory, &for_jacobian);
  }
  c.evaluations += for_jacobian;
  return c;
}

std::string Cvode::Memory::largest_errors() const {
  void* memory = cvode.get();
  if (CVodeGetErrWeights(memory, weights.get()) != CV_SUCCESS) return "";
  if (CVodeGetEstLocalErrors(memory, local_error.get()) != CV_SUCCESS) return "";
  const auto w = numbers(weights);
  const auto e = numbers(local_error);
  const auto v = numbers(x);
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
    const auto name = system.state_name ? system.state_name(static_cast<int>(i)) : fmt::format("state {}", i);
    parts.push_back(fmt::format("{} = {:.6g} (error {:.3g} tolerances)", name, v[i], w[i] * e[i]));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string Cvode::Memory::where() const {
  double step = 0;
  int order = 0;
  CVodeGetCurrentStep(cvode.get(), &step);
  CVodeGetCurrentOrder(cvode.get(), &order);
  auto text = fmt::format("t = {:.9g} s, step {:.3g} s, order {}", t, step, order);
  if (const auto states = largest_errors(); !states.empty())
    text += fmt::format("; states with the largest error [SI]: {}", states);
  return text;
}

void Cvode::Memory::raise(int flag) {
  if (thrown) {
    try {
      std::rethrow_exception(std::exchange(thrown, nullptr));
    } catch (const Error& e) {
      auto problems = e.problems;
      if (!problems.empty()) problems.front().what += "\n  while integrating: " + where();
      throw Error(e.fault, std::move(problems));
    }
  }
  std::string said = message.empty() ? fmt::format("code {}", flag) : message;
  while (!said.empty() && (said.back() == '\n' || said.back() == ' ')) said.pop_back();
  fail_numerics(
      "solver_failed", "simulate/solver",
      fmt::format("the integrator cannot go on at {}. CVODE says: {}", where(), said),
      "look at the blocks named: a loop with too high a gain, a jump inside it or a wrong parameter does this; "
      "else try another relative_tolerance, max_step or method");
}

void Cvode::Memory::check_progress() {
  const double ulp = std::abs(t) * std::numeric_limits<double>::epsilon();
  standing = t - previous_t > 2 * ulp ? 0 : standing + 1;
  if (standing <= standing_steps_allowed) return;
  fail_numerics(
      "step_too_small", "simulate/solver",
      fmt::format("the steps have become too small to advance the time at {}", where()),
      "a state runs away in finite time, or a loop jumps to and fro: check gain and sign of the loop through the "
      "states named");
}

Cvode::Cvode(OdeSystem system, const CvodeOptions& options, std::span<const double> absolute_tolerance)
    : memory_(std::make_unique<Memory>()) {
  memory_->system = std::move(system);
  memory_->options = options;
  memory_->make(absolute_tolerance);
}
Cvode::~Cvode() = default;

void Cvode::start(double t, std::span<const double> x) {
  Memory& m = *memory_;
  if (m.started) {
    const auto part = m.of_this_part();
    m.before.steps += part.steps;
    m.before.rejected += part.rejected;
    m.before.evaluations += part.evaluations;
    m.before.jacobians += part.jacobians;
    ++m.before.restarts;
  }
  if (x.data() != m.numbers(m.x).data()) std::copy(x.begin(), x.end(), m.numbers(m.x).begin());
  m.t = m.previous_t = t;
  m.standing = 0;
  if (m.started) {
    expect(CVodeReInit(m.cvode.get(), t, m.x.get()), "CVodeReInit");
  } else {
    m.first_start();
    m.started = true;
  }
}

Cvode::Outcome Cvode::step(double stop) {
  Memory& m = *memory_;
  m.previous_t = m.t;
  expect(CVodeSetStopTime(m.cvode.get(), stop), "CVodeSetStopTime");
  double reached = m.t;
  const int flag = CVode(m.cvode.get(), stop, m.x.get(), &reached, CV_ONE_STEP);
  if (flag < 0) m.raise(flag);
  m.t = reached;
  if (flag == CV_TSTOP_RETURN) return Outcome::stop;
  if (flag == CV_ROOT_RETURN) return Outcome::root;
  m.check_progress();
  return Outcome::step;
}

double Cvode::t() const { return memory_->t; }
double Cvode::previous_t() const { return memory_->previous_t; }
std::span<const double> Cvode::x() const { return memory_->numbers(memory_->x); }

bool Cvode::fired(int root) const {
  std::vector<int> found(static_cast<std::size_t>(memory_->system.roots));
  expect(CVodeGetRootInfo(memory_->cvode.get(), found.data()), "CVodeGetRootInfo");
  return found[static_cast<std::size_t>(root)] != 0;
}

void Cvode::interpolate(double time, std::span<double> x) const {
  const Memory& m = *memory_;
  expect(CVodeGetDky(m.cvode.get(), time, 0, m.scratch.get()), "CVodeGetDky");
  const auto v = m.numbers(m.scratch);
  std::copy(v.begin(), v.end(), x.begin());
}

std::string Cvode::where() const { return memory_->where(); }

double Cvode::next_step() const {
  double step = 0;
  CVodeGetCurrentStep(memory_->cvode.get(), &step);
  return step;
}

double Cvode::weighted_norm(std::span<const double> v) const {
  const Memory& m = *memory_;
  const auto x = m.numbers(m.x);
  const auto a = m.numbers(m.tolerance);
  double sum = 0;
  for (std::size_t i = 0; i < v.size(); ++i) {
    const double w = v[i] / (m.options.relative_tolerance * std::abs(x[i]) + a[i]);
    sum += w * w;
  }
  return std::sqrt(sum / static_cast<double>(v.size()));
}

Cvode::Counters Cvode::counters() const {
  const auto part = memory_->of_this_part();
  auto sum = memory_->before;
  sum.steps += part.steps;
  sum.rejected += part.rejected;
  sum.evaluations += part.evaluations + memory_->indicator_evaluations;
  sum.jacobians += part.jacobians;
  return sum;
}

}  // namespace hysteron
