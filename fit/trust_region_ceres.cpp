// The module that is loaded when a problem is to be solved (trust_region.cpp): Ceres, and the twenty libraries behind
// it, which would cost every start of the program milliseconds.
#include <ceres/ceres.h>
#include <glog/logging.h>

#include <cmath>

#include "fit/trust_region.h"

namespace hysteron {
namespace {

class Cost : public ceres::CostFunction {
 public:
  explicit Cost(const LeastSquares& problem) : problem_(problem) {
    set_num_residuals(problem.residuals);
    mutable_parameter_block_sizes()->push_back(static_cast<int>(problem.lower.size()));
  }
  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    return problem_.evaluate(parameters[0], residuals, jacobians == nullptr ? nullptr : jacobians[0]);
  }

 private:
  const LeastSquares& problem_;
};

class Asking : public ceres::IterationCallback {
 public:
  explicit Asking(const LeastSquares& problem) : problem_(problem) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary&) override {
    return !problem_.go_on || problem_.go_on() ? ceres::SOLVER_CONTINUE : ceres::SOLVER_TERMINATE_SUCCESSFULLY;
  }

 private:
  const LeastSquares& problem_;
};

/// The library speaks to stderr through glog; what it has to say comes back in the summary.
void silence() { FLAGS_minloglevel = google::GLOG_FATAL; }

TrustRegionResult solve(const LeastSquares& problem, std::vector<double> start, int max_iterations, double tolerance) {
  silence();
  ceres::Problem p;
  p.AddParameterBlock(start.data(), static_cast<int>(start.size()));
  p.AddResidualBlock(new Cost(problem), nullptr, start.data());
  for (int i = 0; i < static_cast<int>(start.size()); ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (std::isfinite(problem.lower[k])) p.SetParameterLowerBound(start.data(), i, problem.lower[k]);
    if (std::isfinite(problem.upper[k])) p.SetParameterUpperBound(start.data(), i, problem.upper[k]);
  }
  Asking asking(problem);
  ceres::Solver::Options o;
  o.linear_solver_type = ceres::DENSE_QR;
  o.max_num_iterations = max_iterations;
  o.max_num_consecutive_invalid_steps = 25;
  o.function_tolerance = tolerance;
  o.gradient_tolerance = 0;  // depends on units; the other two do not
  o.parameter_tolerance = tolerance;
  o.num_threads = 1;
  o.logging_type = ceres::SILENT;
  o.minimizer_progress_to_stdout = false;
  o.callbacks.push_back(&asking);
  ceres::Solver::Summary summary;
  ceres::Solve(o, &p, &summary);
  TrustRegionResult result;
  result.z = std::move(start);
  result.iterations = static_cast<int>(summary.iterations.size());
  result.converged = summary.termination_type == ceres::CONVERGENCE;
  result.message = summary.termination_type == ceres::CONVERGENCE ? "converged: the error no longer falls"
                   : summary.termination_type == ceres::NO_CONVERGENCE
                       ? "not converged: the number of iterations is used up"
                   : summary.termination_type == ceres::USER_SUCCESS ? "stopped on request"
                                                                     : "failed: " + summary.message;
  return result;
}

}  // namespace

extern "C" void hysteron_minimize(const LeastSquares* problem, const std::vector<double>* start, int max_iterations,
                                  double tolerance, TrustRegionResult* result) {
  *result = solve(*problem, *start, max_iterations, tolerance);
}

}  // namespace hysteron
