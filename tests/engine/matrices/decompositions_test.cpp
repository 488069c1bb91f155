// Exponentials and eigenvalues of small matrices, against closed forms.
#include "engine/matrices/decompositions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hysteron {
namespace {

// A few roundings of numbers of size one.
constexpr double rounding = 1e-14;

TEST(Decompositions, TheExponentialOfARotationIsTheRotation) {
  Eigen::MatrixXd a(2, 2);
  a << 0, -1.3, 1.3, 0;
  const Eigen::MatrixXd e = exponential(a);
  EXPECT_NEAR(e(0, 0), std::cos(1.3), rounding);
  EXPECT_NEAR(e(1, 0), std::sin(1.3), rounding);
  EXPECT_NEAR(e(0, 1), -std::sin(1.3), rounding);
  EXPECT_NEAR(e(1, 1), std::cos(1.3), rounding);
}

TEST(Decompositions, TheExponentialOfAChainOfIntegratorsIsItsPolynomial) {
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(3, 3);
  a(0, 1) = a(1, 2) = 0.7;
  const Eigen::MatrixXd e = exponential(a);
  EXPECT_NEAR(e(0, 2), 0.7 * 0.7 / 2, rounding);
  EXPECT_NEAR(e(0, 1), 0.7, rounding);
  EXPECT_EQ(e(2, 0), 0);
}

TEST(Decompositions, EigenvaluesAreThoseOfTheCharacteristicPolynomial) {
  // s^2 + 2 0.1 s + 1: -0.1 +- j sqrt(0.99); and a pole at -3 of its own.
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(3, 3);
  a(0, 1) = 1;
  a(1, 0) = -1;
  a(1, 1) = -0.2;
  a(2, 2) = -3;
  const Eigen::VectorXcd values = eigenvalues_of(a);
  ASSERT_EQ(values.size(), 3);
  for (const std::complex<double> s :
       {std::complex<double>(-0.1, std::sqrt(0.99)), {-0.1, -std::sqrt(0.99)}, {-3, 0}}) {
    double nearest = 1;
    for (const auto& value : values) nearest = std::min(nearest, std::abs(value - s));
    EXPECT_LT(nearest, 10 * rounding) << s;
  }
}

TEST(Decompositions, PairsSatisfyTheirEquation) {
  Eigen::MatrixXd a(3, 3);
  a << 1, 2, 0, -4, 0.5, 1, 0, 3, -2;
  const EigenPairs pairs = eigen_pairs(a);
  const Eigen::MatrixXcd left = a * pairs.vectors, right = pairs.vectors * pairs.values.asDiagonal();
  EXPECT_LT((left - right).norm(), 10 * rounding * a.norm());
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(pairs.vectors.col(i).norm(), 1, rounding);
}

}  // namespace
}  // namespace hysteron
