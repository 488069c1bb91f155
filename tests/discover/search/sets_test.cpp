// Of effects that act together each is named, and nothing that imitates several of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "discover/selection/discover.h"
#include "engine/diagram/error.h"
#include "tests/discover/discoveries.h"
#include "tests/discover/synthetic.h"

namespace hysteron {
namespace {

using namespace testing;

/// A joint with a gap: the driven side moves when the gap is crossed.
std::vector<double> across_a_gap(const std::vector<double>& u, double half) {
  std::vector<double> y;
  double at = u.front();
  for (const double v : u) y.push_back(at = std::max(v - half, std::min(v + half, at)));
  return y;
}

/// A lag of `tau` rows behind straight lines between rows.
std::vector<double> behind_a_lag(const std::vector<double>& u, double tau) {
  std::vector<double> y{u.front()};
  for (std::size_t k = 1; k < u.size(); ++k) {
    const double late = (u[k] - u[k - 1]) * tau;  // in the end, on this line
    y.push_back(u[k] - late + (y.back() - u[k - 1] + late) * std::exp(-1 / tau));
  }
  return y;
}

class Sets : public Discoveries {
 protected:
  /// Sines of several amplitudes through `law`; two recordings train, one judges.
  static DataSet seen_through(const std::function<std::vector<double>(const std::vector<double>&)>& law) {
    constexpr double white = 2e-4;
    std::vector<Recording> list;
    std::uint64_t seed = 40;
    for (const auto& [role, top] : {std::pair{Role::train, 1.0}, {Role::train, 0.5}, {Role::validate, 0.8}}) {
      const auto t = rows(1500, 0.005);
      const auto u = decaying_triangle(t, top, 6);
      auto y = law(u);
      const auto n = noise(t.size(), white, 0.1 * white, seed++);
      for (std::size_t k = 0; k < y.size(); ++k) y[k] += n[k];
      list.push_back(recording(std::to_string(seed) + ".csv", role, t, u, std::move(y)));
    }
    return data_set(std::move(list), white);
  }
  Discovery found(const DataSet& data, const std::vector<std::string>& only) {
    DiscoverOptions options;
    options.only = only;
    return discover(plain_gain(), data, registry, effects, options);
  }
  static std::set<std::string> names(const Discovery& d) {
    std::set<std::string> list;
    for (const auto& s : d.steps) list.insert(s.winner.effect);
    return list;
  }
};

TEST_F(Sets, WhatBeganWithALookAlikeBeginsAgain) {
  // Many plays imitate a gap before a curve better than the gap alone does, and nothing goes on from there; the gap and
  // the curve together leave nothing.
  const auto data = seen_through([](const std::vector<double>& u) {
    auto y = across_a_gap(u, 0.03);
    for (auto& v : y) v += 0.08 * v * v;
    return y;
  });
  const Discovery d = found(data, {"hysteresis", "backlash", "sensor_nonlinearity"});
  EXPECT_EQ(names(d), (std::set<std::string>{"backlash", "sensor_nonlinearity"})) << [&] {
    std::string s = d.headline;
    for (auto& c : d.candidates)
      s += "\n" + std::to_string(c.step) + " " + c.effect + " at " + c.place + " " + std::to_string(c.fall_validate) +
           " score " + std::to_string(c.score) + " " + c.reason;
    return s;
  }();
  EXPECT_EQ(d.remainder, Remainder::noise);
  // The steps are those of the set that is left: each falls, and the last one is the final model.
  ASSERT_EQ(d.steps.size(), 2u);
  EXPECT_LT(d.steps[1].after.chi2_validate, d.steps[0].after.chi2_validate);
  EXPECT_NEAR(d.steps[1].after.chi2_validate, d.final_error.chi2_validate, 1e-9 * d.final_error.chi2_validate);
  EXPECT_TRUE(std::none_of(d.candidates.begin(), d.candidates.end(),
                           [](const Candidate& c) { return c.effect == "hysteresis" && c.claimed; }));
}

TEST_F(Sets, WhatStoodForGainAndZeroAloneIsACalibration) {
  // Plays are late by a part of the stroke and find gain and zero anew: alone they explain more than a calibration or a
  // lag. Beside the lag only gain and zero are left for them.
  const auto data = seen_through([](const std::vector<double>& u) {
    auto y = behind_a_lag(u, 0.6);
    for (auto& v : y) v = 1.01 * v + 2e-4;
    return y;
  });
  const Discovery d = found(data, {"hysteresis", "amplifier_lag", "calibration"});
  EXPECT_EQ(names(d), (std::set<std::string>{"amplifier_lag", "calibration"})) << tried(d);
}

TEST_F(Sets, WhoCouldHoldAnotherEffectBesideItsOwnIsNotTakenForBoth) {
  // Plays of a bent drive take a curve up and imitate a lag; beside the lag there is nothing left of their own.
  const DataSet data = seen_through([](std::vector<double> u) {
    for (auto& v : u) v += 0.05 * v * (1 - v);
    return behind_a_lag(u, 0.6);
  });
  const Discovery d = found(data, {"hysteresis", "asymmetry", "amplifier_lag"});
  EXPECT_EQ(names(d), (std::set<std::string>{"amplifier_lag", "asymmetry"})) << tried(d);
}

TEST_F(Sets, ACurveThatACubicDoesNotHoldIsOneOfHigherOrderBesideALag) {
  const DataSet data = seen_through([](std::vector<double> u) {
    for (auto& v : u) v += 0.004 * v * (5 - v * v * (20 - 16 * v * v));
    return behind_a_lag(u, 0.6);
  });
  const Discovery d = found(data, {"hysteresis", "asymmetry", "amplifier_lag"});
  EXPECT_EQ(names(d), (std::set<std::string>{"amplifier_lag", "asymmetry"})) << tried(d);
  EXPECT_LT(d.final_error.over_floor(), rules::floor_gate) << tried(d);
}

TEST_F(Sets, TheZeroOfASensorWithACurveBehindALagIsTheCurves) {
  const auto data = seen_through([](const std::vector<double>& u) {
    auto y = behind_a_lag(u, 0.6);
    for (auto& v : y) v = v + 0.05 * v * v + 0.01;
    return y;
  });
  const Discovery d = found(data, {"calibration", "sensor_nonlinearity", "amplifier_lag"});
  EXPECT_EQ(names(d), (std::set<std::string>{"sensor_nonlinearity", "amplifier_lag"})) << tried(d);
  EXPECT_LT(d.final_error.over_floor(), rules::floor_gate) << tried(d);
}

TEST_F(Sets, WhatExplainsTheSameIsToldAsATie) {
  // A lag of a third of a row: a delay of the same time differs from it by less than the noise.
  const DataSet data = seen_through([](const auto& u) { return behind_a_lag(u, 0.3); });
  const Discovery d = found(data, {"amplifier_lag", "dead_time", "saturation"});
  ASSERT_EQ(d.steps.size(), 1u) << tried(d);
  ASSERT_EQ(d.steps.front().ties.size(), 1u) << tried(d);
  const std::set<std::string> both{d.steps.front().winner.effect, d.steps.front().ties.front().effect};
  EXPECT_EQ(both, (std::set<std::string>{"amplifier_lag", "dead_time"}));
  EXPECT_TRUE(d.steps.front().experiment.has_value());
}

TEST_F(Sets, NothingIsClaimedOfWhichNotAllWereAskedOnceItIsEnough) {
  const DataSet data = seen_through([](const auto& u) {
    auto y = across_a_gap(u, 0.02);
    for (double& v : y) v += 0.004 * v * (1 - v);
    return y;
  });
  bool begun = false;
  DiscoverOptions options;
  options.only = {"backlash", "sensor_nonlinearity"};
  options.progress = [&](const std::string& what, double) { begun = begun || what.starts_with("step 2"); };
  options.spent = [&] { return begun ? 1.0 : 0.0; };
  const Discovery d = discover(plain_gain(), data, registry, effects, options);
  EXPECT_TRUE(d.broken_off);
  ASSERT_EQ(d.steps.size(), 1u);
  EXPECT_EQ(d.steps.front().winner.effect, "backlash");
}

TEST_F(Sets, WhatWasFoundStaysFoundWhereTheSearchForMoreFails) {
  const DataSet data = seen_through([](const auto& u) {
    auto y = across_a_gap(u, 0.02);
    for (double& v : y) v += 0.004 * v * (1 - v);
    return y;
  });
  DiscoverOptions options;
  options.only = {"backlash", "sensor_nonlinearity"};
  ASSERT_EQ(found(data, options.only).steps.size(), 2u);
  options.progress = [](const std::string& what, double) {
    if (what.starts_with("step 2")) fail_numerics("numerics.step", "stage.y", "no step is small enough", "none");
  };
  const Discovery d = discover(plain_gain(), data, registry, effects, options);
  ASSERT_EQ(d.steps.size(), 1u);
  EXPECT_EQ(d.steps.front().winner.effect, "backlash");
  EXPECT_EQ(to_text(d.verdict), "missing_effect");
  EXPECT_NEAR(d.final_error.rms_validate, d.steps.front().after.rms_validate, 1e-12);
  ASSERT_FALSE(d.warnings.empty());
  EXPECT_TRUE(std::any_of(d.warnings.begin(), d.warnings.end(), [](const std::string& w) {
    return w.find("ended early") != std::string::npos && w.find("no step is small enough") != std::string::npos;
  })) << d.warnings.front();
}

}  // namespace
}  // namespace hysteron
