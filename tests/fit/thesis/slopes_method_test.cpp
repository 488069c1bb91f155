#include "fit/thesis/slopes_method.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "engine/diagram/error.h"
#include "models/hysteresis/prandtl_ishlinskii.h"
#include "tests/fit/surrogate.h"

namespace hysteron {
namespace {

using Numbers = std::vector<double>;

// Thesis Table 2.3 [um/V, V].
const Numbers weights{0.7521, 0.1381, 0.0775, 0.0651, 0.0658, 0.0522, 0.0506, 0.0523, 0.0520, 0.1169};
const Numbers thresholds{0, 0.6, 1.2, 1.8, 2.4, 3.0, 3.6, 4.2, 4.8, 5.4};

Numbers output(const Numbers& u, Numbers w = Numbers(10, 0.0)) {
  Numbers y;
  for (const double at : u) {
    prandtl_ishlinskii::advance<double>(play::Sides::one, thresholds, w, at, w.data());
    y.push_back(prandtl_ishlinskii::output<double>(weights, w));
  }
  return y;
}
Numbers sine(double top, int rows, int per_cycle) {
  Numbers u;
  for (int k = 0; k < rows; ++k) u.push_back(top / 2 * (1 - std::cos(2 * std::numbers::pi * k / per_cycle)));
  return u;
}

TEST(SlopesMethod, FindsTheWeightsOfAModelOfItsOwnKind) {
  // Between thresholds the branch is straight: least squares on it are exact up to rounding of a slope over 0.6 V.
  const Numbers u = sine(6, 4000, 2000);
  const auto found = weights_by_slopes(u, output(u), thresholds);
  double slope = 0, intercept = 0;
  for (std::size_t i = 0; i < 10; ++i) {
    slope += weights[i];
    intercept -= weights[i] * thresholds[i];
    EXPECT_NEAR(found.weights[i], weights[i], 1e-12) << i;
    EXPECT_NEAR(found.slopes[i], slope, 1e-12) << i;
    EXPECT_NEAR(found.intercepts[i], intercept, 1e-11) << i;  // omega_i = -sum c_j r_j, SPEC 2.1
    EXPECT_GT(found.samples[i], 50);
  }
}

TEST(SlopesMethod, AnOffsetOfTheOutputDoesNotMatter) {
  const Numbers u = sine(6, 2000, 2000);
  Numbers y = output(u);
  for (double& v : y) v += 17;
  const auto found = weights_by_slopes(u, y, thresholds);
  for (std::size_t i = 0; i < 10; ++i) EXPECT_NEAR(found.weights[i], weights[i], 1e-11) << i;
}

TEST(SlopesMethod, MinorLoopsThatDoNotReachTheBottomDoNotCount) {
  Numbers u = sine(6, 2001, 2000);
  // 0 -> 5 -> 3 -> 6 -> 0: the rise from 3 V follows the steeper inside of the loop.
  for (int k = 1; k <= 100; ++k) u.push_back(0.05 * k);
  for (int k = 1; k <= 100; ++k) u.push_back(5 - 0.02 * k);
  for (int k = 1; k <= 100; ++k) u.push_back(3 + 0.03 * k);
  const auto found = weights_by_slopes(u, output(u), thresholds);
  for (std::size_t i = 0; i < 10; ++i) EXPECT_NEAR(found.weights[i], weights[i], 1e-12) << i;
}

TEST(SlopesMethod, PrintedFormulaOfTheThesisIsAnotherOne) {
  // Erratum E-04: slope - sum of c_1 .. c_(i-1) without c_0 and with its own weights gives c_3 = 3.78 in place of
  // 0.0651.
  const Numbers u = sine(6, 2000, 2000);
  const auto found = weights_by_slopes(u, output(u), thresholds);
  Numbers printed{found.slopes[0]};
  double sum = 0;
  for (std::size_t i = 1; i < 10; ++i) {
    printed.push_back(found.slopes[i] + sum);
    sum += printed.back();
  }
  EXPECT_NEAR(printed[3], 3.78, 0.006);
  EXPECT_NEAR(found.weights[3], 0.0651, 1e-12);
}

TEST(SlopesMethod, GivesOnTheSurrogateTheWeightsOfItsDescription) {
  // SPEC 2.5: printed to 4 decimals, fitness 12.96 with the loop's bottom as its zero. The loop read there is sampled
  // at 10 kHz; where the rows lie to the thresholds moves the slopes of a bent branch by some 1e-4: a row more or less
  // at an end of about 60.
  const DataSet data = surrogate::steady_loop(1);
  const auto& r = data.recordings[0];
  Numbers u, y;
  for (std::size_t k = r.first; k < r.last; ++k) {
    u.push_back(r.columns.at("u")[k]);
    y.push_back(1e6 * (r.columns.at("y")[k] - r.columns.at("y")[r.first]));
  }
  const auto found = weights_by_slopes(u, y, thresholds);
  const Numbers expected{.7343, .1808, .0837, .0545, .0631, .0566, .0407, .0215, .0334, .1530};
  for (std::size_t i = 0; i < 10; ++i) EXPECT_NEAR(found.weights[i], expected[i], 6e-4) << i;
  double fitness = 0;
  Numbers w(10, 0.0);
  for (std::size_t k = 0; k < u.size(); ++k) {
    prandtl_ishlinskii::advance<double>(play::Sides::one, thresholds, w, u[k], w.data());
    fitness += 5 * std::pow(prandtl_ishlinskii::output<double>(found.weights, w) - y[k], 2);
  }
  EXPECT_NEAR(fitness, 12.96, 0.13);  // claim C2-10: 2 %; 1 % holds
}

TEST(SlopesMethod, RefusesWhatItCannotRead) {
  const auto code_of = [](const Numbers& u, const Numbers& r) {
    try {
      weights_by_slopes(u, u, r);
    } catch (const Error& e) {
      EXPECT_FALSE(e.problems.front().cure.empty());
      return e.problems.front().code;
    }
    return std::string("none");
  };
  const Numbers u = sine(6, 2000, 2000);
  EXPECT_EQ(code_of(u, {0.1, 1}), "bad_thresholds");
  EXPECT_EQ(code_of(u, {0, 1, 1}), "bad_thresholds");
  EXPECT_EQ(code_of(u, {0, 1, 7}), "too_few_rows");
  EXPECT_EQ(code_of({6, 5, 4, 3}, {0, 1}), "too_few_rows");
  EXPECT_EQ(code_of({}, {0}), "too_few_rows");
  EXPECT_EQ(code_of(u, {0, 1, 5}), "none");
}

}  // namespace
}  // namespace hysteron
