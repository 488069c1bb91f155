#include "fit/numerics/linear.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/fit/lab.h"

namespace hysteron {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

struct Problem {
  std::vector<double> a, b;  ///< column by column
  int rows = 0, n = 0;
};

Problem random_problem(int rows, int n, unsigned seed) {
  lab::Noise random(seed);
  Problem p;
  p.rows = rows;
  p.n = n;
  for (int i = 0; i < rows * n; ++i) p.a.push_back(random());
  for (int i = 0; i < rows; ++i) p.b.push_back(random() + (n > 0 ? p.a[static_cast<std::size_t>(i)] : 0));
  return p;
}

NormalForm compressed(const Problem& p) {
  NormalForm f(p.n);
  f.add(p.a, p.b);
  return f;
}

double squared_error(const Problem& p, const std::vector<double>& x) {
  double sum = 0;
  for (int i = 0; i < p.rows; ++i) {
    double e = p.b[static_cast<std::size_t>(i)];
    for (int j = 0; j < p.n; ++j) e -= p.a[static_cast<std::size_t>(j * p.rows + i)] * x[static_cast<std::size_t>(j)];
    sum += e * e;
  }
  return sum;
}

/// Least error over all ways of holding unknowns at bounds whose free solution stays inside: exhaustive, by normal
/// equations.
double by_enumeration(const Problem& p, const std::vector<double>& lower, const std::vector<double>& upper) {
  double best = unbounded;
  int ways = 1;
  for (int j = 0; j < p.n; ++j) ways *= 3;
  for (int way = 0; way < ways; ++way) {
    std::vector<double> x(static_cast<std::size_t>(p.n), 0.0);
    std::vector<int> free;
    bool possible = true;
    for (int j = 0, code = way; j < p.n; ++j, code /= 3) {
      const auto k = static_cast<std::size_t>(j);
      if (code % 3 == 0) free.push_back(j);
      if (code % 3 == 1) x[k] = lower[k];
      if (code % 3 == 2) x[k] = upper[k];
      possible = possible && std::isfinite(x[k]);
    }
    if (!possible) continue;
    // Gauss-Jordan on the normal equations of the free ones.
    const std::size_t m = free.size();
    std::vector<std::vector<double>> g(m, std::vector<double>(m + 1, 0.0));
    for (std::size_t i = 0; i < m; ++i)
      for (int row = 0; row < p.rows; ++row) {
        const double ai = p.a[static_cast<std::size_t>(free[i] * p.rows + row)];
        double rest = p.b[static_cast<std::size_t>(row)];
        for (int j = 0; j < p.n; ++j)
          rest -= p.a[static_cast<std::size_t>(j * p.rows + row)] * x[static_cast<std::size_t>(j)];
        for (std::size_t j = 0; j < m; ++j) g[i][j] += ai * p.a[static_cast<std::size_t>(free[j] * p.rows + row)];
        g[i][m] += ai * rest;
      }
    for (std::size_t c = 0; c < m; ++c)
      for (std::size_t i = 0; i < m; ++i)
        if (i != c) {
          const double f = g[i][c] / g[c][c];
          for (std::size_t j = c; j <= m; ++j) g[i][j] -= f * g[c][j];
        }
    for (std::size_t i = 0; i < m; ++i) {
      const auto k = static_cast<std::size_t>(free[i]);
      x[k] = g[i][m] / g[i][i];
      possible = possible && x[k] >= lower[k] - 1e-12 && x[k] <= upper[k] + 1e-12;
    }
    if (possible) best = std::min(best, squared_error(p, x));
  }
  return best;
}

TEST(BoundedLeastSquares, AgreesWithTheBestOfAllActiveSets) {
  for (unsigned seed = 1; seed <= 60; ++seed) {
    const int n = 1 + static_cast<int>(seed % 5);
    const auto p = random_problem(12, n, seed);
    std::vector<double> lower(static_cast<std::size_t>(n), 0.0), upper(static_cast<std::size_t>(n), unbounded);
    if (seed % 3 == 0) upper.assign(static_cast<std::size_t>(n), 0.3);
    if (seed % 4 == 0) lower[0] = -unbounded;
    const auto s = solve_bounded(compressed(p), lower, upper);
    EXPECT_TRUE(s.converged) << seed;
    const double best = by_enumeration(p, lower, upper);
    // Both are least squares of twelve rows near one: rounding of the normal equations is far below 1e-9.
    EXPECT_NEAR(squared_error(p, s.x), best, 1e-9) << seed;
    EXPECT_NEAR(s.squared_error, best, 1e-9) << seed;
    for (std::size_t j = 0; j < s.x.size(); ++j) {
      EXPECT_GE(s.x[j], lower[j]);
      EXPECT_LE(s.x[j], upper[j]);
      if (s.bound[j] == Bound::lower) {
        EXPECT_EQ(s.x[j], lower[j]);
      }
      if (s.bound[j] == Bound::upper) {
        EXPECT_EQ(s.x[j], upper[j]);
      }
    }
  }
}

TEST(BoundedLeastSquares, RowsAddedBlockByBlockGiveTheSameAnswer) {
  const auto p = random_problem(40, 4, 7);
  NormalForm blocks(4);
  for (int first = 0; first < 40; first += 10) {
    std::vector<double> a, b;
    for (int j = 0; j < 4; ++j)
      for (int i = first; i < first + 10; ++i) a.push_back(p.a[static_cast<std::size_t>(j * 40 + i)]);
    for (int i = first; i < first + 10; ++i) b.push_back(p.b[static_cast<std::size_t>(i)]);
    blocks.add(a, b);
  }
  const std::vector<double> low(4, -unbounded), high(4, unbounded);
  const auto whole = solve_bounded(compressed(p), low, high), parts = solve_bounded(blocks, low, high);
  for (std::size_t j = 0; j < 4; ++j) EXPECT_NEAR(whole.x[j], parts.x[j], 1e-12);
  EXPECT_NEAR(whole.squared_error, parts.squared_error, 1e-12);
}

TEST(BoundedLeastSquares, OfDependentColumnsTheSolutionNearestToTheStartIsTaken) {
  // Two equal columns: only the sum is fixed. Starting from (3, 1) and a sum of 6, the nearest is (4, 2).
  NormalForm f(2);
  const std::vector<double> a{1, 1, 1, 1, 1, 1}, b{6, 6, 6}, near{3, 1};
  f.add(a, b);
  const std::vector<double> low(2, -unbounded), high(2, unbounded);
  const auto s = solve_bounded(f, low, high, near);
  EXPECT_EQ(s.rank, 1);
  EXPECT_NEAR(s.x[0], 4, 1e-12);
  EXPECT_NEAR(s.x[1], 2, 1e-12);
}

TEST(BoundedLeastSquares, AColumnOfZerosStaysAtItsStart) {
  NormalForm f(2);
  const std::vector<double> a{1, 2, 3, 0, 0, 0}, b{2, 4, 6}, near{0, 5};
  f.add(a, b);
  const std::vector<double> low(2, 0.0), high(2, unbounded);
  const auto s = solve_bounded(f, low, high, near);
  EXPECT_NEAR(s.x[0], 2, 1e-12);
  EXPECT_NEAR(s.x[1], 5, 1e-12);
}

TEST(BoundedLeastSquares, ColumnsOfVeryDifferentSizeAreTreatedAlike) {
  auto p = random_problem(20, 3, 11);
  const std::vector<double> low(3, -unbounded), high(3, unbounded);
  const auto plain = solve_bounded(compressed(p), low, high);
  for (int i = 0; i < 20; ++i) p.a[static_cast<std::size_t>(i)] *= 1e-9;
  const auto scaled = solve_bounded(compressed(p), low, high);
  EXPECT_NEAR(scaled.x[0] * 1e-9, plain.x[0], 1e-12);
  EXPECT_NEAR(scaled.x[1], plain.x[1], 1e-12);
}

TEST(BoundedLeastSquares, NoUnknownsLeaveTheWholeError) {
  NormalForm f(0);
  const std::vector<double> b{3, 4};
  f.add({}, b);
  EXPECT_NEAR(solve_bounded(f, {}, {}).squared_error, 25, 1e-12);
}

}  // namespace
}  // namespace hysteron
