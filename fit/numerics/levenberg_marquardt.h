// Decides how a bounded nonlinear least-squares problem is solved. Does not know where residuals come from.
//
// Levenberg-Marquardt: each step p minimizes |J p + r|^2 + mu |D p|^2 over the box that the bounds leave, exactly (the
// active set method of linear.h on the triangular factor of [J r]; D = the longest each column has been: Moré, Lect.
// Notes Math. 630 (1978) 105). mu follows the gain ratio, actual over predicted fall of the squared error (Nielsen, IMM
// report 1999-05). A trial that cannot be evaluated is a rejected trial. It ends where not even the undamped step
// inside the bounds would lower the squared error by more than `tolerance` of itself, or than what `matters`.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "fit/numerics/dense.h"
#include "fit/numerics/linear.h"

namespace hysteron {

/// |A x - b|^2 over [inner unknowns, z], A and b as a triangle, and the bounds of the inner ones.
struct LinearizedResidual {
  NormalForm form;
  std::vector<double> low, high;
};

struct LeastSquares {
  std::vector<double> lower, upper;  ///< per unknown, may be infinite
  /// Per unknown: no step goes further than the linearization can be believed; empty = as far as the bounds.
  std::vector<double> largest_step{};
  /// Residual at z. False: it cannot be evaluated there.
  std::function<bool(std::span<const double> z, std::vector<double>& residual)> residual;
  /// Derivatives of the residual, one column per unknown, at a z whose residual was asked for before. False: not to be
  /// had.
  std::function<bool(std::span<const double> z, Dense& columns)> jacobian;
  /// In place of `jacobian`, where residuals are linear in further unknowns that are at their best within bounds
  /// wherever a residual is asked for: |r + C s + J p|^2 over [s, p], and how far each s may go. Which of them a bound
  /// holds back changes along a step, and the step knows.
  std::function<bool(std::span<const double> z, LinearizedResidual& model)> linear_model{};
  /// The same by derivatives that were found for much the same residual. They cost nothing, and are used as long as
  /// steps by them go as foreseen; where they foresee no gain there is none.
  std::function<bool(std::span<const double> z, LinearizedResidual& model)> known_model{};
  double matters = 0;             ///< a fall of the squared error that is worth no further step
  std::function<bool()> go_on{};  ///< asked after each trial; false = stop with what was reached
};

struct LeastSquaresResult {
  std::vector<double> z;
  double squared_error = 0;
  int iterations = 0;  ///< accepted steps
  int trials = 0;      ///< max_iterations counts these
  bool converged = false;
  bool flat = false;  ///< no unknown moves the residual at the start: there is no way down to be seen from there
  std::string message;
};

/// Throws nothing of its own. A start outside the bounds is moved to them; a start that cannot be evaluated comes back
/// with squared_error = infinity.
LeastSquaresResult minimize(const LeastSquares& problem, std::vector<double> start, int max_iterations,
                            double tolerance);

}  // namespace hysteron
