#include "fit/numerics/levenberg_marquardt.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fit/numerics/linear.h"

namespace hysteron {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double first_damping = 1e-2;
constexpr double least_damping = 1e-12, most_damping = 1e14;  // beyond, a step changes nothing any more
constexpr int most_failures = 30;                             // trials in a row that cannot be evaluated
constexpr double as_foreseen = 0.5;                           // of the gain, by derivatives from elsewhere

double squared(const std::vector<double>& v) { return dot(v.data(), v.data(), v.size()); }

bool all_finite(const std::vector<double>& v) {
  return std::all_of(v.begin(), v.end(), [](double x) { return std::isfinite(x); });
}

/// One minimization; the members are what its steps hand on.
class Search {
 public:
  Search(const LeastSquares& problem, std::vector<double> start, int max_iterations, double tolerance)
      : problem_(problem),
        n_(start.size()),
        max_iterations_(max_iterations),
        tolerance_(tolerance),
        z_(std::move(start)),
        longest_(n_, 0.0),
        known_(problem.known_model != nullptr) {
    for (std::size_t k = 0; k < n_; ++k) z_[k] = std::clamp(z_[k], problem.lower[k], problem.upper[k]);
  }

  LeastSquaresResult run() {
    if (!problem_.residual(z_, residual_) || !all_finite(residual_))
      return end(false, "failed: the start has no residual");
    error_ = squared(residual_);
    while (result_.trials < max_iterations_) {
      if (!linearize()) return end(false, "stopped: no derivatives here");
      result_.flat = result_.iterations == 0 && length(longest_.data(), n_) == 0;
      if (to_gain_ <= std::max(tolerance_ * error_, problem_.matters))
        return end(true, "converged: the error no longer falls");
      switch (improve()) {
        case Step::accepted:
          break;
        case Step::converged:
          return end(true, "converged: the error no longer falls");
        case Step::stuck:
          if (!known_) return end(false, "stopped: no trial lowers the error further");
          known_ = false;
          damping_ = first_damping;
          break;
        case Step::stopped:
          return end(false, "stopped on request");
        case Step::used_up:
          break;
      }
    }
    return end(false, "not converged: the number of iterations is used up");
  }

 private:
  enum class Step { accepted, converged, stuck, stopped, used_up };

  LeastSquaresResult end(bool converged, std::string message) {
    result_.z = z_;
    result_.squared_error = error_;
    result_.converged = converged;
    result_.message = std::move(message);
    return std::move(result_);
  }

  /// Triangular factor of [J r], and what the undamped step inside the bounds would gain.
  bool linearize() {
    LinearizedResidual model;
    known_ = known_ && problem_.known_model(z_, model) && all_finite(model.form.r);
    if (!known_) {
      model.low.clear();
      model.high.clear();
      if (!(problem_.linear_model ? problem_.linear_model(z_, model) : plain_model(model)) || !all_finite(model.form.r))
        return false;
    }
    linear_ = std::move(model.form);
    low_ = std::move(model.low);
    high_ = std::move(model.high);
    inner_ = low_.size();
    const auto n = static_cast<std::size_t>(linear_.n);
    for (std::size_t k = 0; k < n_; ++k) {
      // Of a column what the inner unknowns cannot make up for.
      const double* column = linear_.r.data() + (inner_ + k) * n;
      longest_[k] = std::max(longest_[k], length(column + inner_, n_));
      double low = problem_.lower[k] - z_[k], high = problem_.upper[k] - z_[k];
      if (!problem_.largest_step.empty()) {
        low = std::max(low, -problem_.largest_step[k]);
        high = std::min(high, problem_.largest_step[k]);
      }
      low_.push_back(low);
      high_.push_back(high);
    }
    const auto undamped = solve_bounded(linear_, low_, high_);
    to_gain_ = error_ - undamped.squared_error;
    to_go_ = relative_size(step_of(undamped));
    return true;
  }

  /// No inner unknowns.
  bool plain_model(LinearizedResidual& model) const {
    Dense columns;
    if (!problem_.jacobian(z_, columns) || !all_finite(columns.a)) return false;
    std::vector<double> target(residual_);
    for (double& x : target) x = -x;
    model.form = NormalForm(static_cast<int>(n_));
    model.form.add(columns.a, target);
    return true;
  }

  std::vector<double> step_of(const LinearSolution& solution) const {
    return {solution.x.begin() + static_cast<std::ptrdiff_t>(inner_), solution.x.end()};
  }

  /// The step, and what the linear model says of the squared error behind it.
  std::pair<std::vector<double>, double> damped_step() const {
    NormalForm damped = linear_;
    Dense rows(n_, inner_ + n_);
    for (std::size_t k = 0; k < n_; ++k) rows(k, inner_ + k) = std::sqrt(damping_) * longest_[k];
    damped.add(rows.a, std::vector<double>(n_, 0.0));
    const auto solution = solve_bounded(damped, low_, high_);
    auto p = step_of(solution);
    double predicted = solution.squared_error;
    for (std::size_t k = 0; k < n_; ++k) predicted -= damping_ * std::pow(longest_[k] * p[k], 2);
    return {std::move(p), predicted};
  }

  /// Even the undamped step would gain next to nothing, or lead nowhere: along a flat valley a damped one always looks
  /// so.
  bool near_minimum(double error) const { return to_gain_ <= 100 * tolerance_ * error || to_go_ <= 1e-8; }

  /// Length of a step over that of z, each unknown by its column.
  double relative_size(const std::vector<double>& p) const {
    double step = 0, size = 0;
    for (std::size_t k = 0; k < n_; ++k) {
      step += std::pow(longest_[k] * p[k], 2);
      size += std::pow(longest_[k] * z_[k], 2);
    }
    return size > 0 ? std::sqrt(step / size) : step > 0 ? infinity : 0;
  }

  /// Trials from one linearization until one is accepted.
  Step improve() {
    double growth = 2;
    for (int failures = 0; result_.trials < max_iterations_;) {
      const auto [p, predicted] = damped_step();
      const double foreseen = error_ - predicted;
      if (relative_size(p) <= std::min(1e-10, tolerance_) || !(foreseen > 0))
        return near_minimum(error_) ? Step::converged : Step::stuck;
      auto trial = z_;
      for (std::size_t k = 0; k < n_; ++k) trial[k] = std::clamp(trial[k] + p[k], problem_.lower[k], problem_.upper[k]);
      ++result_.trials;
      std::vector<double> residual;
      const bool evaluated = problem_.residual(trial, residual) && all_finite(residual);
      const double error = evaluated ? squared(residual) : infinity;
      const double ratio = (error_ - error) / foreseen;
      const bool accepted = ratio > 1e-4;
      const double before = error_;
      if (accepted) {
        z_ = std::move(trial);
        residual_ = std::move(residual);
        error_ = error;
        ++result_.iterations;
        damping_ = std::max(least_damping, damping_ * std::max(0.1, 1 - std::pow(2 * ratio - 1, 3)));
      } else {
        failures = evaluated ? 0 : failures + 1;
        damping_ *= evaluated ? growth : 10;  // far outside of what can be simulated: back quickly
        growth *= 2;
      }
      if (problem_.go_on && !problem_.go_on()) return Step::stopped;
      if (known_ && !accepted) return Step::stuck;
      known_ = known_ && ratio > as_foreseen;
      if (accepted) {
        // Where hardly anything was left to gain, another Jacobian would only say so again.
        return before - error <= tolerance_ * before && near_minimum(before) ? Step::converged : Step::accepted;
      }
      if (evaluated && foreseen <= tolerance_ * error_ && std::abs(error_ - error) <= tolerance_ * error_)
        return near_minimum(error_) ? Step::converged : Step::stuck;
      if (damping_ > most_damping || failures > most_failures) return Step::stuck;
    }
    return Step::used_up;
  }

  const LeastSquares& problem_;
  std::size_t n_;
  int max_iterations_;
  double tolerance_;
  std::vector<double> z_, residual_, longest_, low_, high_;
  NormalForm linear_;
  std::size_t inner_ = 0;
  bool known_ = false;  ///< the derivatives are from elsewhere
  double error_ = infinity, to_gain_ = 0, to_go_ = infinity, damping_ = first_damping;
  LeastSquaresResult result_;
};

}  // namespace

LeastSquaresResult minimize(const LeastSquares& problem, std::vector<double> start, int max_iterations,
                            double tolerance) {
  return Search(problem, std::move(start), max_iterations, tolerance).run();
}

}  // namespace hysteron
