// Recordings of which nobody says where they begin, beside effects.
#include <gtest/gtest.h>

#include <cmath>

#include "discover/selection/null_model.h"
#include "tests/discover/discoveries.h"
#include "tests/discover/synthetic.h"

namespace hysteron {
namespace {

using namespace testing;

constexpr double noise_of_sensor = 1e-3;  // [m]

class StartsTest : public Discoveries {
 protected:
  /// u -> a lag [s] -> y
  static Diagram slow(double time_constant = 1) {
    Diagram d;
    d.title = "slow";
    d.inputs["u"].unit = "m";
    Node& lag = d.blocks["stage"];
    lag.type = "lag";
    lag.parameters["times"] = Value(NumberList{{time_constant, "s"}});
    lag.in = {{"", "u"}};
    d.outputs["y"] = "stage";
    return d;
  }
  /// Driven by slow sines of which this share is read without its sign, begun so far [m] from where a rest would be.
  static DataSet begun(const std::vector<double>& off, double rectified, double time_constant = 1) {
    std::vector<Recording> list;
    for (std::size_t r = 0; r < off.size(); ++r) {
      const auto t = rows(1200, 0.05);
      const auto u = sampled(t, [r](double s) {
        return 0.6 * std::sin(0.19 * (1 + 0.13 * static_cast<double>(r)) * s) + 0.4 * std::sin(0.33 * s);
      });
      auto y = noise(t.size(), noise_of_sensor, 0, 3 + r);
      double x = off[r];
      for (std::size_t k = 0; k < t.size(); ++k) {
        y[k] += x;
        constexpr int steps = 50;
        for (int i = 0; k + 1 < t.size() && i < steps; ++i) {  // by the middle of each step: to 1e-6 of it
          const double v = u[k] + (u[k + 1] - u[k]) * (i + 0.5) / steps, h = 0.05 / steps;
          x += h * ((1 - rectified) * v + rectified * std::abs(v) - x) / (time_constant + h / 2);
        }
      }
      Recording one = recording(std::to_string(r) + ".csv", r < 2 ? Role::train : Role::validate, t, u, std::move(y));
      one.start_is_stated = false;
      one.units["u"] = parse_unit("m");
      list.push_back(std::move(one));
    }
    return data_set(std::move(list), noise_of_sensor, 0);
  }
};

// The rectified tenth leaves 0.1 m everywhere, in some swings a recording: 0.15 m in the first of 60 s says little
// beside that, and everything once it is known.
TEST_F(StartsTest, ThatAnEffectHidesAreFoundOnceItIsKnown) {
  const DataSet data = begun({0.15, 0, -0.15}, 0.1);
  DiscoverOptions options;
  options.only = {"rectification", "creep", "sensor_drift", "calibration"};
  EXPECT_LT(begin_in_motion(slow(), data, registry, effects, options).size(), 2U) << "nothing is hidden here";
  const Discovery d = discover(slow(), data, registry, effects, options);
  EXPECT_EQ(d.found_starts, (std::vector<std::string>{"0.csv", "2.csv"})) << tried(d);
  ASSERT_EQ(d.steps.size(), 1U) << tried(d);
  EXPECT_EQ(d.steps[0].winner.effect, "rectification") << tried(d);
  EXPECT_LT(d.final_error.rms_validate, 1.06 * noise_of_sensor) << tried(d);  // rms of 1200 rows: 2 %
}

// Of a stage of 20 s a recording of 60 s is too short to show that the start is the only place that is wrong.
TEST_F(StartsTest, OfShortRecordingsAreFoundOnceTheEffectIsKnown) {
  const DataSet data = begun({0.012, 0, -0.012}, 0.1, 20);
  DiscoverOptions options;
  options.only = {"rectification", "creep", "sensor_nonlinearity", "sensor_lag"};
  EXPECT_LT(begin_in_motion(slow(20), data, registry, effects, options).size(), 2U) << "nothing is hidden here";
  const Discovery d = discover(slow(20), data, registry, effects, options);
  EXPECT_EQ(d.found_starts, (std::vector<std::string>{"0.csv", "2.csv"})) << tried(d);
  ASSERT_EQ(d.steps.size(), 1U) << tried(d);
  EXPECT_EQ(d.steps[0].winner.effect, "rectification") << tried(d);
}

// Switched on before the recording, the device settles as its temperature does.
TEST_F(StartsTest, ThatPassForAnEffectAreFoundInItsPlace) {
  DataSet data = begun({0, 0.01, 0}, 0.1, 8);
  for (std::size_t r = 0; r < data.recordings.size(); ++r) {
    Recording& one = data.recordings[r];
    one.units["T"] = parse_unit("degC");
    for (const double t : one.t) one.columns["T"].push_back(298 + (r == 1 ? 6 * std::exp(-t / 8) : 0.0));
  }
  data.notes["T"].to = "T";
  DiscoverOptions options;
  options.only = {"rectification", "thermal_expansion"};
  EXPECT_TRUE(begin_in_motion(slow(8), data, registry, effects, options).empty()) << "nothing is hidden here";
  const Discovery d = discover(slow(8), data, registry, effects, options);
  EXPECT_EQ(d.found_starts, (std::vector<std::string>{"1.csv"})) << tried(d);
  ASSERT_EQ(d.steps.size(), 1U) << tried(d);
  EXPECT_EQ(d.steps[0].winner.effect, "rectification") << tried(d);
}

TEST_F(StartsTest, AtRestStayThereBesideAnEffect) {
  const Discovery d =
      discovered(slow(), begun({0, 0, 0}, 0.1), {"rectification", "creep", "sensor_drift", "calibration"});
  EXPECT_TRUE(d.found_starts.empty()) << tried(d);
  EXPECT_EQ(winner(d), "rectification") << tried(d);
}

// What creep or a mode remembers when a recording begins is no more than the drive could have done before: else one of
// no size at all describes any drift.
TEST_F(StartsTest, OfEffectsAreNoDrift) {
  DataSet data = begun({0.1, -0.05, 0.08}, 0);
  const double rates[] = {1e-4, -5e-5, 1.5e-4};  // [m/s]
  for (std::size_t r = 0; r < data.recordings.size(); ++r) {
    Recording& one = data.recordings[r];
    one.at_rest = false;
    one.initial_per_recording = one.start_is_stated = true;
    for (std::size_t k = 0; k < one.t.size(); ++k) {
      one.t[k] *= 20;  // a drift needs minutes
      one.columns["y"][k] += rates[r] * one.t[k];
    }
  }
  DiscoverOptions options;
  options.only = {"creep", "sensor_drift", "structural_resonance"};
  const Discovery d = discover(slow(20), data, registry, effects, options);
  ASSERT_EQ(d.steps.size(), 1U) << tried(d);
  EXPECT_EQ(winner(d), "sensor_drift") << tried(d);
  EXPECT_TRUE(d.steps[0].ties.empty()) << d.steps[0].ties.front().effect;
}

}  // namespace
}  // namespace hysteron
