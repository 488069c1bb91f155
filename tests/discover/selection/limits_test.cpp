// How often what is told of effects that were not found holds for effects of just that size.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "discover/selection/discover.h"
#include "tests/discover/discoveries.h"
#include "tests/discover/synthetic.h"

namespace hysteron {
namespace {

using namespace testing;

constexpr double of_the_sensor = 0.02;  // of signals of 1

/// What acts between the drive and the sensor of a gain of 1 m/V.
struct Planted {
  std::string effect;
  double delay = 0;  // [s]
  double lag = 0;    // [s]
  double gap = 0;    // [m]

  std::vector<double> seen(const std::vector<double>& t, const std::vector<double>& u) const {
    std::vector<double> y;
    double x = u[0], last = 0;
    for (std::size_t k = 0; k < t.size(); ++k) {
      double now = u[k];
      if (delay > 0) {  // straight between samples, at rest before the first
        const double at = (t[k] - delay - t[0]) / (t[1] - t[0]);
        const auto i = static_cast<std::size_t>(std::max(at, 0.0));
        now = at <= 0 ? u[0] : u[i] + (at - static_cast<double>(i)) * (u[i + 1] - u[i]);
      }
      if (lag > 0 && k > 0) {  // a line is followed lag late, and what it was off it decays
        const double h = t[k] - t[k - 1], rise = (u[k] - u[k - 1]) / h;
        x = u[k] - rise * lag + (x - u[k - 1] + rise * lag) * std::exp(-h / lag);
        now = x;
      }
      last = std::clamp(last, now - gap / 2, now + gap / 2);  // Nordin and Gutman, Automatica 38 (2002) 1633
      y.push_back(last);
    }
    return y;
  }
};

class Limited : public Discoveries {
 protected:
  Discovery selected(const Planted& planted, std::uint64_t seed) {
    std::vector<Recording> list;
    for (int r = 0; r < 2; ++r) {
      const auto t = rows(500, 0.01);
      const auto u = several_sines(t, 1, {0.5 + 0.2 * r, 1.1, 2.3});
      auto y = planted.seen(t, u);
      const auto n = noise(t.size(), of_the_sensor, 0, 2 * seed + static_cast<std::uint64_t>(r));
      for (std::size_t k = 0; k < t.size(); ++k) y[k] += n[k];
      list.push_back(recording(std::to_string(r) + ".csv", r == 0 ? Role::train : Role::validate, t, u, std::move(y)));
      list.back().start_is_stated = true;
    }
    DiscoverOptions options;
    options.only = {planted.effect};
    return discover(plain_gain(), data_set(std::move(list), of_the_sensor, 0), registry, effects, options);
  }
  static const EffectLimit* limit_of(const Discovery& d) { return d.limits.size() == 1 ? &d.limits.front() : nullptr; }
};

TEST_F(Limited, ALimitHoldsInNinetyFiveOfAHundredCases) {
  constexpr int cases = 67;  // of each of three effects
  int told = 0, held = 0;
  for (const auto& [effect, number] :
       {std::pair{"dead_time", &Planted::delay}, std::pair{"amplifier_lag", &Planted::lag},
        std::pair{"backlash", &Planted::gap}}) {
    Planted planted;
    planted.effect = effect;
    const Discovery nothing = selected(planted, 1);
    ASSERT_NE(limit_of(nothing), nullptr) << effect << tried(nothing);
    planted.*number = limit_of(nothing)->value;  // as large as can just be missed
    for (int i = 0; i < cases; ++i) {
      const Discovery d = selected(planted, 100 + static_cast<std::uint64_t>(i));
      if (!d.steps.empty()) continue;  // found
      const EffectLimit* limit = limit_of(d);
      if (limit == nullptr) continue;  // by chance more than the noise is left
      ++told;
      if (limit->value >= planted.*number) ++held;
    }
  }
  EXPECT_GE(told, 180);
  // Of 201 cases with 95 % each 99.8 % of all draws lie within 90 and 99 %.
  EXPECT_GE(held, 0.9 * told) << held << " of " << told;
  EXPECT_LE(held, 0.99 * told) << held << " of " << told;
}

TEST_F(Limited, ALimitIsWhatTheRowsTell) {
  // A gap g of a triangle-like motion lags g/2 behind the way that turns: 1000 rows of noise 0.02 know a step of
  // g/2 each way to 0.02/sqrt(1000), g to twice that, 1.3 um of 1 mm; and the gain is known from the same rows.
  Planted planted;
  planted.effect = "backlash";
  const Discovery d = selected(planted, 5);
  ASSERT_NE(limit_of(d), nullptr) << tried(d);
  EXPECT_EQ(d.limits[0].parameter, "gap");
  EXPECT_EQ(d.limits[0].place, "stage");
  const double sigma = 2 * of_the_sensor / std::sqrt(1000.0);
  EXPECT_GT(d.limits[0].value, 1.0 * sigma);  // from a = 0 on 1.645, and a may be some of it
  EXPECT_LT(d.limits[0].value, 5.0 * sigma);
  EXPECT_NE(d.sentences.back().find("Not found, with upper limits"), std::string::npos);
}

TEST_F(Limited, NothingIsToldOfLimitsWhereMoreThanNoiseIsLeft) {
  Planted planted;
  planted.effect = "sensor_drift";
  planted.gap = 0.5;
  const Discovery d = selected(planted, 5);
  EXPECT_TRUE(d.limits.empty());
}

}  // namespace
}  // namespace hysteron
