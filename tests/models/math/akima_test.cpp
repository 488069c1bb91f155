#include "models/math/akima.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace hysteron {
namespace {

double curve(const std::vector<double>& x, const std::vector<double>& y, double at) {
  std::ptrdiff_t k = 0;
  const auto n = static_cast<std::ptrdiff_t>(x.size());
  while (k + 2 < n && at >= x[static_cast<std::size_t>(k + 1)]) ++k;
  return akima::on_piece(
      n, k, at, [&](std::ptrdiff_t i) { return x[static_cast<std::size_t>(i)]; },
      [&](std::ptrdiff_t i) { return y[static_cast<std::size_t>(i)]; });
}

TEST(AkimaModel, ReproducesParabolasOfEvenPointsAndLinesOfAny) {
  // Even points on a parabola: secants rise evenly, each slope is the mean of its two neighbours, which is the true
  // one.
  const std::vector<double> x{0, 1, 2, 3, 4}, uneven{0, 0.3, 2, 2.1, 7};
  std::vector<double> square, line;
  for (const double at : x) square.push_back(at * at - 3 * at);
  for (const double at : uneven) line.push_back(2 - 0.7 * at);
  for (double at = 0; at <= 4; at += 0.05) EXPECT_NEAR(curve(x, square, at), at * at - 3 * at, 1e-14);
  for (double at = 0; at <= 7; at += 0.05) EXPECT_NEAR(curve(uneven, line, at), 2 - 0.7 * at, 1e-14);
}

TEST(AkimaModel, AgreesWithHermitePolynomialsOfItsSlopes) {
  // Computed from Eqs. 1 and 9 of the paper and the four Hermite polynomials, in another program.
  const std::vector<double> x{0, 1, 2.5, 3, 4.2, 6}, y{0, 2, -1, 0.5, 0.5, 3};
  EXPECT_NEAR(curve(x, y, 0.4), 1.258666666666667, 1e-14);
  EXPECT_NEAR(curve(x, y, 1.7), 0.5446913580246917, 1e-14);
  EXPECT_NEAR(curve(x, y, 2.9), 0.3159751552795029, 1e-14);
  EXPECT_NEAR(curve(x, y, 3.3), 0.5566524490919098, 1e-14);
  EXPECT_NEAR(curve(x, y, 5.5), 2.080354894862044, 1e-14);
}

TEST(AkimaModel, AnOutlierBendsNoMoreThanItsNeighbours) {
  const std::vector<double> x{0, 1, 2, 3, 4, 5, 6, 7, 8}, y{0, 0, 0, 0, 1, 0, 0, 0, 0};
  EXPECT_EQ(curve(x, y, 1.5), 0);
  EXPECT_EQ(curve(x, y, 6.5), 0);
  EXPECT_NEAR(curve(x, y, 3.5), 0.5, 1e-14) << "flat at both ends";
}

}  // namespace
}  // namespace hysteron
