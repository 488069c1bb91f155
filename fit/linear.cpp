#include "fit/linear.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace hysteron {
namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

/// One run of the active set method; the members are its state.
class ActiveSet {
 public:
  ActiveSet(const NormalForm& problem, std::span<const double> lower, std::span<const double> upper,
            std::span<const double> near)
      : n_(problem.n),
        r_(Eigen::Map<const Matrix>(problem.r.data(), n_, n_)),
        d_(Eigen::Map<const Vector>(problem.d.data(), n_)),
        lower_(Eigen::Map<const Vector>(lower.data(), n_)),
        upper_(Eigen::Map<const Vector>(upper.data(), n_)),
        near_(Vector::Zero(n_)),
        scale_(Vector::Ones(n_)),
        x_(Vector::Zero(n_)),
        bound_(static_cast<std::size_t>(n_), Bound::inside) {
    for (int j = 0; j < n_; ++j) {
      if (!near.empty()) near_[j] = near[static_cast<std::size_t>(j)];
      const double length = r_.col(j).norm();
      if (length > 0) scale_[j] = length;
    }
    r_ = r_ * scale_.cwiseInverse().asDiagonal();  // unknowns in units of their columns' lengths
    lower_ = lower_.cwiseProduct(scale_);
    upper_ = upper_.cwiseProduct(scale_);
    near_ = near_.cwiseProduct(scale_).cwiseMax(lower_).cwiseMin(upper_);
    tolerance_ = 1e-12 * std::max(d_.norm(), std::numeric_limits<double>::min());
  }

  LinearSolution solve(double rest) {
    LinearSolution s;
    start();
    const int limit = 10 * n_ + 20;
    move_inside();
    while (s.iterations < limit) {
      const int j = to_free();
      if (j < 0) break;
      ++s.iterations;
      const Vector before = x_;
      const auto from = at(j);
      set(j, Bound::inside);
      move_inside();
      // Rounding alone can ask for a column that cannot move: keep it where it was and never ask again.
      if (at(j) == from && (x_ - before).norm() <= 1e-14 * (1 + before.norm())) barred_.push_back(j);
    }
    s.converged = s.iterations < limit;
    s.bound = bound_;
    s.rank = rank_;
    s.squared_error = (d_ - r_ * x_).squaredNorm() + rest;
    const Vector x = x_.cwiseQuotient(scale_);
    s.x.assign(x.data(), x.data() + n_);
    for (int j = 0; j < n_; ++j) {  // exactly at the bound, not a rounding beside it
      auto& value = s.x[static_cast<std::size_t>(j)];
      if (at(j) == Bound::lower) value = lower_[j] / scale_[j];
      if (at(j) == Bound::upper) value = upper_[j] / scale_[j];
    }
    return s;
  }

 private:
  Bound at(int j) const { return bound_[static_cast<std::size_t>(j)]; }
  void set(int j, Bound b) { bound_[static_cast<std::size_t>(j)] = b; }

  /// Everything free first: most problems end there. Else begin from that solution, clamped.
  void start() {
    x_ = near_;
    x_ = free_minimum();
    for (int j = 0; j < n_; ++j) {
      if (lower_[j] == upper_[j] || x_[j] <= lower_[j])
        hold(j, Bound::lower);
      else if (x_[j] >= upper_[j])
        hold(j, Bound::upper);
    }
  }

  void hold(int j, Bound b) {
    set(j, b);
    x_[j] = b == Bound::lower ? lower_[j] : upper_[j];
  }

  /// Minimum over the free unknowns, the others held; of many minima the one nearest to near_.
  Vector free_minimum() {
    std::vector<int> free;
    for (int j = 0; j < n_; ++j)
      if (at(j) == Bound::inside) free.push_back(j);
    Vector target = x_;
    rank_ = 0;
    if (free.empty()) return target;
    for (const int j : free) target[j] = near_[j];
    const Vector b = d_ - r_ * target;
    const Matrix a = r_(Eigen::all, free);
    Eigen::CompleteOrthogonalDecomposition<Matrix> qr;
    qr.setThreshold(1e-10);
    qr.compute(a);
    rank_ = static_cast<int>(qr.rank());
    const Vector step = qr.solve(b);
    for (std::size_t k = 0; k < free.size(); ++k) target[free[k]] += step[static_cast<Eigen::Index>(k)];
    return target;
  }

  /// Walks towards the minimum over the free unknowns; whoever meets a bound on the way is held there.
  void move_inside() {
    for (int guard = 0; guard <= n_; ++guard) {
      const Vector target = free_minimum();
      double alpha = 1;
      int blocking = -1;
      for (int j = 0; j < n_; ++j) {
        if (at(j) != Bound::inside) continue;
        const double limit = target[j] < lower_[j] ? lower_[j] : upper_[j];
        if (target[j] >= lower_[j] && target[j] <= upper_[j]) continue;
        const double fraction = (limit - x_[j]) / (target[j] - x_[j]);
        if (fraction < alpha) {
          alpha = std::max(0.0, fraction);
          blocking = j;
        }
      }
      for (int j = 0; j < n_; ++j)
        if (at(j) == Bound::inside) x_[j] += alpha * (target[j] - x_[j]);
      if (blocking < 0) return;
      hold(blocking, target[blocking] < lower_[blocking] ? Bound::lower : Bound::upper);
    }
  }

  /// The held unknown whose release lowers the error most, -1 if none does (Kuhn-Tucker).
  int to_free() const {
    const Vector slope = r_.transpose() * (d_ - r_ * x_);
    int best = -1;
    double largest = tolerance_;
    for (int j = 0; j < n_; ++j) {
      if (at(j) == Bound::inside || lower_[j] == upper_[j]) continue;
      if (std::find(barred_.begin(), barred_.end(), j) != barred_.end()) continue;
      const double gain = at(j) == Bound::lower ? slope[j] : -slope[j];
      if (gain > largest) {
        largest = gain;
        best = j;
      }
    }
    return best;
  }

  int n_;
  Matrix r_;
  Vector d_, lower_, upper_, near_, scale_, x_;
  std::vector<Bound> bound_;
  std::vector<int> barred_{};
  double tolerance_ = 0;
  int rank_ = 0;
};

}  // namespace

NormalForm::NormalForm(int unknowns)
    : n(unknowns),
      r(static_cast<std::size_t>(unknowns) * static_cast<std::size_t>(unknowns), 0.0),
      d(static_cast<std::size_t>(unknowns), 0.0) {}

void NormalForm::add(std::span<const double> a, std::span<const double> b) {
  const auto rows = static_cast<Eigen::Index>(b.size());
  if (rows == 0) return;
  Matrix m = Matrix::Zero(n + 1 + rows, n + 1);
  m.topLeftCorner(n, n) = Eigen::Map<const Matrix>(r.data(), n, n);
  m.block(0, n, n, 1) = Eigen::Map<const Vector>(d.data(), n);
  m(n, n) = std::sqrt(rest);
  m.block(n + 1, 0, rows, n) = Eigen::Map<const Matrix>(a.data(), rows, n);
  m.block(n + 1, n, rows, 1) = Eigen::Map<const Vector>(b.data(), rows);
  const Matrix upper = Eigen::HouseholderQR<Eigen::Ref<Matrix>>(m).matrixQR().topRows(n + 1);
  Eigen::Map<Matrix>(r.data(), n, n) = upper.topLeftCorner(n, n).triangularView<Eigen::Upper>();
  Eigen::Map<Vector>(d.data(), n) = upper.block(0, n, n, 1);
  rest = upper(n, n) * upper(n, n);
}

LinearSolution solve_bounded(const NormalForm& problem, std::span<const double> lower, std::span<const double> upper,
                             std::span<const double> near) {
  return ActiveSet(problem, lower, upper, near).solve(problem.rest);
}

}  // namespace hysteron
