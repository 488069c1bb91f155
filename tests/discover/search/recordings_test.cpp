// Discovery on recordings that nobody here made. Skipped, visibly, where ../shared is absent.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "blocks/register_all.h"
#include "discover/effects/all.h"
#include "discover/selection/discover.h"
#include "io/diagram/diagram_file.h"
#include "tests/discover/dev_case.h"

namespace hysteron {
namespace {

using namespace testing;

class Recordings : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!shared_is_there()) GTEST_SKIP() << "../shared is not there: " << HYSTERON_SHARED_DIR;
  }
  Discovery found(const Case& c) {
    DiscoverOptions options;
    options.numbers_are_exact = c.numbers_are_exact;
    return discover(c.diagram, c.data, registry, effects, options);
  }
  void expect_named(const std::string& id, const std::string& effect) {
    const Discovery d = found(dev_case(id));
    SCOPED_TRACE(tried(d));
    EXPECT_EQ(to_text(d.verdict), "missing_effect") << d.headline;
    ASSERT_FALSE(d.steps.empty());
    for (const auto& step : d.steps) EXPECT_EQ(step.winner.effect, effect) << d.headline;
    EXPECT_EQ(to_text(d.remainder), "noise");
    EXPECT_LE(d.final_error.rms_validate, 1.15 * noise_floor(id)) << d.headline;
    for (const auto& p : d.steps.back().winner.found) {
      const auto& e = p.estimate;
      const bool ends = !e.determined || e.at_lower || e.at_upper;
      EXPECT_TRUE(ends || (e.low95 && e.high95)) << "no interval of " << e.path;
    }
  }
  /// What was tried, for who has to find out why an answer is wrong.
  static std::string tried(const Discovery& d) {
    std::string text = "tried:";
    for (const auto& c : d.candidates)
      text += "\n  " + std::to_string(c.step) + " " + c.effect + " at " + c.place + ": " + c.summary + "; " + c.reason;
    for (const auto& r : d.refused) text += "\n  refused " + r.effect + " at " + r.place + ": " + r.reason;
    return text;
  }
  Registry registry = all_blocks();
  Effects effects = all_effects();
};

TEST_F(Recordings, Case003LacksCreep) { expect_named("003", "creep"); }
TEST_F(Recordings, Case006LacksHysteresis) { expect_named("006", "hysteresis"); }
TEST_F(Recordings, Case010LacksCreep) { expect_named("010", "creep"); }
TEST_F(Recordings, Case012LacksTheLagOfTheAmplifier) { expect_named("012", "amplifier_lag"); }

TEST_F(Recordings, Case007LacksAResonance) { expect_named("007", "structural_resonance"); }
TEST_F(Recordings, Case009LacksAResonance) { expect_named("009", "structural_resonance"); }
TEST_F(Recordings, Case013LacksTheOtherAxis) { expect_named("013", "cross_coupling"); }  // one way and the other
TEST_F(Recordings, Case015LacksThermalExpansion) { expect_named("015", "thermal_expansion"); }
TEST_F(Recordings, Case014LacksTheLagOfTheAmplifier) { expect_named("014", "amplifier_lag"); }
TEST_F(Recordings, Case011LacksFriction) { expect_named("011", "friction"); }

TEST_F(Recordings, Case004IsAdequate) {
  const Discovery d = found(dev_case("004"));
  EXPECT_EQ(to_text(d.verdict), "adequate") << d.headline;
  EXPECT_TRUE(d.steps.empty());
}

/// A model and a data set of benchmarks/measured, as a user wrote them.
Case measured(const std::string& model, const std::string& data) {
  const std::string folder = HYSTERON_SOURCE_DIR "/benchmarks/measured/";
  return {read_diagram(folder + model + ".json"), read_dataset(folder + data + ".data.json", {shared("")})};
}

TEST_F(Recordings, AnInputThatIsHeldOnPaperOnlyIsToldFromWhatFitsBetter) {
  Case c = measured("silverbox", "silverbox_held");
  DiscoverOptions options;
  options.only = {"calibration"};
  options.max_steps = 1;
  const auto said = [](const Discovery& d) {
    return std::any_of(d.warnings.begin(), d.warnings.end(),
                       [](const std::string& w) { return w.starts_with("u moves linearly between its samples"); });
  };
  EXPECT_TRUE(said(discover(c.diagram, c.data, registry, effects, options)));
  c.data.notes["u"].between = Between::linear;
  EXPECT_FALSE(said(discover(c.diagram, c.data, registry, effects, options)));
}

}  // namespace
}  // namespace hysteron
