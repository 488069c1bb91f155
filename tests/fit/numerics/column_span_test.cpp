// What some columns explain, taken out of others: against an orthonormal basis of the same columns.
#include "fit/numerics/column_span.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fit/numerics/linear.h"

namespace hysteron {
namespace {

constexpr std::size_t rows = 3000;  // several blocks, the last one short

Dense waves(std::size_t columns) {
  Dense a(rows, columns);
  for (std::size_t j = 0; j < columns; ++j)
    for (std::size_t i = 0; i < rows; ++i)
      a(i, j) = std::pow(10.0, static_cast<double>(j)) * std::cos(0.001 * static_cast<double>(i * (j + 1))) + 0.5;
  return a;
}

std::vector<double> triangle_of(const Dense& a) {
  NormalForm normal(static_cast<int>(a.cols));
  normal.add(a.a, std::vector<double>(a.rows, 0.0));
  return normal.r;
}

TEST(ColumnSpan, TakesOutWhatAnOrthonormalBasisTakesOut) {
  const Dense a = waves(4);
  std::vector<double> x(rows), y(rows);
  for (std::size_t i = 0; i < rows; ++i) {
    x[i] = std::sin(0.003 * static_cast<double>(i)) + 2;
    y[i] = static_cast<double>(i % 7);
  }
  auto x_by_basis = x;
  clear_of(orthonormal_basis(a, 1e-10), x_by_basis.data());
  double* const list[] = {x.data(), y.data()};
  const auto x_before = x;
  const auto explained = ColumnSpan(a, triangle_of(a), 1e-10).clear(list);
  for (std::size_t i = 0; i < rows; ++i) ASSERT_NEAR(x[i], x_by_basis[i], 1e-12) << i;  // rounding of sums of 3000
  // What was taken out is what it says.
  for (std::size_t i = 0; i < rows; ++i) {
    double sum = x[i];
    for (std::size_t j = 0; j < 4; ++j) sum += explained[0][j] * a(i, j);
    ASSERT_NEAR(sum, x_before[i], 1e-10) << i;  // amounts times columns of up to 1000
  }
  for (std::size_t j = 0; j < 4; ++j)
    EXPECT_NEAR(dot(y.data(), a.col(j), rows) / length(a.col(j), rows), 0, 1e-10) << j;
}

TEST(ColumnSpan, AColumnThatOthersExplainIsLeftOut) {
  Dense a = waves(3);
  for (std::size_t i = 0; i < rows; ++i) a(i, 2) = 2 * a(i, 0) - a(i, 1);
  std::vector<double> x(a.col(2), a.col(2) + rows);
  double* const list[] = {x.data()};
  const auto explained = ColumnSpan(a, triangle_of(a), 1e-10).clear(list);
  EXPECT_EQ(explained[0][2], 0);
  EXPECT_LT(length(x.data(), rows), 1e-10 * length(a.col(2), rows));
}

TEST(ColumnSpan, NoColumnsTakeNothing) {
  const Dense none(rows, 0);
  std::vector<double> x(rows, 1.0);
  double* const list[] = {x.data()};
  ColumnSpan(none, {}, 1e-10).clear(list);
  for (const double v : x) EXPECT_EQ(v, 1.0);
}

}  // namespace
}  // namespace hysteron
