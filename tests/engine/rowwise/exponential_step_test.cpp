// The Runge-Kutta step that takes a linear part exactly: against closed forms, and how its error falls elsewhere.
#include "engine/rowwise/exponential_step.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hysteron {
namespace {

// A lag of 1 us in front of one of 3 s, driven by 2 + 3 s - 4 s^2, s of the row of 10 ms: what is quick follows at
// once, and what is slow integrates.
TEST(ExponentialStep, IsExactForALinearSystemUnderAParabolaHoweverStiff) {
  const double h = 0.01, quick = 1e-6, slow = 3;
  const auto drive = [](double s) { return 2 + 3 * s - 4 * s * s; };
  ExponentialStep step(2, {-1 / quick, 0, 1 / slow, -1 / slow});
  EXPECT_NEAR(step.growth(), -1 / slow, 1e-9);
  double x[2] = {5, -1};
  step(x, h, true, [&](double s, const double* at, double* rate) {
    rate[0] = (drive(s) - at[0]) / quick;
    rate[1] = (at[0] - at[1]) / slow;
  });
  // Behind the transient, which adds (5 - 2) 1e-6/3, x0 = u - q u' + q^2 u''.
  const double bend = -8 / (h * h), rise = 3 / h;
  EXPECT_NEAR(x[0], drive(1) - quick * (rise + bend * h) + quick * quick * bend, 1e-9);
  // x1 of the same input less its lag, by variation of constants: integral of exp(-(h - t)/3) x0/3, by Simpson in 1000.
  double integral = 0;
  const int n = 1000;
  for (int k = 0; k <= n; ++k) {
    const double s = static_cast<double>(k) / n, t = s * h;
    const double x0 = drive(s) - quick * (rise + bend * t) + quick * quick * bend;
    integral += (k == 0 || k == n ? 1 : k % 2 == 1 ? 4 : 2) * std::exp(-(h - t) / slow) * x0 / slow * h / (3 * n);
  }
  const double jump = 5 - (2 - quick * rise + quick * quick * bend);
  EXPECT_NEAR(x[1], -std::exp(-h / slow) + integral + jump * quick / slow * std::exp(-h / slow), 1e-11);
}

TEST(ExponentialStep, AlongALineIsTheSameInTwoEvaluations) {
  const auto rates = [](double s, const double* at, double* rate) {
    rate[0] = 3 - 7 * s - 400 * at[0] + 20 * at[1];
    rate[1] = 5 * at[0] - 0.2 * at[1] - at[2];
    rate[2] = 1 + 2 * s + 80 * at[0] - 30 * at[2];
  };
  const std::vector<double> slopes{-400, 20, 0, 5, -0.2, -1, 80, 0, -30};
  for (const bool whole : {true, false}) {
    ExponentialStep one(3, slopes), other(3, slopes);
    double x[3] = {1, -2, 0.5}, y[3] = {1, -2, 0.5};
    for (const double h : {0.02, 0.02, 0.3}) {
      one(x, h, whole, rates);
      other.along_a_line(y, h, whole, rates);
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(x[i], y[i], 1e-13) << h;
    }
  }
}

TEST(ExponentialStep, KeepsWhatNothingMoves) {
  ExponentialStep step(2, {0, 1, 0, 0});
  double x[2] = {1, 0.1};
  step(x, 0.3, true, [](double, const double* at, double* rate) {
    rate[0] = at[1];
    rate[1] = 0;
  });
  EXPECT_DOUBLE_EQ(x[0], 1.03);
  EXPECT_DOUBLE_EQ(x[1], 0.1);
}

// x' = -50 x + sin(t) - 3 x^3 and a slope that is off: order four.
TEST(ExponentialStep, IsOfOrderFourElsewhere) {
  const auto behind = [](int steps, double slope) {
    ExponentialStep step(1, {slope});
    const double h = 0.2 / steps;
    double x = 1;
    for (int k = 0; k < steps; ++k)
      step(&x, h, k % 2 == 0, [&](double s, const double* at, double* rate) {
        rate[0] = -50 * at[0] + std::sin((k + s) * h) - 3 * at[0] * at[0] * at[0];
      });
    return x;
  };
  const double exact = behind(4000, -50);
  const double coarse = behind(20, -45) - exact, fine = behind(40, -45) - exact;
  EXPECT_NEAR(std::log2(std::abs(coarse / fine)), 4, 0.5);
}

}  // namespace
}  // namespace hysteron
