// Every effect can be shown without data: what comes out with it differs from what comes out without it.
#include "discover/demonstration/demonstration.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "blocks/register_all.h"
#include "discover/demonstration/demo_rig.h"
#include "discover/effects/all.h"
#include "discover/hypotheses/effect_file.h"

namespace hysteron {
namespace {

class Demonstrations : public ::testing::Test {
 protected:
  Demonstration of(const std::string& id) { return demonstrate(effects.get(id), effects, registry); }
  Registry registry = all_blocks();
  Effects effects = all_effects();
};

TEST_F(Demonstrations, OfEveryEffectDifferFromTheBypass) {
  for (const auto& effect : effects.list()) {
    const Demonstration d = demonstrate(effect, effects, registry);
    // One per cent of the signal is the least that a picture shows (its largest row may lie between two points of the
    // picture); what is more than all of it hides the signal.
    EXPECT_GE(d.share(), 0.009) << effect.id;
    EXPECT_LE(d.share(), 1) << effect.id;
    EXPECT_EQ(d.with.size(), d.t.size()) << effect.id;
    EXPECT_EQ(d.without.size(), d.t.size()) << effect.id;
    EXPECT_EQ(d.side.empty(), effect.side == Side::none) << effect.id;
    EXPECT_TRUE(std::all_of(d.with.begin(), d.with.end(), [](double v) { return std::isfinite(v); })) << effect.id;
    if (d.device.empty()) {
      EXPECT_EQ(d.without, d.in) << effect.id << ": the bypass of a wire is the wire";
    }
  }
}

TEST_F(Demonstrations, ShowWhatTheEffectIsKnownBy) {
  const Demonstration lag = of("amplifier_lag");
  EXPECT_FALSE(lag.against_input);
  // A lag of one row settles to 2 % within four rows of 10 ms: the picture does not show the other 100 s.
  EXPECT_LT(lag.t.back() - lag.t.front(), 0.2);
  EXPECT_NEAR(lag.with.back(), lag.without.back(), 0.02 * lag.span);

  const Demonstration creep = of("creep");
  EXPECT_TRUE(creep.log_time);  // a decade brings as much as the one before
  EXPECT_GT(creep.t.back() / creep.t.front(), 1000);
  const auto at = [&](double share) { return creep.difference()[static_cast<std::size_t>(share * 799)]; };
  // 0.5 % of the move in each relaxation, two a decade. Between half and all of the two upper decades lie 4 or 5.
  EXPECT_NEAR(at(1) - at(0.5), 0.0225 * creep.span, 0.005 * creep.span);

  EXPECT_TRUE(of("hysteresis").against_input);
  EXPECT_TRUE(of("saturation").against_input);
  EXPECT_EQ(of("stiffening").device, "mass_spring_damper");
  EXPECT_EQ(of("rate_dependence").device, "prandtl_ishlinskii");
}

TEST_F(Demonstrations, KnowTheValuesWithWhichNothingChanges) {
  const auto text = [](const Demonstration& d) {
    std::string all;
    for (const auto& v : d.null_value) all += (all.empty() ? "" : ", ") + v.parameter + " " + v.value;
    return all;
  };
  for (const auto& [id, null_value] : std::vector<std::pair<std::string, std::string>>{
           {"calibration", "gain 1, offset 0"},
           {"creep", "per_decade 0"},
           {"amplifier_lag", "times towards 0"},  // 0 itself is no time constant
           {"saturation", "lower towards -inf, upper towards inf"},
           {"hysteresis", "weights[0] 1, the other weights 0"},
           {"structural_resonance", "positions 0, velocities 0"},  // the picture shows a mode without velocities
           {"sensor_nonlinearity", "coefficients[2] 0, coefficients[3] 0"},
           {"pyro_charge_drift", "coefficient 0"}})
    EXPECT_EQ(text(of(id)), null_value) << id;
}

TEST_F(Demonstrations, OfATemperatureGainFollowTheTemperatureTimesTheSignal) {
  const Demonstration d = of("temperature_gain");
  const auto difference = d.difference();
  // The law itself: (T - T0) * share * u, T0 where a model is usually made, a little above the coldest of 20 to
  // 40 degC, 0.1 % per kelvin.
  for (std::size_t i = 0; i < d.t.size(); i += 50)
    EXPECT_NEAR(difference[i], 1e-3 * (d.side[i] - 296.15) * d.in[i], 1e-9 * d.span) << d.t[i];
}

/// A gear reads four signals, in units of its own: its driver turns, all else is at rest.
TEST_F(Demonstrations, OfWhatVariesAMachineDriveItInItsUnit) {
  Effect play = effects.get("backlash");
  play.way = Way::vary;
  const Demonstration d = demonstrate(play, effects, registry);
  EXPECT_EQ(d.device, "gear");
  EXPECT_EQ(d.in_unit.dimension, parse_unit("rad").dimension);
  EXPECT_EQ(d.out_unit.dimension, parse_unit("N m").dimension);
  EXPECT_GE(d.share(), 0.009);
}

/// A user's own effects are shown as the others are: those that come with the program.
TEST_F(Demonstrations, OfEffectsOfAUserDifferFromTheBypass) {
  const std::string folder = std::string(HYSTERON_SOURCE_DIR) + "/diagrams/effects";
  const Effects all = with_own_effects(effects, {folder}, registry);
  ASSERT_GT(all.list().size(), effects.list().size());
  for (const auto& effect : all.list())
    if (!effect.file.empty()) {
      EXPECT_GE(demonstrate(effect, all, registry).share(), 0.009) << effect.id;
    }
}

TEST_F(Demonstrations, OfAnEffectThatDoesNothingAreRefused) {
  Effect idle = effects.get("calibration");
  idle.laws = [gain = idle.laws](const Excitation& at) {
    auto laws = gain(at);
    laws.front().free.clear();  // its start values are those of the bypass
    return laws;
  };
  EXPECT_THROW((void)demonstrate(idle, effects, registry), Error);
}

}  // namespace
}  // namespace hysteron
