// Decides how CVODE is driven: one step at a time, stop times, falling roots, dense output, restarts, and what its
// failures say. Does not know diagrams: it sees sizes, two functions and names for its messages. cvode.cpp is the only
// file that includes SUNDIALS.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>

namespace hysteron {

/// What CVODE integrates. The functions may throw: the exception never crosses the C boundary, it is raised again by
/// Cvode::step, with t, step, order and the states of the largest weighted error added if it is an Error.
struct OdeSystem {
  int states = 1;
  int roots = 0;
  /// dx/dt; returns false where it is not finite, and a smaller step is tried.
  std::function<bool(double t, const double* x, double* dx)> derivative;
  /// Indicators; a root is where one of them falls through zero.
  std::function<void(double t, const double* x, double* g)> indicators{};
  std::function<std::string(int state)> state_name{};
};

enum class Formula { bdf, adams };

struct CvodeOptions {
  Formula formula = Formula::bdf;  ///< bdf: Newton with a dense Jacobian by differences; adams: fixed-point iteration
  double relative_tolerance = 1e-6;
  double max_step = 0;  ///< [s]; 0 = none
};

class Cvode {
 public:
  enum class Outcome { step, stop, root };
  struct Counters {
    long steps = 0, rejected = 0, evaluations = 0, jacobians = 0, restarts = 0;
  };

  /// `absolute_tolerance`: one per state [SI].
  Cvode(OdeSystem system, const CvodeOptions& options, std::span<const double> absolute_tolerance);
  ~Cvode();
  Cvode(const Cvode&) = delete;
  Cvode& operator=(const Cvode&) = delete;

  /// Starts at (t, x), or starts again there: the past is forgotten, the order is one.
  void start(double t, std::span<const double> x);

  /// One internal step, cut at `stop` [s] (must be behind t by more than a few ulp) or at the first root inside it.
  /// Throws Error(Fault::numerics): "solver_failed", "step_too_small".
  Outcome step(double stop);

  double t() const;                   ///< where the last step ended [s]
  double previous_t() const;          ///< where it began [s]
  std::span<const double> x() const;  ///< states at t()
  bool fired(int root) const;         ///< after Outcome::root
  /// States at any time of the last step, to the accuracy of the step itself.
  void interpolate(double time, std::span<double> x) const;
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
