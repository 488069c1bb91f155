#include "fit/numerics/levenberg_marquardt.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

#include "tests/fit/lab.h"

namespace hysteron {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

using Model = std::function<bool(std::span<const double>, std::vector<double>&)>;

/// Bounds open unless given; slopes by central differences, good to 1e-9.
LeastSquares problem(const Model& model, std::size_t n) {
  LeastSquares p;
  p.lower.assign(n, -infinity);
  p.upper.assign(n, infinity);
  p.residual = model;
  p.jacobian = [model, n](std::span<const double> z, Dense& columns) {
    std::vector<double> up, down;
    for (std::size_t k = 0; k < n; ++k) {
      std::vector<double> x(z.begin(), z.end());
      const double h = 1e-5 * std::max(1.0, std::abs(z[k]));
      x[k] = z[k] + h;
      if (!model(x, up)) return false;
      x[k] = z[k] - h;
      if (!model(x, down)) return false;
      if (k == 0) columns = Dense(up.size(), n);
      for (std::size_t i = 0; i < up.size(); ++i) columns(i, k) = (up[i] - down[i]) / (2 * h);
    }
    return true;
  };
  return p;
}

bool rosenbrock(std::span<const double> z, std::vector<double>& r) {
  r = {10 * (z[1] - z[0] * z[0]), 1 - z[0]};
  return true;
}

TEST(LevenbergMarquardt, FollowsTheValleyOfRosenbrockToItsEnd) {
  const auto found = minimize(problem(rosenbrock, 2), {-1.2, 1}, 100, 1e-12);
  EXPECT_TRUE(found.converged) << found.message;
  EXPECT_NEAR(found.z[0], 1, 1e-8);  // the minimum is zero at (1, 1); slopes are good to 1e-9
  EXPECT_NEAR(found.z[1], 1, 1e-8);
  EXPECT_LT(found.trials, 40);  // MINPACK's lmder needs 21 evaluations (Moré, Garbow, Hillstrom 1981)
}

/// The residual near any point by these derivatives, wherever they were found.
void knows(LeastSquares& p, const Dense& columns) {
  p.known_model = [residual = p.residual, columns](std::span<const double> z, LinearizedResidual& model) {
    std::vector<double> r;
    if (!residual(z, r)) return false;
    for (double& x : r) x = -x;
    model.form = NormalForm(static_cast<int>(z.size()));
    model.form.add(columns.a, r);
    return true;
  };
}

/// How often the problem was asked for derivatives of its own.
std::shared_ptr<int> counted(LeastSquares& p) {
  auto count = std::make_shared<int>(0);
  p.jacobian = [own = p.jacobian, count](std::span<const double> z, Dense& columns) {
    ++*count;
    return own(z, columns);
  };
  return count;
}

TEST(LevenbergMarquardt, DerivativesThatAreKnownSaveItsOwn) {
  // 2 z0 + z1 = 4, z0 - z1 = -1, z0 + z1 = 3, nearly: derivatives from elsewhere are a fifth too large, as where the
  // noise was taken for smaller.
  const auto lines = [](std::span<const double> z, std::vector<double>& r) {
    r = {2 * z[0] + z[1] - 4, z[0] - z[1] + 1, z[0] + z[1] - 3 + 0.01 * z[0] * z[0]};
    return true;
  };
  auto p = problem(lines, 2);
  p.matters = 1e-4;  // as where somebody says what is worth a step: to the last digit only its own derivatives lead
  const auto own = counted(p);
  const auto alone = minimize(p, {0, 0}, 50, 1e-12);
  EXPECT_GT(*own, 0);
  *own = 0;
  Dense columns(3, 2);
  columns.a = {2.4, 1.2, 1.2, 1.2, -1.2, 1.2};
  knows(p, columns);
  const auto found = minimize(p, {0, 0}, 50, 1e-12);
  EXPECT_EQ(*own, 0);
  EXPECT_TRUE(found.converged) << found.message;
  EXPECT_NEAR(found.squared_error, alone.squared_error, 2 * p.matters);
}

TEST(LevenbergMarquardt, DerivativesThatLeadNowhereAreLeft) {
  auto p = problem(rosenbrock, 2);
  const auto own = counted(p);
  Dense columns(2, 2);  // of (-1.2, 1), which are wrong everywhere else, with one sign turned
  columns.a = {24, 1, 10, 0};
  knows(p, columns);
  const auto found = minimize(p, {-1.2, 1}, 100, 1e-12);
  EXPECT_GT(*own, 0);
  EXPECT_TRUE(found.converged) << found.message;
  EXPECT_NEAR(found.z[0], 1, 1e-8);
  EXPECT_NEAR(found.z[1], 1, 1e-8);
}

TEST(LevenbergMarquardt, KnownDerivativesThatCannotBeUsedAreNone) {
  auto p = problem(rosenbrock, 2);
  p.known_model = [](std::span<const double>, LinearizedResidual&) { return false; };
  EXPECT_NEAR(minimize(p, {-1.2, 1}, 100, 1e-12).z[0], 1, 1e-8);
}

TEST(LevenbergMarquardt, ComesDownWhereTheJacobianIsSingularAtTheMinimum) {
  // Powell's singular function: the minimum is zero at the origin.
  const auto powell = [](std::span<const double> z, std::vector<double>& r) {
    r = {z[0] + 10 * z[1], std::sqrt(5.0) * (z[2] - z[3]), std::pow(z[1] - 2 * z[2], 2),
         std::sqrt(10.0) * std::pow(z[0] - z[3], 2)};
    return true;
  };
  const auto found = minimize(problem(powell, 4), {3, -1, 0, 1}, 200, 1e-12);
  EXPECT_LT(found.squared_error, 1e-12);
}

TEST(LevenbergMarquardt, StaysInsideItsBoundsAndFindsTheBestPointOnThem) {
  // With z0 <= 0.5 the best point of Rosenbrock's valley is (0.5, 0.25): error (1 - 0.5)^2.
  auto p = problem(rosenbrock, 2);
  p.upper[0] = 0.5;
  p.residual = [](std::span<const double> z, std::vector<double>& r) {
    EXPECT_LE(z[0], 0.5);
    return rosenbrock(z, r);
  };
  const auto found = minimize(p, {-1.2, 1}, 100, 1e-12);
  EXPECT_TRUE(found.converged) << found.message;
  EXPECT_EQ(found.z[0], 0.5);
  EXPECT_NEAR(found.z[1], 0.25, 1e-8);
  EXPECT_NEAR(found.squared_error, 0.25, 1e-12);
}

TEST(LevenbergMarquardt, AStartOutsideIsMovedToTheBounds) {
  auto p = problem(rosenbrock, 2);
  p.lower = {0, 0};
  p.upper = {2, 2};
  const auto found = minimize(p, {-5, 9}, 100, 1e-12);
  EXPECT_NEAR(found.z[0], 1, 1e-6);
}

TEST(LevenbergMarquardt, TrialsThatOverflowAreRejectedAndNothingElse) {
  // exp(z t) overflows for z above 177 at t = 4, and the first steps from a poor start go far beyond.
  int failed = 0;
  const Model growth = [&](std::span<const double> z, std::vector<double>& r) {
    r.clear();
    for (int i = 0; i <= 40; ++i) r.push_back(std::exp(z[0] * 0.1 * i) - std::exp(0.5 * 0.1 * i));
    for (const double x : r)
      if (!std::isfinite(x)) ++failed;
    return true;
  };
  auto p = problem(growth, 1);
  const auto found = minimize(p, {-30}, 100, 1e-12);
  EXPECT_TRUE(found.converged) << found.message;
  EXPECT_NEAR(found.z[0], 0.5, 1e-8);
  EXPECT_GT(failed, 0);  // else this test tests nothing
}

TEST(LevenbergMarquardt, TrialsThatCannotBeEvaluatedShortenTheStep) {
  const auto wall = [](std::span<const double> z, std::vector<double>& r) {
    if (z[0] > 1.001) return false;  // nothing can be simulated just behind the minimum
    return rosenbrock(z, r);
  };
  const auto found = minimize(problem(wall, 2), {-1.2, 1}, 200, 1e-10);
  EXPECT_NEAR(found.z[0], 1, 1e-4);
}

TEST(LevenbergMarquardt, NoTrialStepsFurtherThanItIsAllowed) {
  auto p = problem(rosenbrock, 2);
  p.largest_step = {0.1, infinity};
  std::vector<double> seen{-1.2};
  p.go_on = [] { return true; };
  p.residual = [&](std::span<const double> z, std::vector<double>& r) {
    double nearest = infinity;
    for (const double x : seen) nearest = std::min(nearest, std::abs(z[0] - x));
    EXPECT_LE(nearest, 0.1 + 1e-12);  // each trial starts at a point that was seen before
    seen.push_back(z[0]);
    return rosenbrock(z, r);
  };
  const auto found = minimize(p, {-1.2, 1}, 200, 1e-12);
  EXPECT_NEAR(found.z[0], 1, 1e-6);
}

TEST(LevenbergMarquardt, AStartThatCannotBeEvaluatedIsAnAnswer) {
  const auto never = [](std::span<const double>, std::vector<double>&) { return false; };
  const auto found = minimize(problem(never, 2), {1, 2}, 10, 1e-9);
  EXPECT_FALSE(found.converged);
  EXPECT_EQ(found.squared_error, infinity);
}

TEST(LevenbergMarquardt, StopsWhenAskedWithTheBestSoFar) {
  auto p = problem(rosenbrock, 2);
  int calls = 0;
  p.go_on = [&] { return ++calls < 5; };
  const auto found = minimize(p, {-1.2, 1}, 100, 1e-12);
  EXPECT_EQ(found.trials, 5);
  EXPECT_FALSE(found.converged);
  EXPECT_LT(found.squared_error, 24.2);  // that of the start
}

TEST(LevenbergMarquardt, WhatGainsLessThanMattersIsNotGone) {
  // Linear: from 9 + 4 to the 4 that no z takes away. One step, shortened by the damping of 1/100, leaves 3/101 of the
  // way, and 9/101^2 to be gained.
  const auto plain = [](std::span<const double> z, std::vector<double>& r) {
    r = {z[0] - 3, 2};
    return true;
  };
  auto p = problem(plain, 1);
  p.matters = 8.9;
  EXPECT_NEAR(minimize(p, {0}, 100, 1e-12).z[0], 3, 0.04) << "nine are to be gained";
  p.matters = 9.1;
  const auto found = minimize(p, {0}, 100, 1e-12);
  EXPECT_EQ(found.trials, 0);
  EXPECT_TRUE(found.converged);
  EXPECT_EQ(found.z[0], 0);
}

TEST(LevenbergMarquardt, AnUnknownThatChangesNothingStaysWhereItIs) {
  const auto blind = [](std::span<const double> z, std::vector<double>& r) {
    r = {z[0] - 3, 2 * (z[0] - 3)};
    return true;
  };
  const auto found = minimize(problem(blind, 2), {0, 7}, 50, 1e-12);
  EXPECT_TRUE(found.converged);
  EXPECT_NEAR(found.z[0], 3, 1e-9);
  EXPECT_EQ(found.z[1], 7);
}

TEST(LevenbergMarquardt, DoesNotCareAboutTheUnitsOfItsUnknowns) {
  // Rosenbrock in micrometres and kilovolts: the same trials.
  const auto scaled = [](std::span<const double> z, std::vector<double>& r) {
    return rosenbrock(std::vector<double>{z[0] * 1e6, z[1] * 1e-3}, r);
  };
  auto p = problem(scaled, 2);
  p.jacobian = [](std::span<const double> z, Dense& columns) {
    columns = Dense(2, 2);
    columns.a = {-20 * z[0] * 1e6 * 1e6, -1e6, 10e-3, 0};
    return true;
  };
  const auto plain = minimize(problem(rosenbrock, 2), {-1.2, 1}, 100, 1e-10);
  const auto found = minimize(p, {-1.2e-6, 1e3}, 100, 1e-10);
  EXPECT_EQ(found.trials, plain.trials);
  EXPECT_NEAR(found.z[0] * 1e6, 1, 1e-7);
}

}  // namespace
}  // namespace hysteron
