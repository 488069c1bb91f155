#include "fit/levenberg_marquardt.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fit/linear.h"

namespace hysteron {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double first_damping = 1e-2;
constexpr double least_damping = 1e-12, most_damping = 1e14;  // beyond, a step changes nothing any more
constexpr int most_failures = 30;                             // trials in a row that cannot be evaluated

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
        longest_(n_, 0.0) {
    for (std::size_t k = 0; k < n_; ++k) z_[k] = std::clamp(z_[k], problem.lower[k], problem.upper[k]);
  }

  LeastSquaresResult run() {
    if (!problem_.residual(z_, residual_) || !all_finite(residual_))
      return end(false, "failed: the start has no residual");
    error_ = squared(residual_);
    while (result_.trials < max_iterations_) {
      if (!linearize()) return end(false, "stopped: no derivatives here");
      if (to_gain_ <= tolerance_ * error_) return end(true, "converged: the error no longer falls");
      switch (improve()) {
        case Step::accepted:
          break;
        case Step::converged:
          return end(true, "converged: the error no longer falls");
        case Step::stuck:
          return end(false, "stopped: no trial lowers the error further");
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
    Dense columns;
    if (!problem_.jacobian(z_, columns) || !all_finite(columns.a)) return false;
    for (std::size_t k = 0; k < n_; ++k) longest_[k] = std::max(longest_[k], length(columns.col(k), columns.rows));
    std::vector<double> target(residual_);
    for (double& x : target) x = -x;
    linear_ = NormalForm(static_cast<int>(n_));
    linear_.add(columns.a, target);
    low_.resize(n_);
    high_.resize(n_);
    for (std::size_t k = 0; k < n_; ++k) {
      low_[k] = problem_.lower[k] - z_[k];
      high_[k] = problem_.upper[k] - z_[k];
      if (problem_.largest_step.empty()) continue;
      low_[k] = std::max(low_[k], -problem_.largest_step[k]);
      high_[k] = std::min(high_[k], problem_.largest_step[k]);
    }
    const auto undamped = solve_bounded(linear_, low_, high_);
    to_gain_ = error_ - undamped.squared_error;
    to_go_ = relative_size(undamped.x);
    return true;
  }

  std::vector<double> damped_step() const {
    NormalForm damped = linear_;
    Dense rows(n_, n_);
    for (std::size_t k = 0; k < n_; ++k) rows(k, k) = std::sqrt(damping_) * longest_[k];
    damped.add(rows.a, std::vector<double>(n_, 0.0));
    return solve_bounded(damped, low_, high_).x;
  }

  /// |J p + r|^2
  double predicted(const std::vector<double>& p) const {
    double sum = linear_.rest;
    for (std::size_t i = 0; i < n_; ++i) {
      double e = linear_.d[i];
      for (std::size_t k = i; k < n_; ++k) e -= linear_.r[k * n_ + i] * p[k];
      sum += e * e;
    }
    return sum;
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
      const auto p = damped_step();
      const double foreseen = error_ - predicted(p);
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
  double error_ = infinity, to_gain_ = 0, to_go_ = infinity, damping_ = first_damping;
  LeastSquaresResult result_;
};

}  // namespace

LeastSquaresResult minimize(const LeastSquares& problem, std::vector<double> start, int max_iterations,
                            double tolerance) {
  return Search(problem, std::move(start), max_iterations, tolerance).run();
}

}  // namespace hysteron
