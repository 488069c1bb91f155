// Rules for static curves: before the memory or at the sensor, with a knee or bent all along. Each test fails without
// its rule.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "blocks/register_all.h"
#include "discover/effects/all.h"
#include "discover/placement/places.h"
#include "discover/selection/discover.h"
#include "io/diagram/diagram_file.h"
#include "tests/discover/synthetic.h"

namespace hysteron {
namespace {

using namespace testing;

constexpr double curve_noise =
    1e-4;  // [m] against a stroke of 1 m: what the curves below leave is 20 times as large and more

class Curves : public ::testing::Test {
 protected:
  /// Recordings of a drive 0 .. 1 V through y = curve(u); the one that judges goes to 0.6 V.
  static DataSet seen_through(const std::function<double(double)>& curve) {
    std::vector<Recording> list;
    std::uint64_t seed = 70;
    for (const auto& [role, hertz] : {std::pair{Role::train, std::vector<double>{1.1, 3.7}},
                                      {Role::train, {0.6, 7.3}},
                                      {Role::validate, {1.7, 5.2}}}) {
      const auto t = rows(800, 0.005);
      const auto u = several_sines(t, role == Role::train ? 1 : 0.6, hertz);
      auto y = noise(t.size(), curve_noise, 0.1 * curve_noise, seed++);
      for (std::size_t k = 0; k < y.size(); ++k) y[k] += curve(u[k]);
      list.push_back(recording(std::to_string(seed) + ".csv", role, t, u, std::move(y)));
    }
    return data_set(std::move(list), curve_noise);
  }
  Discovery found(const DataSet& data, const std::vector<std::string>& only, std::vector<std::string> free = {}) {
    DiscoverOptions options;
    options.only = only;
    options.free_paths = std::move(free);
    return discover(plain_gain(), data, registry, effects, options);
  }
  Registry registry = all_blocks();
  Effects effects = all_effects();
};

TEST_F(Curves, ASupplyFarBelowItsKneeBendsTheSignalThoughNothingIsFlat) {
  // tanh at a fifth of its limit takes 1.3 % off the top, and a good part of it as far as 0.6 V. Hard limits that touch
  // the signal only beyond that bring nothing where it is judged: the knee has to be tried all the same.
  const Discovery d = found(seen_through([](double u) { return 5 * std::tanh(u / 5); }),
                            {"saturation", "asymmetry", "sensor_nonlinearity", "hysteresis"}, {"stage.gain"});
  ASSERT_EQ(d.steps.size(), 1u) << d.headline;
  const auto knee = std::find_if(d.candidates.begin(), d.candidates.end(),
                                 [](const Candidate& c) { return c.effect == "saturation"; });
  ASSERT_NE(knee, d.candidates.end());
  EXPECT_EQ(knee->law, "soft knee") << knee->reason;
}

TEST_F(Curves, ASensorIsOffAtZeroToo) {
  // No block of the model has a zero of its own: the curve brings one.
  const Discovery d = found(seen_through([](double u) { return u + 0.02 * (u * u - 0.5); }), {"sensor_nonlinearity"});
  ASSERT_EQ(d.steps.size(), 1u) << d.headline;
  EXPECT_EQ(d.remainder, Remainder::noise);
}

TEST_F(Curves, ACurveThatIsSteepAtTheEndsTakesMoreThanACubic) {
  // About the middle, as sensors are linearised: a cubic leaves 5 times the noise of it.
  const auto curve = [](double u) {
    const double z = 2 * u - 1;
    return u + 0.03 * (std::sinh(2.5 * z) / std::sinh(2.5) - z);
  };
  const Discovery d = found(seen_through(curve), {"sensor_nonlinearity"});
  ASSERT_EQ(d.steps.size(), 1u) << d.headline;
  EXPECT_EQ(d.remainder, Remainder::noise);
}

TEST_F(Curves, FarFromZeroIsAboutTheMiddleOfWhatWasMeasured) {
  // The same bend over one kelvin about 20.5 degC and 0 degC, and over one metre ten kilometres away: powers of 293 K
  // or of 10 km could not follow it, nor could three digits say where it lies.
  for (const auto& [offset, unit, middle] : {std::tuple{293.15, "degC", "\"about\": \"20.5 degC\""},
                                             {272.65, "degC", "\"about\": \"0 degC\""},
                                             {10000.0, "m", "\"about\": \"10000.5 m\""}}) {
    DataSet data = seen_through([](double u) {
      const double z = 2 * u - 1;
      return u + 0.03 * (std::sinh(2.5 * z) / std::sinh(2.5) - z);
    });
    for (Recording& r : data.recordings)
      for (const char* column : {"u", "y"}) {
        for (double& v : r.columns[column]) v += offset;
        r.units[column] = parse_unit(unit);
      }
    Diagram bath = plain_gain();
    bath.inputs["u"].unit = unit;
    bath.blocks["stage"].parameters["gain"] = Value("1");
    DiscoverOptions options;
    options.only = {"sensor_nonlinearity"};
    const Discovery d = discover(bath, data, registry, effects, options);
    ASSERT_EQ(d.steps.size(), 1u) << d.headline;
    EXPECT_EQ(d.remainder, Remainder::noise);
    EXPECT_NE(diagram_text(d.final_diagram).find(middle), std::string::npos) << diagram_text(d.final_diagram);
  }
}

TEST_F(Curves, OfASignalThatDoesNotMoveHasNumbersAllTheSame) {
  Excitation still;
  still.lowest = still.highest = 5;
  for (const auto& law : effects.get("asymmetry").laws(still)) {
    for (const char* limit : {"lower", "upper"}) {
      const Value* value = law.block.parameters.find(limit);
      ASSERT_NE(value, nullptr) << law.name;
      EXPECT_TRUE(std::isfinite(std::get<Number>(value->content).value)) << law.name << " " << limit;
    }
    const Value* about = law.block.parameters.find("about");
    EXPECT_TRUE(about == nullptr || std::isfinite(std::get<Number>(about->content).value)) << law.name;
  }
}

TEST_F(Curves, OnAMeasuredWireACurveIsTheSensors) {
  const auto at = [&](const char* effect) {
    std::vector<std::string> list;
    for (const auto& p : places_of(effects.get(effect), plain_gain(), registry)) list.push_back(p.at);
    return list;
  };
  EXPECT_EQ(at("asymmetry"), std::vector<std::string>{"u"});
  EXPECT_EQ(at("sensor_nonlinearity"), std::vector<std::string>{"stage"});
  // A memory stands before and behind a gain; another effect of the core may still enter at both.
  EXPECT_EQ(at("hysteresis"), (std::vector<std::string>{"u", "stage"}));
}

}  // namespace
}  // namespace hysteron
