// A gain of the drive is told from one of a sensor where one drive moves two measured outputs.
#include <gtest/gtest.h>

#include <utility>

#include "discover/placement/visible.h"
#include "tests/discover/discoveries.h"
#include "tests/discover/synthetic.h"

namespace hysteron {
namespace {

using namespace testing;

class DriveGain : public Discoveries {
 protected:
  static constexpr double white = 2e-4;

  /// u -> 1 m/V -> y, and 2 m/V -> s.
  static Diagram two_sensors() {
    Diagram d = plain_gain();
    Node other = *d.blocks.find("stage");
    other.parameters["gain"] = Value("2 m/V");
    d.blocks["other"] = std::move(other);
    d.outputs["s"] = "other";
    return d;
  }
  /// By how much each sensor shows more than the diagram says.
  static DataSet measured(double y, double s) {
    std::vector<Recording> list;
    std::uint64_t seed = 300;
    for (const auto& [role, hertz] : {std::pair{Role::train, 1.1}, {Role::train, 1.7}, {Role::validate, 2.3}}) {
      const auto t = rows(800, 0.005);
      const auto u = several_sines(t, 1, {hertz, 3.1 * hertz});
      const auto seen = [&](double gain) {
        auto v = noise(t.size(), white, 0.1 * white, seed++);
        for (std::size_t k = 0; k < v.size(); ++k) v[k] += gain * u[k];
        return v;
      };
      Recording r = recording(std::to_string(seed) + ".csv", role, t, u, seen(y));
      r.columns["s"] = seen(2 * s);
      r.units["s"] = parse_unit("m");
      list.push_back(std::move(r));
    }
    DataSet d = data_set(std::move(list), white);
    d.notes["s"] = d.notes["y"];
    d.notes["s"].to = "s";
    return d;
  }
};

TEST_F(DriveGain, WhatAllOutputsShowAlikeIsTheDrives) {
  const Discovery d = discovered(two_sensors(), measured(1.02, 1.02),
                                 {"calibration", "drive_gain", "hysteresis", "asymmetry"}, exact());
  ASSERT_EQ(d.steps.size(), 1u) << tried(d);
  EXPECT_EQ(d.steps[0].winner.effect, "drive_gain") << tried(d);
  // 1600 rows of 0.7 rms with noise of 2e-4 on y, and as many of 1.4 on s: to 3e-6; slow noise doubles that.
  EXPECT_NEAR(value(d, "gain"), 1.02, 3e-5);
  EXPECT_EQ(d.verdict, Verdict::missing_effect);
  EXPECT_EQ(to_text(d.remainder), "noise");
}

TEST_F(DriveGain, WhatOneOfThemShowsIsItsSensors) {
  const Discovery d =
      discovered(two_sensors(), measured(1.02, 1), {"calibration", "drive_gain", "hysteresis"}, exact());
  ASSERT_EQ(d.steps.size(), 1u) << tried(d);
  EXPECT_EQ(d.steps[0].winner.effect, "calibration") << tried(d);
  EXPECT_TRUE(d.steps[0].winner.place == "stage") << d.steps[0].winner.place;
}

TEST_F(DriveGain, OfOneOutputItIsNotAsked) {
  DataSet one = measured(1.02, 1.02);
  for (auto& r : one.recordings) r.columns.erase("s");
  one.notes.erase("s");
  for (const auto& v : visible_effects(two_sensors(), one, registry, effects, {}))
    if (v.effect == "drive_gain") {
      EXPECT_FALSE(v.can());
      EXPECT_NE(v.reason.find("drive gain and sensor gain cannot be separated"), std::string::npos) << v.reason;
    }
  const Discovery d = discovered(plain_gain(), one, {"calibration", "drive_gain"}, exact());
  ASSERT_EQ(d.steps.size(), 1u);
  EXPECT_EQ(d.steps[0].winner.effect, "calibration");
}

}  // namespace
}  // namespace hysteron
