// Decides how the adaptive integrators are driven: one step at a time, stop times, falling roots, dense output,
// restarts, sensitivities, and what their failures say. Does not know diagrams: it sees sizes, functions and names for
// its messages. Behind it stand CVODES (integrator_cvodes.cpp) and ARKODE (integrator_arkode.cpp), whose headers no
// file outside integrator*, vector_operations and dense_solver sees.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace hysteron {

/// Which entries of a square matrix may be other than zero, column by column; empty = all of them.
struct SparsityPattern {
  std::vector<int> column_begin{};  ///< states + 1 entries: where each column begins in `row`
  std::vector<int> row{};           ///< increasing within each column

  bool empty() const { return column_begin.empty(); }
};

/// What is integrated. The functions may throw: the exception never crosses the C boundary, it is raised again by
/// Integrator::step, with t, step, order and the states of the largest weighted error added if it is an Error.
struct OdeSystem {
  int states = 1;
  int roots = 0;
  int parameters = 0;  ///< whose sensitivities dx/dp are integrated along
  /// dx/dt; returns false where it is not finite, and a smaller step is tried.
  std::function<bool(double t, const double* x, double* dx)> derivative;
  /// Indicators; a root is where one of them falls through zero.
  std::function<void(double t, const double* x, double* g)> indicators{};
  std::function<std::string(int state)> state_name{};
  /// d(dx_i/dt)/dx_j for bdf: the entries of `pattern` in its order (all entries by columns where it is empty); returns
  /// false where one is not finite. Without it CVODE takes differences of `derivative`.
  std::function<bool(double t, const double* x, double* entries)> jacobian{};
  SparsityPattern pattern{};
  /// dS/dt = J S + df/dp, all parameters at once: s[k] and ds[k] are the columns of parameter k, `states` long. Needed
  /// if parameters > 0; returns false where one is not finite.
  std::function<bool(double t, const double* x, const double* const* s, double* const* ds)> sensitivity_derivative{};
  /// Usual sizes of the parameters [SI], for the error weights of their sensitivities: dx/dp is held to the tolerance
  /// of x over the size of p. Empty = all 1; zero counts as 1.
  std::vector<double> parameter_sizes{};
};

enum class Formula {
  bdf,         ///< backward differences, order 1 to 5, Newton: for stiff systems
  adams,       ///< Adams-Moulton, order 1 to 12, fixed-point iteration
  runge_kutta  ///< Dormand-Prince 5(4), explicit: a restart costs no accuracy and hardly any time
};

struct IntegratorOptions {
  Formula formula = Formula::bdf;
  double relative_tolerance = 1e-6;
  double max_step = 0;  ///< [s]; 0 = none
};

class Integrator {
 public:
  enum class Outcome { step, stop, root };
  struct Counters {
    long steps = 0, rejected = 0;
    long evaluations = 0;  ///< of derivative and indicators, differences for the Jacobian and dense output included
    long sensitivity_evaluations = 0;
    long jacobians = 0, factorizations = 0;  ///< zero for explicit formulas
    long restarts = 0;
  };

  /// `absolute_tolerance`: one per state [SI], positive.
  Integrator(OdeSystem system, const IntegratorOptions& options, std::span<const double> absolute_tolerance);
  ~Integrator();
  Integrator(const Integrator&) = delete;
  Integrator& operator=(const Integrator&) = delete;

  /// Starts at (t, x), or starts again there: the past is forgotten. `sensitivities`: dx/dp by columns, states times
  /// parameters; empty = zero. After the first start nothing is allocated, but by the differences for a missing
  /// Jacobian.
  void start(double t, std::span<const double> x, std::span<const double> sensitivities = {});

  /// One internal step, cut at `stop` [s] (must be behind t by more than a few ulp) or at the first root inside it.
  /// Throws Error(Fault::numerics): "solver_failed", "step_too_small".
  Outcome step(double stop);

  double t() const;                               ///< where the last step ended [s]
  double previous_t() const;                      ///< where it began [s]
  std::span<const double> x() const;              ///< states at t()
  std::span<const double> sensitivities() const;  ///< dx/dp at t(), by columns
  bool fired(int root) const;                     ///< after Outcome::root
  /// States at any time of the last step, to the accuracy of the step itself.
  void interpolate(double time, std::span<double> x) const;
  /// The same for dx/dp, by columns.
  void interpolate_sensitivities(double time, std::span<double> sensitivities) const;
  double next_step() const;  ///< step that will be tried next [s]
  /// Root mean square of v_i / (relative_tolerance * |x_i| + absolute_tolerance_i).
  double weighted_norm(std::span<const double> v) const;
  /// Time, step, order and the states of the largest weighted error, for messages.
  std::string where() const;
  /// Of all steps since construction, restarts included.
  Counters counters() const;

 private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
};

}  // namespace hysteron
