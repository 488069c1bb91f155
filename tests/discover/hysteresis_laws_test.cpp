// Hysteresis by another formula than plays: a Preisach density, whose loops are not those of plays of the drive.
#include <gtest/gtest.h>

#include <algorithm>

#include "models/play.h"
#include "tests/discover/discoveries.h"
#include "tests/discover/synthetic.h"

namespace hysteron {
namespace {

using namespace testing;

constexpr double white = 2e-4;

/// Relays that switch up at a and down at b, 0 <= b <= a <= 1, of the density 1 + uneven (a + b) + apart (a - b) (a + b
/// - 1): of the triangle from b to a they give (a - b)^2/2 (1 + uneven (a + b) + apart/3 (a - b) (a + b - 1)).
/// Mayergoyz, IEEE Trans. Magn. 22 (1986) 603-608: each turn that was not wiped out is a corner of a staircase.
std::vector<double> relays(const std::vector<double>& u, double uneven, double apart = 0) {
  const auto triangle = [&](double a, double b) {
    return (a - b) * (a - b) / 2 * (1 + uneven * (a + b) + apart / 3 * (a - b) * (a + b - 1));
  };
  std::vector<double> turns{0.0}, y;  // from the lowest drive: minimum, maximum, minimum ...
  double last = 0;
  for (const double now : u) {
    const bool up = turns.size() % 2 == 1;
    if (up ? now < last : now > last) turns.push_back(last);
    last = now;
    const auto wiped = [&] {
      return turns.size() % 2 == 1 ? now >= turns[turns.size() - 2] : now <= turns[turns.size() - 2];
    };
    while (turns.size() >= 3 && wiped()) turns.resize(turns.size() - 2);
    double sum = 0;
    for (std::size_t i = 0; i < turns.size(); ++i) {
      const double next = i + 1 < turns.size() ? turns[i + 1] : now;
      sum += i % 2 == 0 ? triangle(next, turns[i]) : -triangle(turns[i], next);
    }
    y.push_back(sum);
  }
  return y;
}

class HysteresisLaws : public Discoveries {
 protected:
  static DataSet recorded(double amount, double uneven, double apart = 0) {
    std::vector<Recording> list;
    std::uint64_t seed = 200;
    for (const auto& [role, top, periods] :
         {std::tuple{Role::train, 1.0, 5}, {Role::train, 0.6, 8}, {Role::validate, 0.9, 7}}) {
      const auto t = rows(1500, 0.005);
      const auto u = decaying_triangle(t, top, periods);
      const auto loop = relays(u, uneven, apart);
      auto y = noise(t.size(), white, 0.1 * white, seed);
      for (std::size_t k = 0; k < y.size(); ++k) y[k] += u[k] + amount * (loop[k] - 0.8 * u[k]);
      list.push_back(recording(std::to_string(seed++) + ".csv", role, t, u, std::move(y)));
    }
    return data_set(std::move(list), white);
  }
};

TEST_F(HysteresisLaws, RelaysOfAnEvenDensityFillTriangles) {
  // Half the square of the way, up to the top and back from it.
  const auto up = relays({0, 0.25, 0.5, 0.75, 1, 0.5}, 0);
  EXPECT_NEAR(up[4], 0.5, 1e-15);
  EXPECT_NEAR(up[5], 0.5 - 0.125, 1e-15);
}

TEST_F(HysteresisLaws, AnUnevenDensityIsHysteresisAndNoCurveBesides) {
  const auto d = discovered(plain_gain(), recorded(0.06, 1.5),
                            {"hysteresis", "asymmetry", "sensor_nonlinearity", "saturation", "friction", "backlash"});
  ASSERT_EQ(d.steps.size(), 1U) << tried(d);
  EXPECT_EQ(winner(d), "hysteresis") << tried(d);
  EXPECT_EQ(d.steps.front().winner.law, "10 one-sided plays of a bent drive") << tried(d);
  EXPECT_EQ(d.remainder, Remainder::noise) << tried(d);
  // Loops are wider where relays are dense: the drive is bent upwards.
  EXPECT_LT(value(d, "slope_at_lower"), value(d, "slope_at_upper")) << tried(d);
}

TEST_F(HysteresisLaws, RelaysOfAnyDensityAreHysteresisAndNoCurveBesides) {
  // Narrow ones at one end and wide ones at the other: what plays of a bent drive leave of that looks like a curve.
  const auto d = discovered(plain_gain(), recorded(0.03, 0, 3.5),
                            {"hysteresis", "asymmetry", "sensor_nonlinearity", "saturation", "friction", "backlash"});
  ASSERT_EQ(d.steps.size(), 1U) << tried(d);
  EXPECT_EQ(winner(d), "hysteresis") << tried(d);
  EXPECT_TRUE(d.steps.front().winner.law.starts_with("relays")) << tried(d);
  EXPECT_EQ(d.remainder, Remainder::noise) << tried(d);
}

TEST_F(HysteresisLaws, ACurveBeforePlaysIsNotSwallowedByALawThatCouldHoldBoth) {
  auto data = recorded(0, 0);
  std::uint64_t seed = 300;
  for (auto& r : data.recordings) {
    const auto& u = r.columns.at("u");
    auto y = noise(u.size(), white, 0.1 * white, seed++);
    double narrow = 0, wide = 0;
    for (std::size_t k = 0; k < u.size(); ++k) {
      const double bent = u[k] + 0.04 * u[k] * (u[k] - 1);
      narrow = play::follow_one_sided(0.162, narrow, bent);
      wide = play::follow_one_sided(0.406, wide, bent);
      y[k] += 0.98 * bent + 0.01 * narrow + 0.02 * wide;
    }
    r.columns.at("y") = std::move(y);
  }
  const auto d = discovered(plain_gain(), data, {"hysteresis", "asymmetry", "sensor_nonlinearity", "saturation"});
  ASSERT_EQ(d.steps.size(), 2U) << tried(d);
  EXPECT_TRUE(std::any_of(d.steps.begin(), d.steps.end(), [](const FoundStep& s) {
    return s.winner.effect == "asymmetry";
  })) << tried(d);
  EXPECT_TRUE(std::any_of(d.steps.begin(), d.steps.end(), [](const FoundStep& s) {
    return s.winner.effect == "hysteresis";
  })) << tried(d);
  EXPECT_EQ(d.remainder, Remainder::noise) << tried(d);
}

TEST_F(HysteresisLaws, ADriveIsBentWhereItLiesToOneSideOfZero) {
  const Effect& hysteresis = effects.get("hysteresis");
  const auto bends = [&](double lowest, double highest) {
    Circumstances at;
    at.lowest = lowest;
    at.highest = highest;
    const auto laws = hysteresis.laws(at);
    return std::any_of(laws.begin(), laws.end(),
                       [](const Law& l) { return l.block.type == "generalized_prandtl_ishlinskii"; });
  };
  EXPECT_TRUE(bends(0, 100));
  EXPECT_TRUE(bends(-5, 100));
  EXPECT_FALSE(bends(-100, 100));
}

TEST_F(HysteresisLaws, ALoopWithinATenthOfTheStrokeIsLostMotion) {
  const Effect& hysteresis = effects.get("hysteresis");
  Circumstances at;
  at.lowest = 0;
  at.highest = 1;
  at.unit = parse_unit("V");
  at.gain_is_free = true;  // six weights
  const Law law = hysteresis.laws(at).front();
  // Thresholds of 0.04, 0.162 ... 0.65 of the range: 0.04 w of the first, 0.162 w of the second.
  EXPECT_NE(hysteresis.implausible(law, {0.1, 0, 0, 0, 0, 0}, at), "");
  EXPECT_NE(hysteresis.implausible(law, {0.1, 0.001, 0, 0, 0, 0}, at), "") << "4 % of it lie beyond";
  EXPECT_EQ(hysteresis.implausible(law, {0.1, 0.002, 0, 0, 0, 0}, at), "") << "8 %";
  EXPECT_EQ(hysteresis.implausible(law, {0, 0, 0, 0, 0, 0}, at), "") << "no loop at all";
}

}  // namespace
}  // namespace hysteron
