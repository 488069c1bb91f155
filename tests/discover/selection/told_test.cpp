// With which numbers an effect is told that only the recordings to judge show.
#include "discover/selection/told.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/discover/discoveries.h"
#include "tests/discover/synthetic.h"

namespace hysteron {
namespace {

using namespace testing;

constexpr double rms_of_noise = 1e-5;  // [m]
constexpr double stiffening = 5e3;     // [N/m^3]: at 25 mm 0.8 % of the spring's force

class ToldTest : public Discoveries {
 protected:
  /// Two recordings to fit to with a drive of this amplitude [V] and one of 1 V to judge, of a mass on a spring that
  /// stiffens.
  Discovery told(double amplitude, std::uint64_t seed) {
    std::vector<Recording> list;
    for (int r = 0; r < 3; ++r) {
      const auto t = rows(1500, 0.01);
      const auto u = several_sines(t, r < 2 ? amplitude : 1, {0.31 + 0.1 * r, 0.87, 1.9});
      auto y = noise(t.size(), rms_of_noise, 0, seed + 10 * static_cast<std::uint64_t>(r));
      double x = 0, v = 0;
      for (std::size_t k = 0; k < t.size(); ++k) {
        y[k] += x;
        constexpr int steps = 100;
        for (int i = 0; k + 1 < t.size() && i < steps; ++i) {  // Stoermer and Verlet: to (w h)^2/24 = 2e-7
          const double h = 0.01 / steps, force = 10 * (u[k] + (u[k + 1] - u[k]) * (i + 0.5) / steps);
          x += h / 2 * v;
          v = ((1 - 2 * h) * v + h * (force - 400 * x - stiffening * x * x * x)) / (1 + 2 * h);
          x += h / 2 * v;
        }
      }
      list.push_back(recording(std::to_string(r) + ".csv", r < 2 ? Role::train : Role::validate, t, u, std::move(y)));
    }
    return discovered(mass_on_spring(), data_set(std::move(list), rms_of_noise, 0), {"stiffening"}, exact());
  }
};

// At 0.2 V the stiffening moves the mass by 0.7 um, of which 3000 rows know a quarter: at 1 V that is twice the noise.
TEST_F(ToldTest, WhatOnlyRecordingsToJudgeShowIsFittedToThemTooAndSaysSo) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const Discovery d = told(0.2, seed);
    ASSERT_EQ(d.steps.size(), 1U) << tried(d);
    EXPECT_TRUE(d.fitted_to_all) << tried(d);
    // The rms of 1500 rows of noise is known to 1.8 %.
    EXPECT_LT(d.final_error.rms_validate, 1.05 * rms_of_noise) << tried(d);
    EXPECT_NE(d.headline.find("recordings to judge (fitted to as well)"), std::string::npos) << d.headline;
    const auto says = [](const std::string& w) {
      return w.starts_with("the numbers of what was found were fitted to 2.csv too, for the rows of 0.csv, 1.csv");
    };
    EXPECT_TRUE(std::any_of(d.warnings.begin(), d.warnings.end(), says));
  }
}

TEST_F(ToldTest, WhatRecordingsToFitToShowIsJudgedByOthers) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const Discovery d = told(1, seed);
    ASSERT_EQ(d.steps.size(), 1U) << tried(d);
    EXPECT_FALSE(d.fitted_to_all) << tried(d);
    EXPECT_NE(d.headline.find("recordings not used for the fit"), std::string::npos) << d.headline;
  }
}

}  // namespace
}  // namespace hysteron
