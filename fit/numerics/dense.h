// Decides how small dense linear algebra is done: the only file of fit/ that includes Eigen, so that it is compiled
// once. Internal to fit/. Matrices are column by column.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace hysteron {

struct Dense {
  std::size_t rows = 0, cols = 0;
  std::vector<double> a;

  Dense() = default;
  Dense(std::size_t r, std::size_t c) : rows(r), cols(c), a(r * c, 0.0) {}
  double& operator()(std::size_t i, std::size_t j) { return a[j * rows + i]; }
  double operator()(std::size_t i, std::size_t j) const { return a[j * rows + i]; }
  double* col(std::size_t j) { return a.data() + j * rows; }
  const double* col(std::size_t j) const { return a.data() + j * rows; }
};

double dot(const double* a, const double* b, std::size_t n);
double length(const double* a, std::size_t n);

/// Replaces m by its triangular factor, cols x cols (Householder).
void triangularize(Dense& m);

/// Inverse of an upper triangular matrix with no zero on its diagonal.
Dense inverse_of_triangle(const Dense& r);

struct MinimumNorm {
  std::vector<double> x;
  int rank = 0;
};
/// min |a x - b|, of many solutions the shortest; columns that others explain to `tolerance` count as dependent.
MinimumNorm minimum_norm(const Dense& a, std::span<const double> b, double tolerance);

/// Orthonormal basis of the columns of `a`, each first scaled to length one; dependent ones are left out.
Dense orthonormal_basis(const Dense& a, double tolerance);

/// Columns Q of which clear_of(Q, b) leaves the least of |b - a x|^2 + sum (x/sigma)^2, as a length squared; sigma:
/// one per column, infinity where nothing holds it (orthonormal_basis() where nothing holds any).
Dense held_basis(const Dense& a, std::span<const double> sigma, double tolerance);
/// That x.
std::vector<double> held_solution(const Dense& a, std::span<const double> sigma, std::span<const double> b,
                                  double tolerance);

/// x - Q Q' x for orthogonal columns Q; x has q.rows numbers.
void clear_of(const Dense& q, double* x);

struct Singular {
  std::vector<double> s;  ///< largest first
  Dense v;                ///< right singular vectors, columns
};
/// Singular values by one-sided Jacobi rotations (Hestenes 1958): small ones are as exact as large ones.
Singular singular_values(Dense a);

}  // namespace hysteron
