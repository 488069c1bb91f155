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
  void expect_named(const std::string& id, const std::string& effect, std::size_t steps = 1) {
    const Discovery d = found(dev_case(id));
    SCOPED_TRACE(tried(d));
    EXPECT_EQ(to_text(d.verdict), "missing_effect") << d.headline;
    ASSERT_FALSE(d.steps.empty());
    for (const auto& step : d.steps) EXPECT_EQ(step.winner.effect, effect) << d.headline;
    EXPECT_EQ(d.steps.size(), steps) << d.headline;
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

TEST_F(Recordings, Case005LacksThermalExpansion) { expect_named("005", "thermal_expansion"); }
TEST_F(Recordings, Case007LacksAResonance) { expect_named("007", "structural_resonance"); }
TEST_F(Recordings, Case009LacksAResonance) { expect_named("009", "structural_resonance"); }
TEST_F(Recordings, Case013LacksTheOtherAxis) {
  expect_named("013", "cross_coupling", 2);  // one way and the other
}
TEST_F(Recordings, Case015LacksThermalExpansion) { expect_named("015", "thermal_expansion"); }
TEST_F(Recordings, Case016LacksSaturation) {
  const Discovery d = found(dev_case("016"));
  SCOPED_TRACE(tried(d));
  ASSERT_FALSE(d.steps.empty());
  EXPECT_EQ(d.steps.front().winner.effect, "saturation") << d.headline;
  EXPECT_EQ(d.steps.size(), 1u) << d.headline;
  // A knee or the plant's own constants: a third of the noise floor is left, and told as structure.
  EXPECT_EQ(to_text(d.remainder), "structured");
  EXPECT_LT(d.final_error.rms_validate, 0.01 * d.base.rms_validate);
}

TEST_F(Recordings, Case014LacksTheLagOfTheAmplifier) { expect_named("014", "amplifier_lag"); }
TEST_F(Recordings, Case011LacksFriction) { expect_named("011", "friction"); }

class LongRecordings : public Recordings {};  // a spring that remembers is integrated for each trial
TEST_F(LongRecordings, Case002LacksHysteresisInItsSpring) {
  const Discovery d = found(dev_case("002"));
  SCOPED_TRACE(tried(d));
  ASSERT_EQ(d.steps.size(), 1u) << d.headline;
  EXPECT_EQ(d.steps.front().winner.effect, "hysteresis") << d.headline;
  EXPECT_EQ(d.steps.front().winner.place, "stage") << "in the spring: plays on the drive would ring along";
  // Six elements of another law than the hidden one: less than a hundredth of what was there (its rms is 187 times the
  // noise) may be left.
  EXPECT_LT(d.final_error.rms_validate, 0.05 * d.base.rms_validate);
}

/// Verdict, and for each step who may be it: names in a tie change places without any difference.
std::vector<std::string> answer_of(const Discovery& d) {
  std::vector<std::string> answer{to_text(d.verdict)};
  for (const auto& step : d.steps) {
    std::vector<std::string> names{step.winner.effect};
    for (const auto& tie : step.ties) names.push_back(tie.effect);
    std::sort(names.begin(), names.end());
    answer.push_back(fmt::format("{}", fmt::join(names, " or ")));
  }
  return answer;
}

// Of each plant one, all effects: linear rows, a memory, nonlinear states, two inputs.
TEST_F(LongRecordings, TheAnswerIsTheSameWithTenTimesLooserOrTighterTolerances) {
  for (const char* id : {"001", "003", "008", "011", "013", "015", "016"}) {
    const Case c = dev_case(id);
    const auto with = [&](double looser) {
      DiscoverOptions options;
      options.looser = looser;
      options.numbers_are_exact = c.numbers_are_exact;
      return answer_of(discover(c.diagram, c.data, registry, effects, options));
    };
    const auto usual = with(1);
    for (const double looser : {10.0, 0.1}) EXPECT_EQ(with(looser), usual) << id << ", " << looser << " times looser";
  }
}

TEST_F(Recordings, Case001CannotTellExpansionFromCreepUnlessTheTemperatureIsHeld) {
  const Discovery d = found(dev_case("001"));
  SCOPED_TRACE(tried(d));
  EXPECT_EQ(to_text(d.verdict), "not_distinguishable") << d.headline;
  ASSERT_EQ(d.steps.size(), 1u);
  std::vector<std::string> all{d.steps.front().winner.effect};
  for (const auto& t : d.steps.front().ties) all.push_back(t.effect);
  std::sort(all.begin(), all.end());
  EXPECT_EQ(all, (std::vector<std::string>{"creep", "thermal_expansion"}));
  ASSERT_TRUE(d.experiment.has_value());
  EXPECT_TRUE(d.experiment->word == "temperature_constant" || d.experiment->word == "temperature_staircase")
      << d.experiment->word << ": in any other the temperature does what it likes";
}

TEST_F(Recordings, Case004IsAdequate) {
  const Discovery d = found(dev_case("004"));
  EXPECT_EQ(to_text(d.verdict), "adequate") << d.headline;
  EXPECT_TRUE(d.steps.empty());
}

TEST_F(Recordings, Case008JumpsWithoutAnyKnownCause) {
  const Discovery d = found(dev_case("008"));
  EXPECT_EQ(to_text(d.verdict), "unexplained") << d.headline;
  ASSERT_TRUE(d.structure.has_value());
  EXPECT_EQ(d.structure->kind, "jumps");
}

/// A model and a data set of benchmarks/measured, as a user wrote them.
Case measured(const std::string& model, const std::string& data) {
  const std::string folder = HYSTERON_SOURCE_DIR "/benchmarks/measured/";
  return {read_diagram(folder + model + ".json"), read_dataset(folder + data + ".data.json", {shared("")})};
}

std::vector<std::string> names_of(const FoundStep& step) {
  std::vector<std::string> list{step.winner.effect};
  for (const auto& t : step.ties) list.push_back(t.effect);
  std::sort(list.begin(), list.end());
  return list;
}

TEST_F(Recordings, PiezoStackLacksHysteresisThenADelayThenAnAsymmetry) {
  const Discovery d = found(measured("piezo_stack", "piezo_stack"));
  SCOPED_TRACE(tried(d));
  EXPECT_EQ(to_text(d.verdict), "missing_effect") << d.headline;
  EXPECT_NEAR(d.base.nrmse_validate, 0.18, 0.005) << "its README: 18.3 %, of the whole file";
  ASSERT_EQ(d.steps.size(), 3u) << d.headline;
  EXPECT_EQ(d.steps[0].winner.effect, "hysteresis") << d.headline << ": a lag imitates the major loop";
  EXPECT_LE(d.steps[0].after.nrmse_validate, 0.04);
  const auto delay = names_of(d.steps[1]), curve = names_of(d.steps[2]);
  for (const char* one : {"amplifier_lag", "dead_time"})
    EXPECT_TRUE(std::binary_search(delay.begin(), delay.end(), one)) << one << ": one rate and one frequency";
  EXPECT_TRUE(std::binary_search(curve.begin(), curve.end(), "asymmetry"));
  EXPECT_LE(d.final_error.nrmse_validate, 0.021) << "its README by hand: 3.6, 2.15, 1.6 %, of the whole file";
}

TEST_F(Recordings, HeaterLacksALagOrADeadTimeAndNobodyCanTell) {
  const Discovery d = found(heater());
  EXPECT_EQ(to_text(d.verdict), "not_distinguishable") << d.headline;
  ASSERT_EQ(d.steps.size(), 1u) << d.headline;
  EXPECT_EQ(names_of(d.steps.front()), (std::vector<std::string>{"amplifier_lag", "dead_time"}));
  EXPECT_NEAR(d.base.nrmse_validate, 0.39, 0.02) << "its README: 39 %";
  EXPECT_LE(d.final_error.nrmse_validate, 0.06);
  EXPECT_TRUE(d.experiment.has_value());
  EXPECT_FALSE(d.warnings.empty()) << "a single recording is weak evidence, and that is said";
}

TEST_F(Recordings, DampersHaveFrictionAndNoHysteresisBesides) {
  for (const char* series : {"a", "b", "v"}) {
    const Discovery d = found(measured("mr_damper", std::string("mr_damper_") + series));
    SCOPED_TRACE(tried(d));
    ASSERT_EQ(d.steps.size(), 1u) << series << ": " << d.headline;
    EXPECT_EQ(d.steps.front().winner.effect, "friction") << d.headline;
    EXPECT_GT(d.base.nrmse_validate, 0.33) << "its README: 33-39 %";
    EXPECT_LT(d.final_error.nrmse_validate, 0.135) << "its README: the better of two laws by hand, 13.5-15 %";
  }
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
