#include "fit/numerics/linear.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/diagram/stop.h"
#include "fit/numerics/dense.h"
#include "fit/numerics/triangle.h"

namespace hysteron {
namespace {

/// One run of the active set method; the members are its state.
class ActiveSet {
 public:
  ActiveSet(const NormalForm& problem, std::span<const double> lower, std::span<const double> upper,
            std::span<const double> near)
      : n_(static_cast<std::size_t>(problem.n)),
        r_(n_, n_),
        d_(problem.d),
        lower_(n_),
        upper_(n_),
        near_(n_),
        scale_(n_, 1.0),
        bound_(n_, Bound::inside) {
    for (std::size_t j = 0; j < n_; ++j) {
      // Unknowns in units of their columns' lengths.
      const double* column = problem.r.data() + j * n_;
      if (const double l = length(column, n_); l > 0) scale_[j] = l;
      for (std::size_t i = 0; i < n_; ++i) r_(i, j) = column[i] / scale_[j];
      lower_[j] = lower[j] * scale_[j];
      upper_[j] = upper[j] * scale_[j];
      near_[j] = std::min(std::max((near.empty() ? 0.0 : near[j]) * scale_[j], lower_[j]), upper_[j]);
    }
    x_ = near_;
    tolerance_ = 1e-12 * std::max(length(d_.data(), n_), std::numeric_limits<double>::min());
  }

  LinearSolution solve(double rest) {
    LinearSolution s;
    start();
    const int limit = 10 * static_cast<int>(n_) + 20;
    move_inside();
    while (s.iterations < limit) {
      const auto j = to_free();
      if (j == n_) break;
      ++s.iterations;
      const auto before = x_;
      const auto from = bound_[j];
      bound_[j] = Bound::inside;
      move_inside();
      // Rounding alone can ask for a column that cannot move: keep it where it was and never ask again.
      if (bound_[j] == from && same(before)) barred_.push_back(j);
    }
    s.converged = s.iterations < limit;
    s.bound = bound_;
    s.rank = rank_;
    const auto error = remainder(x_);
    s.squared_error = dot(error.data(), error.data(), n_) + rest;
    for (std::size_t j = 0; j < n_; ++j) {
      double value = x_[j] / scale_[j];  // exactly at the bound where it is held, not a rounding beside it
      if (bound_[j] == Bound::lower) value = lower_[j] / scale_[j];
      if (bound_[j] == Bound::upper) value = upper_[j] / scale_[j];
      s.x.push_back(value);
    }
    return s;
  }

 private:
  bool same(const std::vector<double>& before) const {
    for (std::size_t j = 0; j < n_; ++j)
      if (std::abs(x_[j] - before[j]) > 1e-14 * (1 + std::abs(before[j]))) return false;
    return true;
  }

  /// d - R x
  std::vector<double> remainder(const std::vector<double>& x) const {
    auto e = d_;
    for (std::size_t j = 0; j < n_; ++j)
      for (std::size_t i = 0; i < n_; ++i) e[i] -= r_(i, j) * x[j];
    return e;
  }

  /// Everything free first: most problems end there. Else begin from that solution, clamped.
  void start() {
    x_ = free_minimum();
    for (std::size_t j = 0; j < n_; ++j) {
      if (lower_[j] == upper_[j] || x_[j] <= lower_[j])
        hold(j, Bound::lower);
      else if (x_[j] >= upper_[j])
        hold(j, Bound::upper);
    }
  }

  void hold(std::size_t j, Bound b) {
    bound_[j] = b;
    x_[j] = b == Bound::lower ? lower_[j] : upper_[j];
  }

  /// Minimum over the free unknowns, the others held; of many minima the one nearest to near_.
  std::vector<double> free_minimum() {
    std::vector<std::size_t> free;
    for (std::size_t j = 0; j < n_; ++j)
      if (bound_[j] == Bound::inside) free.push_back(j);
    auto target = x_;
    rank_ = 0;
    if (free.empty()) return target;
    for (const auto j : free) target[j] = near_[j];
    Dense a(n_, free.size());
    for (std::size_t k = 0; k < free.size(); ++k) std::copy(r_.col(free[k]), r_.col(free[k]) + n_, a.col(k));
    const auto step = minimum_norm(a, remainder(target), 1e-10);
    rank_ = step.rank;
    for (std::size_t k = 0; k < free.size(); ++k) target[free[k]] += step.x[k];
    return target;
  }

  /// Walks towards the minimum over the free unknowns; whoever meets a bound on the way is held there.
  void move_inside() {
    for (std::size_t guard = 0; guard <= n_; ++guard) {
      const auto target = free_minimum();
      double alpha = 1;
      std::size_t blocking = n_;
      for (std::size_t j = 0; j < n_; ++j) {
        if (bound_[j] != Bound::inside || (target[j] >= lower_[j] && target[j] <= upper_[j])) continue;
        const double limit = target[j] < lower_[j] ? lower_[j] : upper_[j];
        const double fraction = (limit - x_[j]) / (target[j] - x_[j]);
        if (fraction < alpha) {
          alpha = std::max(0.0, fraction);
          blocking = j;
        }
      }
      for (std::size_t j = 0; j < n_; ++j)
        if (bound_[j] == Bound::inside) x_[j] += alpha * (target[j] - x_[j]);
      if (blocking == n_) return;
      hold(blocking, target[blocking] < lower_[blocking] ? Bound::lower : Bound::upper);
    }
  }

  /// The held unknown whose release lowers the error most, n if none does (Kuhn-Tucker).
  std::size_t to_free() const {
    const auto error = remainder(x_);
    std::size_t best = n_;
    double largest = tolerance_;
    for (std::size_t j = 0; j < n_; ++j) {
      if (bound_[j] == Bound::inside || lower_[j] == upper_[j]) continue;
      if (std::find(barred_.begin(), barred_.end(), j) != barred_.end()) continue;
      const double slope = dot(r_.col(j), error.data(), n_);
      const double gain = bound_[j] == Bound::lower ? slope : -slope;
      if (gain > largest) {
        largest = gain;
        best = j;
      }
    }
    return best;
  }

  std::size_t n_;
  Dense r_;
  std::vector<double> d_, lower_, upper_, near_, scale_, x_;
  std::vector<Bound> bound_;
  std::vector<std::size_t> barred_{};
  double tolerance_ = 0;
  int rank_ = 0;
};

}  // namespace

NormalForm::NormalForm(int unknowns)
    : n(unknowns),
      r(static_cast<std::size_t>(unknowns) * static_cast<std::size_t>(unknowns), 0.0),
      d(static_cast<std::size_t>(unknowns), 0.0) {}

void NormalForm::add(std::span<const double> a, std::span<const double> b) {
  constexpr std::size_t at_once = 128;  // rows of a panel that stays in the cache
  const std::size_t rows = b.size(), m = static_cast<std::size_t>(n);
  Dense triangle(m + 1, m + 1);  // b as the last column
  for (std::size_t j = 0; j < m; ++j) std::copy_n(r.data() + j * m, m, triangle.col(j));
  std::copy(d.begin(), d.end(), triangle.col(m));
  triangle(m, m) = std::sqrt(rest);
  std::vector<double> panel(at_once * (m + 1));
  LookUp look_up;
  for (std::size_t first = 0; first < rows; first += at_once) {
    look_up();
    const std::size_t count = std::min(at_once, rows - first);
    for (std::size_t j = 0; j < m; ++j) std::copy_n(a.data() + j * rows + first, count, panel.data() + j * count);
    std::copy_n(b.data() + first, count, panel.data() + m * count);
    add_to_triangle(triangle.a.data(), m + 1, panel.data(), count);
  }
  for (std::size_t j = 0; j < m; ++j) std::copy_n(triangle.col(j), m, r.data() + j * m);
  std::copy_n(triangle.col(m), m, d.begin());
  rest = triangle(m, m) * triangle(m, m);
}

LinearSolution solve_bounded(const NormalForm& problem, std::span<const double> lower, std::span<const double> upper,
                             std::span<const double> near) {
  return ActiveSet(problem, lower, upper, near).solve(problem.rest);
}

}  // namespace hysteron
