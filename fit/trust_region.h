// Decides how a bounded nonlinear least-squares problem is handed to the library (Ceres), and that the library
// is loaded when the first problem comes: whoever does not fit does not wait for it.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace hysteron {

struct LeastSquares {
  int residuals = 0;
  std::vector<double> lower, upper;  ///< per unknown, may be infinite
  /// Residual at z, and, where `jacobian` is not null, its derivatives row by row. False: z cannot be evaluated.
  std::function<bool(const double* z, double* residual, double* jacobian)> evaluate;
  std::function<bool()> go_on;  ///< asked after each iteration; false = stop with what was reached
};

struct TrustRegionResult {
  std::vector<double> z;
  int iterations = 0;
  bool converged = false;
  std::string message;
};

/// Levenberg-Marquardt within bounds. A trial that cannot be evaluated shortens the step. Thread safe.
/// Throws Error "no_solver" if the module with the library cannot be loaded.
TrustRegionResult minimize(const LeastSquares& problem, std::vector<double> start, int max_iterations,
                           double tolerance);

}  // namespace hysteron
