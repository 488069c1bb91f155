#include "fit/numerics/triangle.h"

#include <array>
#include <cmath>

namespace hysteron {
namespace {

constexpr std::size_t side = 8;  // sums side by side, in the same order whatever the processor can add at once

using Sums = std::array<double, side>;

[[gnu::always_inline]] inline double total(const Sums& s) {
  return ((s[0] + s[4]) + (s[1] + s[5])) + ((s[2] + s[6]) + (s[3] + s[7]));
}

[[gnu::always_inline]] inline double product(const double* v, const double* x, std::size_t rows) {
  Sums sum{};
  std::size_t i = 0;
  for (; i + side <= rows; i += side)
    for (std::size_t k = 0; k < side; ++k) sum[k] += v[i + k] * x[i + k];
  for (std::size_t k = 0; i < rows; ++i, ++k) sum[k] += v[i] * x[i];
  return total(sum);
}

/// The reflection (1, v) with factor tau on columns x and y, whose entries in the triangle are a and b.
[[gnu::always_inline]] inline void reflect(const double* v, double tau, double* x, double& a, std::size_t rows) {
  const double f = tau * (a + product(v, x, rows));
  a -= f;
  for (std::size_t i = 0; i < rows; ++i) x[i] -= f * v[i];
}

[[gnu::always_inline]] inline void add_rows(double* r, std::size_t n, double* panel, std::size_t rows) {
  for (std::size_t j = 0; j < n; ++j) {
    double* v = panel + j * rows;
    double& diagonal = r[j * n + j];
    const double below = product(v, v, rows);
    if (below == 0) continue;
    const double norm = std::sqrt(diagonal * diagonal + below);
    const double beta = diagonal > 0 ? -norm : norm;
    const double scale = diagonal - beta;
    const double tau = -scale / beta;
    for (std::size_t i = 0; i < rows; ++i) v[i] /= scale;
    for (std::size_t k = j + 1; k < n; ++k) reflect(v, tau, panel + k * rows, r[k * n + j], rows);
    diagonal = beta;
  }
}

// No fused multiplication: it would round otherwise than other processors do.
[[gnu::target("avx2"), gnu::optimize("fp-contract=off")]] void add_rows_avx2(double* r, std::size_t n, double* panel,
                                                                             std::size_t rows) {
  add_rows(r, n, panel, rows);
}

}  // namespace

void add_to_triangle(double* r, std::size_t n, double* panel, std::size_t rows) {
  static const bool wide = __builtin_cpu_supports("avx2");
  wide ? add_rows_avx2(r, n, panel, rows) : add_rows(r, n, panel, rows);
}

}  // namespace hysteron
