#include "models/math/polynomial.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "engine/block/dual.h"

namespace hysteron {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
const std::vector<double> cubic{0.5, -1, 0.25, 2};

double at(double u, double lower = -inf, double upper = inf, double reference = 1, double about = 0) {
  return polynomial::continued<double>(cubic, about, reference, lower, upper, u);
}

TEST(PolynomialModel, IsItsSumOfPowers) {
  for (const double u : {-2.0, 0.0, 0.3, 4.0}) EXPECT_NEAR(at(u), 0.5 - u + 0.25 * u * u + 2 * u * u * u, 1e-13);
}

TEST(PolynomialModel, BeyondItsLimitsItIsItsTangentThere) {
  // p(1) = 1.75, p'(1) = -1 + 0.5 + 6 = 5.5; p(-1) = -0.25, p'(-1) = -1 - 0.5 + 6 = 4.5
  for (const double way : {0.0, 0.1, 3.0}) {
    EXPECT_NEAR(at(1 + way, -1, 1), 1.75 + 5.5 * way, 1e-14);
    EXPECT_NEAR(at(-1 - way, -1, 1), -0.25 - 4.5 * way, 1e-14);
  }
}

TEST(PolynomialModel, ReferenceIsTheInputThatCountsAsOne) {
  EXPECT_NEAR(at(3, -inf, inf, 2), at(1.5), 1e-14);
  EXPECT_NEAR(at(7, -4, 4, 2), at(3.5, -2, 2), 1e-14);
}

TEST(PolynomialModel, PowersAreAboutTheInputThatCountsAsZero) {
  EXPECT_NEAR(at(295, -inf, inf, 2, 292), at(1.5), 1e-14);
  EXPECT_NEAR(at(299, 288, 296, 2, 292), at(3.5, -2, 2), 1e-14);
}

TEST(PolynomialModel, SlopesAreThoseOfTheBranchInUse) {
  const std::vector<Dual> c(cubic.begin(), cubic.end());
  const auto slope = [&](double u) { return polynomial::continued<Dual>(c, 0.0, 1.0, -1.0, 1.0, Dual{u, 1}).rate; };
  EXPECT_NEAR(slope(0.5), -1 + 0.25 + 1.5, 1e-15);
  EXPECT_NEAR(slope(2), 5.5, 1e-15);
  EXPECT_NEAR(slope(-2), 4.5, 1e-15);
}

}  // namespace
}  // namespace hysteron
