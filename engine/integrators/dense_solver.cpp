#include "engine/integrators/dense_solver.h"

#include <nvector/nvector_serial.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace hysteron {
namespace {

constexpr int longest_fixed = 10;

using Factorize = bool (*)(double* a, sunindextype n, sunindextype* exchanged, double* reciprocal);
using Solve = void (*)(const double* a, sunindextype n, const sunindextype* exchanged, const double* reciprocal,
                       double* b);

struct Content {
  sunindextype n = 0;
  std::vector<sunindextype> exchanged;  // per column: the row that was exchanged with the diagonal's
  std::vector<double> reciprocal;       // of the diagonal of U
  Factorize factorize = nullptr;
  Solve solve = nullptr;
};

// Columns of a one after the other; n = size<fixed> is known at compile time unless fixed = 0.
template <int fixed>
constexpr sunindextype size(sunindextype n) {
  return fixed > 0 ? fixed : n;
}

/// PA = LU in place, L below the diagonal; false if a pivot is zero or not a number.
template <int fixed>
bool factorize(double* a, sunindextype n_, sunindextype* exchanged, double* reciprocal) {
  const auto n = size<fixed>(n_);
  for (sunindextype k = 0; k < n; ++k) {
    double* column = a + k * n;
    sunindextype p = k;
    for (sunindextype i = k + 1; i < n; ++i)
      if (std::abs(column[i]) > std::abs(column[p])) p = i;
    if (!(std::abs(column[p]) > 0)) return false;
    exchanged[k] = p;
    if (p != k)
      for (sunindextype j = 0; j < n; ++j) std::swap(a[j * n + k], a[j * n + p]);
    reciprocal[k] = 1 / column[k];
    for (sunindextype i = k + 1; i < n; ++i) column[i] *= reciprocal[k];
    for (sunindextype j = k + 1; j < n; ++j) {
      double* right = a + j * n;
      const double factor = right[k];
      if (factor == 0) continue;
#pragma GCC ivdep
      for (sunindextype i = k + 1; i < n; ++i) right[i] -= factor * column[i];
    }
  }
  return true;
}

template <int fixed>
void solve(const double* a, sunindextype n_, const sunindextype* exchanged, const double* reciprocal, double* b_) {
  const auto n = size<fixed>(n_);
  double kept[fixed > 0 ? fixed : 1];
  double* b = b_;
  for (sunindextype k = 0; k < n; ++k) std::swap(b_[k], b_[exchanged[k]]);
  if constexpr (fixed > 0) {
    b = kept;
#pragma GCC unroll 10
    for (int i = 0; i < fixed; ++i) b[i] = b_[i];
  }
#pragma GCC unroll 10
  for (sunindextype k = 0; k < n - 1; ++k)
#pragma GCC unroll 10
    for (sunindextype i = k + 1; i < n; ++i) b[i] -= a[k * n + i] * b[k];
#pragma GCC unroll 10
  for (sunindextype k = n - 1; k >= 0; --k) {
    b[k] *= reciprocal[k];
#pragma GCC unroll 10
    for (sunindextype i = 0; i < k; ++i) b[i] -= a[k * n + i] * b[k];
  }
  if constexpr (fixed > 0) {
#pragma GCC unroll 10
    for (int i = 0; i < fixed; ++i) b_[i] = b[i];
  }
}

template <int... n>
constexpr auto table(std::integer_sequence<int, n...>) {
  return std::array{std::pair<Factorize, Solve>(&factorize<n>, &solve<n>)...};
}

Content& content(SUNLinearSolver solver) { return *static_cast<Content*>(solver->content); }

SUNLinearSolver_Type type(SUNLinearSolver) { return SUNLINEARSOLVER_DIRECT; }

int set_up(SUNLinearSolver solver, SUNMatrix a) {
  auto& c = content(solver);
  return c.factorize(SM_DATA_D(a), c.n, c.exchanged.data(), c.reciprocal.data()) ? 0 : 1;
}

int solve_for(SUNLinearSolver solver, SUNMatrix a, N_Vector x, N_Vector b, realtype) {
  auto& c = content(solver);
  if (x != b) N_VScale(1, b, x);
  c.solve(SM_DATA_D(a), c.n, c.exchanged.data(), c.reciprocal.data(), NV_DATA_S(x));
  return 0;
}

int destroy(SUNLinearSolver solver) {
  delete &content(solver);
  solver->content = nullptr;
  SUNLinSolFreeEmpty(solver);
  return 0;
}

}  // namespace

SUNLinearSolver make_dense_solver(sunindextype n, SUNContext context) {
  static constexpr auto for_size = table(std::make_integer_sequence<int, longest_fixed + 1>());
  const SUNLinearSolver made = SUNLinSolNewEmpty(context);
  if (made == nullptr) return nullptr;
  const auto count = static_cast<std::size_t>(n);
  const auto& functions = for_size[n <= longest_fixed ? count : 0];
  made->content = new Content{.n = n,
                              .exchanged = std::vector<sunindextype>(count),
                              .reciprocal = std::vector<double>(count),
                              .factorize = functions.first,
                              .solve = functions.second};
  made->ops->gettype = &type;
  made->ops->setup = &set_up;
  made->ops->solve = &solve_for;
  made->ops->free = &destroy;
  return made;
}

}  // namespace hysteron
