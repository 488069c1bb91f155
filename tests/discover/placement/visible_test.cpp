// What a data set can show, what it can show but not for sure, and what it cannot.
#include "discover/placement/visible.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/discover/discoveries.h"
#include "tests/discover/synthetic.h"

namespace hysteron {
namespace {

using namespace testing;
using std::numbers::pi;

class VisibleEffects : public Discoveries {
 protected:
  /// A gain driven so; what it answers is noise of 1 mm on it.
  Visible seen(const std::function<double(double)>& drive, const std::string& effect) {
    std::vector<Recording> list;
    const auto t = rows(2000, 0.01);
    for (const Role role : {Role::train, Role::validate}) {
      const auto u = sampled(t, drive);
      auto y = noise(t.size(), 1e-3, 1e-4, list.size() + 1);
      for (std::size_t k = 0; k < y.size(); ++k) y[k] += u[k];
      list.push_back(recording(std::to_string(list.size()) + ".csv", role, t, u, y));
    }
    for (const auto& v : visible_effects(plain_gain(), data_set(list, 1e-3), registry, effects))
      if (v.effect == effect) return v;
    ADD_FAILURE() << effect << " is not listed";
    return {};
  }
};

double sine(double t) { return std::sin(2 * pi * 0.5 * t); }
/// The same with 100, 50 and 15 % of it, one after the other.
double three_sines(double t) { return (t < 8 ? 1 : t < 14 ? 0.5 : 0.15) * sine(t); }

TEST_F(VisibleEffects, OneAmplitudeShowsALoopAndThreeTellWhose) {
  const Visible one = seen(sine, "hysteresis"), three = seen(three_sines, "hysteresis");
  EXPECT_TRUE(one.can());
  EXPECT_FALSE(one.can_well());
  EXPECT_NE(one.unsure.find("three would"), std::string::npos) << one.unsure;
  EXPECT_TRUE(three.can_well()) << three.unsure;
}

TEST_F(VisibleEffects, LostMotionNeedsSwingsOfOneToFive) {
  EXPECT_NE(seen(sine, "backlash").unsure.find("five times"), std::string::npos);
  EXPECT_TRUE(seen(three_sines, "backlash").can_well()) << seen(three_sines, "backlash").unsure;
}

TEST_F(VisibleEffects, ACurveNeedsSwingsAboutTwoLevels) {
  const auto two_levels = [](double t) { return t < 10 ? sine(t) : 0.5 + 0.4 * sine(t); };
  EXPECT_NE(seen(sine, "asymmetry").unsure.find("one level"), std::string::npos);
  EXPECT_TRUE(seen(two_levels, "asymmetry").can_well()) << seen(two_levels, "asymmetry").unsure;
}

TEST_F(VisibleEffects, WhatStandsStillCannotBeSeenAtAll) {
  const Visible v = seen([](double) { return 0.5; }, "hysteresis");
  EXPECT_FALSE(v.can());
  EXPECT_FALSE(v.can_well());
  EXPECT_TRUE(v.unsure.empty());
  EXPECT_NE(v.reason.find("reversals"), std::string::npos) << v.reason;
}

TEST_F(VisibleEffects, StepsNoCoarserThanTheNoiseAreUnsure) {
  const Effect& e = effects.get("quantization");
  Excitation at;
  at.from_data = true;
  at.roughness = 1e-3;
  at.resolution = 1.3e-3;
  EXPECT_EQ(e.unseen(at), "");
  EXPECT_NE(e.unsure(at).find("1.3 times the noise"), std::string::npos) << e.unsure(at);
  at.resolution = 2.1e-3;
  EXPECT_EQ(e.unsure(at), "");
}

}  // namespace
}  // namespace hysteron
