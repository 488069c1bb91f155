// A mass with dry friction row by row, against closed forms and against Moreau's stepping in steps a thousand times as
// short, which knows neither turns nor modes.
#include "blocks/mechanics/step_with_friction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "models/random.h"

namespace hysteron {
namespace {

using blocks::ForceIn;
using blocks::MotionState;
using blocks::StepWithFriction;
using Law = friction::Params<double>;

// k = 100 N/m, 10 N, 1 kg from 0.95 m: about -0.1 m, then 0.1 m, by turns; it sticks at 0.05 m, which needs 5 N.
TEST(StepWithFriction, TakesTheSameAmplitudeEachHalfCycleAndSticks) {
  StepWithFriction step({.mass = 1, .stiffness = 100, .coulomb = 10, .breakaway = 10});
  for (const double h : {0.0311, 0.0007, 0.17}) {  // in the last, two radians, it turns within most rows
    MotionState<double> s{0.95, 0};
    for (int k = 1; k * h < 3; ++k) {
      s = step(s, {0}, {0}, h);
      const double t = k * h, half = M_PI / 10;
      const int n = std::min(5, static_cast<int>(t / half));
      const double side = n % 2 == 0 ? 1 : -1, turn = side * (0.95 - 0.2 * n);
      const double expected = n == 5 ? 0.05 : 0.1 * side + (turn - 0.1 * side) * std::cos(10 * (t - n * half));
      // The turns are found to rest_speed, 1 nm/s in 1/10 s each; Runge-Kutta's (10 h)^5/120 a row where those are
      // short.
      ASSERT_NEAR(s.position, expected, h < 0.001 ? 1e-7 : 5e-9) << h << " s, row " << k;
    }
    EXPECT_EQ(s.velocity, 0);
  }
}

// 5 N/s: sticks until 3 N at 0.6 s, within a row; then v = (2.5 (t^2 - 0.36) - 2 (t - 0.6))/0.5.
TEST(StepWithFriction, BreaksAwayWithinARow) {
  StepWithFriction step({.mass = 0.5, .coulomb = 2, .breakaway = 3});
  MotionState<double> s{0.3, 0};
  const double h = 0.07;
  for (int k = 0; k < 20; ++k) {
    s = step(s, {5 * h * k}, {5 * h * (k + 1)}, h);
    const double t = h * (k + 1);
    ASSERT_NEAR(s.velocity, t <= 0.6 ? 0 : (2.5 * (t * t - 0.36) - 2 * (t - 0.6)) / 0.5, 1e-12) << t;
    if (t <= 0.6) {
      ASSERT_EQ(s.position, 0.3);
    }
  }
}

// Fifty radians a row: it follows the spring, the friction behind, and stays where the force turns.
TEST(StepWithFriction, InLongRowsIsAPlay) {
  StepWithFriction step({.mass = 1, .damping = 100, .stiffness = 1e4, .coulomb = 20, .breakaway = 20});
  MotionState<double> s{0, 0};
  const std::vector<double> force{0, 10, 100, 300, 300, 290, 262, 200, -100};
  const std::vector<double> expected{0, 0, 0.008, 0.028, 0.028, 0.028, 0.028, 0.022, -0.008};
  for (std::size_t k = 1; k < force.size(); ++k) {
    s = step(s, {force[k - 1]}, {force[k]}, 0.5);
    // It is behind by the damping over the stiffness, 10 ms of the ramp, less where it has stopped.
    EXPECT_NEAR(s.position, expected[k], 0.02 * std::abs(force[k] - force[k - 1]) / 1e4 + 1e-12) << k;
  }
}

TEST(StepWithFriction, WithoutFrictionIsTheMassItself) {
  StepWithFriction step({.mass = 2, .damping = 3, .stiffness = 50});
  MotionState<double> s{0.1, -0.2};
  for (int k = 0; k < 40; ++k) s = step(s, {0}, {0}, 0.05);
  const double a = 0.75, w = std::sqrt(25 - a * a), t = 2;
  EXPECT_NEAR(s.position, std::exp(-a * t) * (0.1 * std::cos(w * t) + (-0.2 + a * 0.1) / w * std::sin(w * t)), 1e-12);
}

/// Behind each row. The velocity behind a step is the one at which the friction of that step is in its set:
/// Moreau, in: Nonsmooth Mechanics and Applications (1988) 1-82.
std::vector<double> by_moreau(const Law& law, const std::vector<double>& force, double h, int steps) {
  std::vector<double> places;
  double x = 0, v = 0;
  const double dt = h / steps;
  for (std::size_t k = 1; k < force.size(); ++k) {
    for (int i = 0; i < steps; ++i) {
      const double f = force[k - 1] + (force[k] - force[k - 1]) * (i + 0.5) / steps;
      const double free = v + dt * (f - law.damping * v - law.stiffness * x - law.stiffening * x * x * x) / law.mass;
      const double held = dt * friction::sliding_force(law, v) / law.mass;
      v = std::copysign(std::max(0.0, std::abs(free) - held), free);
      x += dt * v;
    }
    places.push_back(x);
  }
  return places;
}

std::vector<double> by_rows(const Law& law, const std::vector<double>& force, double h, int parts) {
  StepWithFriction step(law);
  std::vector<double> places;
  MotionState<double> s{0, 0};
  for (std::size_t k = 1; k < force.size(); ++k) {
    const double rise = (force[k] - force[k - 1]) / parts;
    for (int i = 0; i < parts; ++i)
      s = step(s, {force[k - 1] + rise * i}, {i + 1 == parts ? force[k] : force[k - 1] + rise * (i + 1)}, h / parts);
    places.push_back(s.position);
  }
  return places;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

class FallingFriction : public testing::TestWithParam<int> {};
TEST_P(FallingFriction, IsThatOfFineSteps) {
  const auto seed = static_cast<std::uint64_t>(GetParam());
  const auto uniform = [&](std::uint64_t k) { return random::uniform(seed, 7, k); };
  const Law law{.mass = 0.4,
                .damping = 3 + 10 * uniform(0),
                .stiffness = GetParam() % 4 == 3 ? 0 : 500 + 3000 * uniform(1),
                .coulomb = 0.1 + 0.3 * uniform(2),
                .breakaway = 0.5 + 0.2 * uniform(3),
                .stribeck_velocity = 0.02 + 0.05 * uniform(4),
                .stiffening = GetParam() % 3 == 0 ? 3e8 * uniform(5) : 0,
                .falls_by = GetParam() % 2 == 0 ? 2.0 : 1.0};
  std::vector<double> force{0};
  for (std::uint64_t k = 0; k < 400; ++k)
    force.push_back(2 * std::sin(0.05 * static_cast<double>(k)) + (k % 50 < 10 ? 0.0 : 1.5 * uniform(100 + k / 10)));
  constexpr double h = 1e-3;
  const auto fine = by_moreau(law, force, h, 1000), finer = by_moreau(law, force, h, 2000);
  const auto whole = by_rows(law, force, h, 8), half = by_rows(law, force, h, 16);
  const double span = *std::max_element(finer.begin(), finer.end()) - *std::min_element(finer.begin(), finer.end());
  const double of_moreau = largest_difference(fine, finer), of_rows = largest_difference(whole, half);
  // The former's error is as long as its steps, so what is left is what halving them changed; the rows' is less.
  EXPECT_LE(largest_difference(half, finer), 2 * of_moreau + of_rows);
  EXPECT_LT(of_moreau, 2e-3 * span);
  EXPECT_LT(of_rows, 2e-4 * span);
}
INSTANTIATE_TEST_SUITE_P(Seeds, FallingFriction, testing::Range(0, 12));

}  // namespace
}  // namespace hysteron
