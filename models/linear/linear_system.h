// Decides the state space form of a transfer function: which states, how they are scaled.
// Does not integrate it. Numerator and denominator are lists of coefficients, highest power of s first.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace hysteron::linear_system {

/// The chain form of a proper transfer function of order n, all states of the size of the input u:
///
///   x_i' = up_i x_(i+1)  (i < n),   x_n' = row . x + up_n u,   y = c . x + d u
///
/// In equilibrium x_1 = u (where the last coefficient of the denominator is positive) and the other states are zero.
template <class T>
struct Chain {
  std::span<T> up, row, c;  ///< [1/s], [1/s], [y/u]; n each
  T* d = nullptr;           ///< [y/u]
};

/// Numbers that a chain of order n needs.
constexpr int chain_size(int order) { return 3 * order + 1; }

/// The chain that lies in `numbers` (chain_size(n) of them).
template <class T>
Chain<T> chain_at(T* numbers, int order) {
  const auto n = static_cast<std::size_t>(order);
  return {{numbers, n}, {numbers + n, n}, {numbers + 2 * n, n}, numbers + 3 * n};
}

/// Rate by which s is scaled so that first and last coefficient are of one size: |a_m/a_n|^(1/(n-m)), m the lowest
/// power that occurs; 1 where only the highest does.
inline double natural_rate(std::span<const double> den) {
  std::size_t last = den.size() - 1;
  while (last > 0 && den[last] == 0) --last;
  return last == 0 ? 1.0 : std::pow(std::fabs(den[last] / den[0]), 1 / static_cast<double>(last));
}

/// Factors (powers of two, the first is 1) that balance rows and columns of the chain's matrix: x_i = factor_i * new
/// x_i. Source: Parlett, Reinsch, Numer. Math. 13 (1969) 293-304, here for a matrix with one upper diagonal and a last
/// row.
inline std::vector<double> balance(std::span<const double> up, std::span<const double> row) {
  const std::size_t n = row.size();
  std::vector<double> f(n, 1.0);
  // Matrix entry (i, i+1) is up_i f_(i+1)/f_i, entry (n, k) is row_k f_k/f_n; the diagonal does not count.
  const auto norms = [&](std::size_t i) {
    double column = 0, across = 0;
    if (i > 0) column += std::fabs(up[i - 1] * f[i] / f[i - 1]);
    if (i + 1 < n) {
      column += std::fabs(row[i] * f[i] / f[n - 1]);
      across += std::fabs(up[i] * f[i + 1] / f[i]);
    } else {
      for (std::size_t k = 0; k + 1 < n; ++k) across += std::fabs(row[k] * f[k] / f[n - 1]);
    }
    return std::pair{column, across};
  };
  bool changed = true;
  for (int sweep = 0; changed && sweep < 100; ++sweep) {
    changed = false;
    for (std::size_t i = 0; i < n; ++i) {
      const auto [column, across] = norms(i);
      if (column == 0 || across == 0) continue;
      const double g = std::exp2(std::round(std::log2(across / column) / 2));
      if ((column * g + across / g) >= 0.95 * (column + across)) continue;
      f[i] *= g;
      changed = true;
    }
  }
  for (std::size_t i = n; i-- > 0;) f[i] /= f[0];
  return f;
}

/// Writes the chain form of num/den. den[0] must not be zero and num must not be longer than den.
inline void realise(std::span<const double> num, std::span<const double> den, Chain<double> chain) {
  const std::size_t n = den.size() - 1;
  const double w = natural_rate(den);
  const auto b = [&](std::size_t power) { return power < num.size() ? num[num.size() - 1 - power] : 0.0; };
  // In s = w p: p^n + alpha_(n-1) p^(n-1) + ... + alpha_0, numerator beta_n p^n + ... + beta_0, companion form.
  *chain.d = b(n) / den[0];
  for (std::size_t k = 0; k < n; ++k) {
    const double shrink = std::pow(w, static_cast<double>(n - k)) * den[0];
    const double alpha = den[n - k] / shrink;
    chain.up[k] = w;
    chain.row[k] = -w * alpha;
    chain.c[k] = b(k) / shrink - alpha * *chain.d;
  }
  const auto f = balance(chain.up, chain.row);
  for (std::size_t k = 0; k < n; ++k) {
    chain.up[k] *= (k + 1 < n ? f[k + 1] : 1.0) / f[k];
    chain.row[k] *= f[k] / f[n - 1];
    chain.c[k] *= f[k];
  }
}

/// dx/dt for the input u.
template <class T>
void derivative(const Chain<const double>& chain, const T* x, const T& u, T* out) {
  const std::size_t n = chain.row.size();
  if (n == 0) return;
  for (std::size_t i = 0; i + 1 < n; ++i) out[i] = chain.up[i] * x[i + 1];
  T last = chain.up[n - 1] * u;
  for (std::size_t i = 0; i < n; ++i) last += chain.row[i] * x[i];
  out[n - 1] = last;
}

/// y for the states x and the input u.
template <class T>
T output(const Chain<const double>& chain, const T* x, const T& u) {
  T y = *chain.d * u;
  for (std::size_t i = 0; i < chain.c.size(); ++i) y += chain.c[i] * x[i];
  return y;
}

/// Solves A x = b, A row by row, b becomes x; false where A is singular but for rounding. Gauss with row pivots, rows
/// scaled by their largest entry. Source: Golub, Van Loan, Matrix Computations, 4th ed. (2013), section 3.4.
inline bool solve(std::vector<double>& a, std::vector<double>& b) {
  using std::abs;
  const std::size_t n = b.size();
  for (std::size_t i = 0; i < n; ++i) {
    double largest = 0;
    for (std::size_t j = 0; j < n; ++j) largest = std::max(largest, abs(a[i * n + j]));
    if (!(largest > 0)) return false;
    for (std::size_t j = 0; j < n; ++j) a[i * n + j] /= largest;
    b[i] /= largest;
  }
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < n; ++i)
      if (abs(a[i * n + k]) > abs(a[pivot * n + k])) pivot = i;
    if (!(abs(a[pivot * n + k]) > 1e-14)) return false;
    for (std::size_t j = k; pivot != k && j < n; ++j) std::swap(a[k * n + j], a[pivot * n + j]);
    std::swap(b[k], b[pivot]);
    for (std::size_t i = k + 1; i < n; ++i) {
      const double share = a[i * n + k] / a[k * n + k];
      for (std::size_t j = k; j < n; ++j) a[i * n + j] -= share * a[k * n + j];
      b[i] -= share * b[k];
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t j = k + 1; j < n; ++j) b[k] -= a[k * n + j] * b[j];
    b[k] /= a[k * n + k];
  }
  return true;
}

}  // namespace hysteron::linear_system
