#include "fit/numerics/dense.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "fit/numerics/triangle.h"

namespace hysteron {
namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;
using Decomposition = Eigen::CompleteOrthogonalDecomposition<Matrix>;

Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }

}  // namespace

double dot(const double* a, const double* b, std::size_t n) {
  return n == 0 ? 0 : Eigen::Map<const Vector>(a, index(n)).dot(Eigen::Map<const Vector>(b, index(n)));
}

double length(const double* a, std::size_t n) { return std::sqrt(dot(a, a, n)); }

void triangularize(Dense& m) {
  Dense r(m.cols, m.cols);
  add_to_triangle(r.a.data(), m.cols, m.a.data(), m.rows);
  m = std::move(r);
}

Dense inverse_of_triangle(const Dense& r) {
  Dense x(r.cols, r.cols);
  for (std::size_t j = 0; j < r.cols; ++j)
    for (std::size_t i = j + 1; i-- > 0;) {
      double sum = i == j ? 1 : 0;
      for (std::size_t k = i + 1; k <= j; ++k) sum -= r(i, k) * x(k, j);
      x(i, j) = sum / r(i, i);
    }
  return x;
}

MinimumNorm minimum_norm(const Dense& a, std::span<const double> b, double tolerance) {
  MinimumNorm result;
  result.x.assign(a.cols, 0.0);
  if (a.cols == 0 || a.rows == 0) return result;
  Decomposition qr(index(a.rows), index(a.cols));
  qr.setThreshold(tolerance);
  qr.compute(Eigen::Map<const Matrix>(a.a.data(), index(a.rows), index(a.cols)));
  result.rank = static_cast<int>(qr.rank());
  if (result.rank == 0) return result;
  Eigen::Map<Vector>(result.x.data(), index(a.cols)) = qr.solve(Eigen::Map<const Vector>(b.data(), index(b.size())));
  return result;
}

Dense orthonormal_basis(const Dense& a, double tolerance) {
  // Gram-Schmidt, the longest remainder first, each taken out twice ("twice is enough", Kahan and Parlett).
  Dense left = a, q(a.rows, 0);
  std::vector<bool> used(a.cols, false);
  for (std::size_t j = 0; j < a.cols; ++j) {
    const double l = length(left.col(j), a.rows);
    for (std::size_t i = 0; i < a.rows && l > 0; ++i) left(i, j) /= l;
  }
  for (;;) {
    std::size_t best = a.cols;
    double longest = tolerance;
    for (std::size_t j = 0; j < a.cols; ++j)
      if (const double l = used[j] ? 0 : length(left.col(j), a.rows); l > longest) longest = l, best = j;
    if (best == a.cols) return q;
    used[best] = true;
    double* x = left.col(best);
    clear_of(q, x);
    const double l = length(x, a.rows);
    Dense one(a.rows, 1);
    for (std::size_t i = 0; i < a.rows; ++i) one(i, 0) = x[i] / l;
    for (std::size_t j = 0; j < a.cols; ++j)
      if (!used[j]) clear_of(one, left.col(j));
    q.a.insert(q.a.end(), one.a.begin(), one.a.end());
    ++q.cols;
  }
}

namespace {

bool is_held(std::span<const double> sigma, std::size_t k) { return k < sigma.size() && std::isfinite(sigma[k]); }

/// Columns that are held, or the others, each times its sigma.
Dense chosen(const Dense& a, std::span<const double> sigma, bool held) {
  Dense some(a.rows, 0);
  for (std::size_t j = 0; j < a.cols; ++j) {
    if (is_held(sigma, j) != held) continue;
    some.a.insert(some.a.end(), a.col(j), a.col(j) + a.rows);
    if (held)
      for (std::size_t i = 0; i < a.rows; ++i) some(i, some.cols) *= sigma[j];
    ++some.cols;
  }
  return some;
}

}  // namespace

// Beside what nothing holds a column counts by what is left of it. With a = U S V' of these, each times its sigma, the
// least is b' (1 - U S^2/(1 + S^2) U') b, the square of b - U f U' b with f = 1 - 1/sqrt(1 + S^2) (ridge regression:
// Hoerl and Kennard, Technometrics 12 (1970) 55).
Dense held_basis(const Dense& a, std::span<const double> sigma, double tolerance) {
  Dense held = chosen(a, sigma, true);
  if (held.cols == 0) return orthonormal_basis(a, tolerance);
  Dense basis = orthonormal_basis(chosen(a, sigma, false), tolerance);
  for (std::size_t j = 0; j < held.cols; ++j) clear_of(basis, held.col(j));
  const Singular singular = singular_values(held);
  for (std::size_t k = 0; k < held.cols; ++k) {
    const double s = singular.s[k];
    if (!(s > tolerance)) break;
    const double share = std::sqrt(1 - 1 / std::sqrt(1 + s * s));
    for (std::size_t i = 0; i < a.rows; ++i) {
      double u = 0;
      for (std::size_t j = 0; j < held.cols; ++j) u += held(i, j) * singular.v(j, k);
      basis.a.push_back(share * u / s);
    }
    ++basis.cols;
  }
  return basis;
}

std::vector<double> held_solution(const Dense& a, std::span<const double> sigma, std::span<const double> b,
                                  double tolerance) {
  std::size_t held = 0;
  for (std::size_t j = 0; j < a.cols; ++j) held += is_held(sigma, j) ? 1 : 0;
  if (held == 0) return minimum_norm(a, b, tolerance).x;
  Dense more(a.rows + held, a.cols);
  std::vector<double> right(b.begin(), b.end());
  right.resize(more.rows, 0.0);
  std::size_t row = a.rows;
  for (std::size_t j = 0; j < a.cols; ++j) {
    std::copy(a.col(j), a.col(j) + a.rows, more.col(j));
    if (is_held(sigma, j)) more(row++, j) = 1 / sigma[j];
  }
  return minimum_norm(more, right, tolerance).x;
}

void clear_of(const Dense& q, double* x) {
  // The columns are orthogonal, so taking them out one after the other is the same and keeps rounding smaller.
  for (std::size_t j = 0; j < q.cols; ++j) {
    const double f = dot(q.col(j), x, q.rows);
    for (std::size_t i = 0; i < q.rows; ++i) x[i] -= f * q(i, j);
  }
}

Singular singular_values(Dense a) {
  const std::size_t n = a.cols;
  Dense v(n, n);
  for (std::size_t j = 0; j < n; ++j) v(j, j) = 1;
  const auto rotate = [](double* x, double* y, std::size_t rows, double c, double s) {
    for (std::size_t i = 0; i < rows; ++i) {
      const double p = x[i], q = y[i];
      x[i] = c * p - s * q;
      y[i] = s * p + c * q;
    }
  };
  for (bool again = true, sweep = false; again; sweep = true) {
    again = false;
    for (std::size_t p = 0; p + 1 < n; ++p)
      for (std::size_t q = p + 1; q < n; ++q) {
        const double pp = dot(a.col(p), a.col(p), a.rows), qq = dot(a.col(q), a.col(q), a.rows);
        const double pq = dot(a.col(p), a.col(q), a.rows);
        if (!(std::abs(pq) > 1e-15 * std::sqrt(pp * qq)) || pq == 0) continue;
        again = again || !sweep || std::abs(pq) > 1e-13 * std::sqrt(pp * qq);
        const double zeta = (qq - pp) / (2 * pq);
        const double t = (zeta >= 0 ? 1.0 : -1.0) / (std::abs(zeta) + std::hypot(1.0, zeta));
        const double c = 1 / std::hypot(1.0, t);
        rotate(a.col(p), a.col(q), a.rows, c, c * t);
        rotate(v.col(p), v.col(q), n, c, c * t);
      }
  }
  std::vector<double> s(n);
  for (std::size_t j = 0; j < n; ++j) s[j] = length(a.col(j), a.rows);
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return s[i] > s[j]; });
  Singular result{std::vector<double>(n), Dense(n, n)};
  for (std::size_t j = 0; j < n; ++j) {
    result.s[j] = s[order[j]];
    std::copy(v.col(order[j]), v.col(order[j]) + n, result.v.col(j));
  }
  return result;
}

}  // namespace hysteron
