// Creep by formulas that are no chains of relaxations: the logarithm of time itself, and a power of it.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/discover/discoveries.h"
#include "tests/discover/synthetic.h"

namespace hysteron {
namespace {

using namespace testing;

constexpr double white = 2e-4;

class CreepLaws : public Discoveries {
 protected:
  /// A gain of 1 m/V that goes on by `answer`(time) of each change, on staircases of 40 s in rows of 20 ms.
  static DataSet recorded(const std::function<double(double)>& answer) {
    std::vector<Recording> list;
    std::uint64_t seed = 60;
    for (const auto& [role, values] : {std::pair{Role::train, std::vector{1.0, 0.3, 0.7}},
                                       {Role::train, std::vector{0.5, 0.9}},
                                       {Role::validate, std::vector{0.8, 0.2}}}) {
      const auto t = rows(2000, 0.02);
      const auto u = levels(t, values);
      auto y = noise(t.size(), white, 0.1 * white, seed);
      for (std::size_t k = 0; k < t.size(); ++k) {
        y[k] += u[k];
        for (std::size_t j = 1; j <= k; ++j)
          if (u[j] != u[j - 1]) y[k] += (u[j] - u[j - 1]) * answer(t[k] - t[j]);
      }
      list.push_back(recording(std::to_string(seed++) + ".csv", role, t, u, std::move(y)));
    }
    return data_set(std::move(list), white);
  }
};

TEST_F(CreepLaws, TheLogarithmOfTimeIsTwoNumbers) {
  const auto d = discovered(plain_gain(), recorded([](double t) { return 0.01 * std::log10(1 + t / 0.2); }),
                            {"creep", "thermal_expansion", "hysteresis", "amplifier_lag"}, exact());
  ASSERT_EQ(d.steps.size(), 1U) << tried(d);
  EXPECT_EQ(d.steps.front().winner.law, "logarithm of time") << tried(d);
  // 4000 rows of noise 2e-4 tell 0.01 to some 1e-5 (1/f noise beside it: some times that); steps take one row of 20 ms,
  // a tenth of t0.
  EXPECT_NEAR(value(d, "per_decade"), 0.01, 2e-4);
  EXPECT_NEAR(value(d, "first_time"), 0.2, 0.03);
  EXPECT_EQ(d.remainder, Remainder::noise);
}

TEST_F(CreepLaws, AWeakOneIsTheLogarithmToo) {
  const auto d = discovered(plain_gain(), recorded([](double t) { return 8e-5 * std::log10(1 + t / 0.05); }),
                            {"creep", "thermal_expansion", "hysteresis", "amplifier_lag"});
  ASSERT_EQ(d.steps.size(), 1U) << tried(d);
  EXPECT_EQ(winner(d), "creep") << tried(d);
  EXPECT_EQ(d.steps.front().winner.law, "logarithm of time") << tried(d);
}

TEST_F(CreepLaws, WhatIsNoLogarithmHasAnAmountInEachDecade) {
  const auto d = discovered(plain_gain(), recorded([](double t) { return 0.02 * std::pow(t / 10, 0.35); }),
                            {"creep", "thermal_expansion", "hysteresis", "amplifier_lag"});
  ASSERT_EQ(d.steps.size(), 1U) << tried(d);
  EXPECT_EQ(d.steps.front().winner.law, "two relaxations per decade") << tried(d);
  EXPECT_EQ(d.remainder, Remainder::noise) << tried(d);
}

}  // namespace
}  // namespace hysteron
