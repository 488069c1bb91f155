// Sampled filters, sums and systems, one by one: what they give at their instants is what the equations of their pages
// give.
#include <gtest/gtest.h>

#include <cmath>

#include "models/random.h"
#include "tests/blocks/bench.h"
#include "tests/blocks/sampled/rows.h"

namespace hysteron {
namespace {

using bench::Bench;
using bench::Numbers;
using bench::rows;

Numbers noise(std::size_t n) {
  Numbers u;
  for (std::uint64_t k = 0; k < n; ++k) u.push_back(random::normal(8, 0, k));
  return u;
}

TEST(DigitalFilterBlock, IsTheTransferFunctionOfItsSection) {
  // Butterworth, order 2: K = tan(pi f T), b = K^2/(1 + sqrt(2) K + K^2) [1, 2, 1], by hand.
  const double k = std::tan(M_PI * 0.11), under = 1 + std::sqrt(2) * k + k * k;
  const Bench filter("digital_filter", {{"corner", {1.1}}, {"period", {0.1}}});
  const Bench by_hand("discrete_transfer_function", {{"gain", {k * k}},
                                                     {"num", {1, 2, 1}},
                                                     {"den", {under, 2 * k * k - 2, 1 - std::sqrt(2) * k + k * k}},
                                                     {"period", {0.1}}});
  const auto u = rows(noise(60));
  const Numbers y = filter.response(u, 0.1), z = by_hand.response(u, 0.1);
  for (std::size_t i = 0; i < y.size(); ++i) EXPECT_NEAR(y[i], z[i], 1e-13);
}

TEST(DigitalFilterBlock, BeginsAtRestUnderTheInputBefore) {
  for (const double pass : {0.0, 1.0, 2.0, 3.0}) {
    const Bench b(
        "digital_filter",
        {{"pass", {pass}}, {"order", {5}}, {"corner", {1.1}}, {"upper", {2.4}}, {"before", {3}}, {"period", {0.1}}});
    for (const double y : b.response(rows(Numbers(20, 3.0)), 0.1))
      EXPECT_NEAR(y, pass == 0 || pass == 3 ? 3 : 0, 1e-12);
  }
}

TEST(FirBlock, IsTheWeightedSumOfTheLastSamples) {
  const Numbers u = noise(30), weights{0.5, 0.3, -0.2, 0.7};
  const Bench b("fir", {{"coefficients", weights}, {"before", {2}}, {"period", {1}}});
  const Numbers y = b.response(rows(u), 1);
  for (std::size_t k = 0; k < u.size(); ++k) {
    double sum = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) sum += weights[i] * (k >= i ? u[k - i] : 2);
    EXPECT_NEAR(y[k], sum, 1e-14);
  }
  EXPECT_EQ(Bench("fir", {{"coefficients", {3}}, {"period", {1}}}).output(0, {2})[0], 6);
}

TEST(MovingAverageBlock, TakesOutWhatFitsWholeTimesIntoIt) {
  const Bench b("moving_average", {{"samples", {20}}, {"period", {1e-3}}});
  Numbers u;
  for (int k = 0; k < 100; ++k) u.push_back(4 + std::sin(2 * M_PI * 50e-3 * k + 0.3) + std::cos(2 * M_PI * 150e-3 * k));
  const Numbers y = b.response(rows(u), 1e-3);
  for (std::size_t k = 19; k < y.size(); ++k) EXPECT_NEAR(y[k], 4, 1e-14);
  EXPECT_EQ(Bench("moving_average", {{"samples", {1}}, {"period", {1}}}).output(0, {2})[0], 2);
}

TEST(DiscreteIntegratorBlock, SumsByItsRule) {
  // u = 1, 2, 3, ... with T = 0.5 from 7: forward 7 + 0.5 k (k + 1)/2, backward one sample more, trapezoidal between.
  for (const double rule : {0.0, 1.0, 2.0}) {
    const Bench b("discrete_integrator", {{"rule", {rule}}, {"initial", {7}}, {"period", {0.5}}});
    EXPECT_EQ(b.sizes.feedthrough, rule != 0);
    const Numbers y = b.response(rows({1, 2, 3, 4, 5}), 0.5);
    for (int k = 0; k < 5; ++k) {
      const double at_once = rule == 0 ? 0 : rule == 1 ? 1 : 0.5;
      EXPECT_NEAR(y[static_cast<std::size_t>(k)], 7 + 0.5 * (k * (k + 1) / 2 + at_once * (k + 1)), 1e-14);
    }
  }
}

TEST(DiscreteIntegratorBlock, ByTheTrapezoidalRuleIsExactForStraightInputs) {
  const Bench b("discrete_integrator", {{"rule", {2}}, {"period", {0.1}}});
  Numbers u;
  for (int k = 0; k <= 10; ++k) u.push_back(0.1 * k);
  EXPECT_NEAR(b.response(rows(u), 0.1).back(), 0.5, 1e-15);
}

TEST(DiscreteStateSpaceBlock, GoesFromInstantToInstantByItsMatrices) {
  // x1 = x2, x2 = -0.5 x1 + 0.2 x2 + u; y = x1 + 3 u in um of V.
  const Bench b("discrete_state_space",
                {{"a", {0, 1, -0.5, 0.2}},
                 {"a columns", {2}},
                 {"b", {0, 1}},
                 {"b columns", {1}},
                 {"c", {1, 0}},
                 {"c columns", {2}},
                 {"d", {3}},
                 {"d columns", {1}},
                 {"initial", {0.4, 0.1}},
                 {"input_unit", {'V'}},
                 {"output_unit", {'u', 'm'}},
                 {"period", {1}}},
                1);
  EXPECT_TRUE(b.sizes.feedthrough);
  EXPECT_EQ(b.sizes.states, 0);
  const Numbers u = noise(20), y = b.response(rows(u), 1);
  double x1 = 0.4, x2 = 0.1;
  for (std::size_t k = 0; k < u.size(); ++k) {
    EXPECT_NEAR(y[k], 1e-6 * (x1 + 3 * u[k]), 1e-20);
    const double next = -0.5 * x1 + 0.2 * x2 + u[k];
    x1 = x2;
    x2 = next;
  }
}

}  // namespace
}  // namespace hysteron
