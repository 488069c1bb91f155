// Single rules of the procedure, each on the smallest recordings that need it. Without its rule each of these fails.
#include <gtest/gtest.h>

#include <algorithm>

#include "discover/models/own_resonances.h"
#include "discover/placement/excitation.h"
#include "engine/program/program.h"
#include "tests/discover/discoveries.h"
#include "tests/discover/two_axes.h"

namespace hysteron {
namespace {

using namespace testing;
using std::numbers::pi;

class Rules : public Discoveries {};

/// u -> gain 1 m/V -> sensor with a gain and a zero of its own -> y, exact.
Diagram gain_and_sensor() {
  Diagram d = plain_gain();
  Node& sensor = d.blocks["sensor"];
  sensor.type = "calibration";
  sensor.parameters["gain"] = Value(1.0);
  sensor.parameters["offset"] = Value("0 m");
  sensor.in = {{"", "stage"}};
  d.outputs["y"] = "sensor";
  return d;
}

// --- calibration -----------------------------------------------------------------------------------------------------

TEST_F(Rules, AZeroThatALawBringsAlongIsLeftToTheCalibration) {
  std::vector<Recording> list;
  std::uint64_t seed = 10;
  for (auto& m : motions()) {
    auto y = noise(m.t.size(), 1e-3, 1e-4, seed);
    for (std::size_t k = 0; k < y.size(); ++k) y[k] += m.u[k] + 0.05;
    list.push_back(recording(std::to_string(seed++) + ".csv", m.role, m.t, m.u, y));
  }
  const Discovery d = discovered(gain_and_sensor(), data_set(list, 1e-3),
                                 {"calibration", "backlash", "asymmetry", "hysteresis", "sensor_nonlinearity"});
  ASSERT_EQ(d.steps.size(), 1U) << tried(d);
  EXPECT_EQ(d.steps.front().winner.effect, "calibration") << tried(d);
  EXPECT_TRUE(d.steps.front().ties.empty()) << tried(d);
}

/// A sensor of this gain, in recordings of these strokes and ages: each of the gain that it had at its age.
DataSet of_ages(const std::vector<std::pair<double, double>>& strokes_and_cycles,
                const std::function<double(double cycles)>& gain) {
  std::vector<Recording> list;
  std::uint64_t seed = 40;
  for (const auto& [stroke, cycles] : strokes_and_cycles) {
    const auto t = rows(800, 0.005);
    const auto u = several_sines(t, stroke, {0.6 + 0.01 * static_cast<double>(seed), 5.2});
    auto y = noise(t.size(), 1e-3, 1e-4, seed++);
    for (std::size_t k = 0; k < y.size(); ++k) y[k] += gain(cycles) * u[k];
    const Role role = list.size() < 2 ? Role::train : Role::validate;
    list.push_back(recording(std::to_string(seed) + ".csv", role, t, u, y));
    list.back().columns[column_of_cycles].assign(t.size(), cycles);
    list.back().units[column_of_cycles] = parse_unit("");
  }
  DataSet data = data_set(std::move(list), 1e-3);
  data.notes[column_of_cycles].to = column_of_cycles;
  return data;
}

TEST_F(Rules, AGainThatIsWrongIsPlainerThanOneThatChangesWithUse) {
  const std::vector<std::string> both{"ageing", "calibration"};
  const std::vector<std::pair<double, double>> runs{{0.02, 100}, {1, 1e4}, {1, 1e4}};
  // Only what is too small to show anything was recorded early: both explain it, and ageing needs a number less.
  const Discovery wrong = diagnosed(gain_and_sensor(), of_ages(runs, [](double) { return 0.9991; }), both, exact());
  EXPECT_EQ(winner(wrong), "calibration") << tried(wrong);
  ASSERT_FALSE(wrong.steps.empty());
  ASSERT_EQ(wrong.steps[0].ties.size(), 1u) << tried(wrong);
  EXPECT_EQ(wrong.steps[0].ties[0].effect, "ageing");
  // What was recorded early at full stroke tells.
  const std::vector<std::pair<double, double>> told{{1, 100}, {1, 1e4}, {1, 1e6}};
  const auto by_decades = [](double n) { return 1 - 5e-4 * std::log10(1 + n / 100); };
  const Discovery aged = diagnosed(gain_and_sensor(), of_ages(told, by_decades), both, exact());
  EXPECT_EQ(winner(aged), "ageing") << tried(aged);
}

TEST_F(Rules, AModeAtTheModelsOwnResonanceIsNoFurtherOne) {
  Diagram plant = mass_on_spring();  // 1 kg on 400 N/m
  plant.blocks["stage"].parameters["damping"] = Value("2 N*s/m");
  const auto own = own_resonances(*compile(plant, registry));
  ASSERT_EQ(own.size(), 1u);
  EXPECT_NEAR(own[0].frequency, 20 / (2 * pi), 1e-9);
  EXPECT_NEAR(own[0].damping, 2 / (2 * 20.0), 1e-9);
  const Effect& mode = *effects.find("structural_resonance");
  Excitation at;
  const auto law = mode.laws(at).front();
  const std::vector<double> near{3.3, 0.03, 0.01, 0}, far{3.8, 0.03, 0.01, 0};  // half widths: 0.25 Hz together
  EXPECT_EQ(mode.implausible(law, near, at), "") << "a first effect may stand anywhere";
  at.own_resonances = own;
  EXPECT_NE(mode.implausible(law, near, at).find("the model's own resonance"), std::string::npos);
  EXPECT_EQ(mode.implausible(law, far, at), "");
}

// --- lines, curves and pasts

TEST_F(Rules, ACurveOfAsManyNumbersThatFitsBetterIsNoLine) {
  // A lag of 160 times the noise may leave 1.5 % of it, which is more than a gain and a zero leave of the curve before
  // it. Behind a play no zero is found for a curve: slope and bend are two numbers, gain and zero are.
  std::vector<Recording> list;
  std::uint64_t seed = 70;
  for (const Role role : {Role::train, Role::train, Role::validate}) {
    const auto t = rows(1500, 0.005);
    const auto u = decaying_triangle(t, 1, 6);
    std::vector<double> y;
    double slow = 0;
    for (const double v : lagged(t, u, 0.01)) {
      const double bent = v + 0.002 * v * v;
      slow = std::max(bent - 0.3, std::min(bent, slow));
      y.push_back(bent + 0.1 * slow);
    }
    y = plus(y, noise(t.size(), 2e-4, 2e-5, seed++));
    list.push_back(recording(std::to_string(seed) + ".csv", role, t, u, y));
  }
  Diagram stage = gain_and_sensor();
  Node plays;
  plays.type = "prandtl_ishlinskii";
  plays.in = stage.blocks["stage"].in;
  plays.parameters["thresholds"] = Value(NumberList{Number{0, "V"}, Number{0.3, "V"}});
  plays.parameters["weights"] = Value(NumberList{Number{1, "m/V"}, Number{0.1, "m/V"}});
  stage.blocks["stage"] = plays;
  const Discovery d = discovered(stage, data_set(list, 2e-4), {"amplifier_lag", "calibration", "asymmetry"});
  ASSERT_EQ(d.steps.size(), 2u) << tried(d);
  EXPECT_EQ(d.steps[0].winner.effect, "amplifier_lag") << tried(d);
  EXPECT_EQ(d.steps[1].winner.effect, "asymmetry") << tried(d);
}

TEST_F(Rules, ASmallGainBesideAnAgeingDeviceIsNoOtherEffects) {
  // The counter may have begun when some use had gone by: an uncounted part of the first decade is a gain.
  const std::vector<std::pair<double, double>> runs{{1, 0}, {1, 1e3}, {1, 1e4}, {1, 1e5}};
  const auto gain = [](double n) { return 0.999 * (1 - 0.011 * std::log10(1 + n / 100)); };
  const Discovery d = discovered(gain_and_sensor(), of_ages(runs, gain), {"ageing", "calibration", "asymmetry"});
  EXPECT_EQ(d.steps.size(), 1u) << tried(d);
  EXPECT_EQ(winner(d), "ageing") << tried(d);
}

// --- slow noise ------------------------------------------------------------------------------------------------------

TEST_F(Rules, SlowNoiseThatNoStructureExplainsIsNoUnexplainedModel) {
  // The data sheet knows of 0.3 times as much 1/f noise as white; there is 0.9 times as much, and nothing else.
  std::vector<Recording> list;
  std::uint64_t seed = 30;
  for (auto& m : motions()) {
    list.push_back(
        recording(std::to_string(seed) + ".csv", m.role, m.t, m.u, plus(m.u, noise(m.t.size(), 1e-3, 0.9e-3, seed))));
    ++seed;
  }
  const Discovery d = discovered(plain_gain(), data_set(list, 1e-3), {"amplifier_lag", "saturation"});
  EXPECT_GT(d.base.over_floor(), 1.12) << "the noise is not slow enough to be taken for structure";
  EXPECT_TRUE(d.steps.empty()) << tried(d);
  EXPECT_EQ(to_text(d.verdict), "adequate") << d.headline;
}

// --- look-alikes -----------------------------------------------------------------------------------------------------

/// A delay of 2.6 ms and two lags [s], sampled every 5 ms.
DataSet late_and_lagged(double first, double second) {
  std::vector<Recording> list;
  std::uint64_t seed = 60;
  for (auto& m : motions()) {
    const double dead = 2.6e-3;
    const auto u_late = sampled(m.t, [&](double x) {
      if (x <= dead) return m.u.front();
      const auto k = static_cast<std::size_t>((x - dead) / 0.005);
      const double part = (x - dead) / 0.005 - static_cast<double>(k);
      return k + 1 < m.u.size() ? (1 - part) * m.u[k] + part * m.u[k + 1] : m.u.back();
    });
    list.push_back(
        recording(std::to_string(seed) + ".csv", m.role, m.t, m.u,
                  plus(lagged(m.t, lagged(m.t, u_late, first), second), noise(m.t.size(), 1e-3, 1e-4, seed))));
    ++seed;
  }
  return data_set(list, 1e-3);
}

TEST_F(Rules, ALookAlikeIsFittedTogetherWithWhatStands) {
  // The lag that is found first takes up the delay in its own time: with that time held, a delay brings little.
  const Discovery d = discovered(plain_gain(), late_and_lagged(12e-3, 6e-3), {"amplifier_lag", "dead_time"});
  ASSERT_EQ(d.steps.size(), 2U) << tried(d);
  EXPECT_EQ(d.steps[0].winner.effect, "amplifier_lag") << tried(d);
  EXPECT_EQ(d.steps[1].winner.effect, "dead_time") << tried(d);
}

// --- the next experiment ---------------------------------------------------------------------------------------------

/// A lag under slow triangles, sampled every 50 ms: a distance to the drive that is the same for a delay.
DataSet slow_recordings(int n, double time = 1e-3, double white = 5e-4) {
  std::vector<Recording> list;
  std::uint64_t seed = 80;
  for (int i = 0; i < n; ++i) {
    const auto t = rows(600, 0.05);
    const auto u = decaying_triangle(t, 1 - 0.05 * i, 6 + i);
    list.push_back(recording(std::to_string(seed) + ".csv", i % 2 == 0 ? Role::train : Role::validate, t, u,
                             plus(lagged(t, u, time), noise(t.size(), white, white / 10, seed))));
    ++seed;
  }
  return data_set(list, white);
}

TEST_F(Rules, AfterFewRecordingsTheExperimentMayBeSampledFaster) {
  const Discovery few = discovered(plain_gain(), slow_recordings(2, 5e-3), {"amplifier_lag", "dead_time"});
  ASSERT_EQ(few.steps.size(), 1U) << tried(few);
  EXPECT_EQ(few.steps.front().ties.size(), 1U) << tried(few);
  EXPECT_EQ(to_text(few.verdict), "not_distinguishable") << few.headline;
  ASSERT_TRUE(few.experiment) << few.headline;
  EXPECT_GT(few.experiment->separation, 1) << few.experiment->text;
}

TEST_F(Rules, NoRecorderIsAskedForMoreThanEightTimesItsRate) {
  // In rows of 6 ms (an eighth) a lag of 0.4 ms has come to its end wherever a drive bends: exp(-15). At 64 times the
  // rate they would lie twice that lag apart.
  const Discovery few = discovered(plain_gain(), slow_recordings(2, 0.4e-3, 5e-5), {"amplifier_lag", "dead_time"});
  ASSERT_EQ(few.steps.size(), 1U) << tried(few);
  EXPECT_EQ(few.steps.front().ties.size(), 1U) << tried(few);
  for (const auto& item : few.steps.front().menu.items) EXPECT_LE(item.faster_rows, 8) << item.word;
}

/// A parabola of 2 % of the range behind a plain gain: of the drive or of the sensor, it is the same one.
DataSet curved_recordings(int n) {
  std::vector<Recording> list;
  std::uint64_t seed = 180;
  for (int i = 0; i < n; ++i) {
    const auto t = rows(500, 0.01);
    const auto u = decaying_triangle(t, 1 - 0.05 * i, 3 + i);
    auto y = noise(t.size(), 1e-3, 1e-4, seed);
    for (std::size_t k = 0; k < y.size(); ++k) y[k] += u[k] + 0.02 * u[k] * u[k];
    list.push_back(recording(std::to_string(seed) + ".csv", i % 2 == 0 ? Role::train : Role::validate, t, u, y));
    ++seed;
  }
  return data_set(list, 1e-3);
}

TEST_F(Rules, WhatOnlyAnotherSensorTellsAfterManyRecordingsIsMissingUnderEitherName) {
  for (const int n : {2, 6}) {
    const Discovery d = discovered(plain_gain(), curved_recordings(n), {"asymmetry", "sensor_nonlinearity"});
    ASSERT_EQ(d.steps.size(), 1U) << tried(d);
    EXPECT_EQ(d.steps.front().ties.size(), 1U) << tried(d);
    ASSERT_TRUE(d.experiment) << d.headline;
    EXPECT_EQ(d.experiment->word, "reference_sensor") << "told in either case";
    EXPECT_EQ(to_text(d.verdict), n == 2 ? "not_distinguishable" : "missing_effect") << d.headline;
    const bool said = std::any_of(d.sentences.begin(), d.sentences.end(), [](const std::string& s) {
      return s.find("no input signal tells them apart") != std::string::npos;
    });
    EXPECT_EQ(said, n > 2);
  }
}

TEST_F(Rules, AfterManyRecordingsOfOneRateNobodySamplesFaster) {
  const Discovery many = discovered(plain_gain(), slow_recordings(6), {"amplifier_lag", "dead_time"});
  ASSERT_EQ(many.steps.size(), 1U) << tried(many);
  EXPECT_EQ(many.steps.front().ties.size(), 1U) << tried(many);
  EXPECT_EQ(to_text(many.verdict), "missing_effect") << many.headline << (many.experiment ? many.experiment->text : "");
}

TEST_F(Rules, AnOutputThatNothingFoundMovesIsJudgedAsIfItWereAlone) {
  // 3 % more gain than noise on one axis, and on the other a gain that adds 5 % to chi2: certain over 2400 rows, and
  // less than what a further effect on the first axis would have to bring.
  constexpr double white = 1e-3;
  const auto times = [](double gain) {
    return [gain](const std::vector<double>&, const std::vector<double>& u) {
      auto y = u;
      for (auto& v : y) v *= gain;
      return y;
    };
  };
  const Discovery d =
      discovered(two_plain_axes(), of_two_axes(white, times(1.03), times(1 + 0.55e-3)), {"calibration"}, exact());
  ASSERT_EQ(d.steps.size(), 1u) << tried(d);
  EXPECT_EQ(d.steps[0].winner.place, "stage");
  EXPECT_EQ(d.steps[0].winner.also_at, std::vector<std::string>{"stage2"}) << tried(d);
}

// --- tolerances ------------------------------------------------------------------------------------------------------

/// The same on a spring with 3e4 N/m^3 besides, by semi-implicit Euler steps of 25 us.
DataSet on_stiffening_spring() {
  std::vector<Recording> list;
  std::uint64_t seed = 120;
  for (auto& m : motions()) {
    auto y = noise(m.t.size(), 1e-5, 1e-6, seed);
    double x = 0, v = 0;
    for (std::size_t k = 0; k < m.t.size(); ++k) {
      for (int i = 0; k > 0 && i < 200; ++i) {
        const double h = (m.t[k] - m.t[k - 1]) / 200, u = m.u[k - 1] + (m.u[k] - m.u[k - 1]) * (i + 0.5) / 200;
        v += h * (10 * u - 400 * x - 4 * v - 3e4 * x * x * x);
        x += h * v;
      }
      y[k] += x;
    }
    list.push_back(recording(std::to_string(seed++) + ".csv", m.role, m.t, m.u, y));
  }
  return data_set(list, 1e-5);
}

TEST_F(Rules, TheRankingIsTheSameWithTenTimesLooserOrTighterTolerances) {
  const DataSet data = on_stiffening_spring();
  std::vector<std::string> usual;
  std::vector<long> substeps;
  for (const double looser : {1.0, 10.0, 0.1}) {
    DiscoverOptions options;
    options.looser = looser;
    const Discovery d = discovered(mass_on_spring(), data, {"stiffening", "friction", "quadratic_drag"}, options);
    auto list = d.candidates;
    std::stable_sort(list.begin(), list.end(),
                     [](const Candidate& a, const Candidate& b) { return a.score < b.score; });
    std::vector<std::string> ranking{to_text(d.verdict)};
    for (const auto& c : list)
      ranking.push_back(std::to_string(c.step) + " " + c.effect + " at " + c.place + (c.claimed ? ", claimed" : ""));
    EXPECT_GE(ranking.size(), 4U) << tried(d);
    if (usual.empty()) usual = ranking;
    EXPECT_EQ(ranking, usual) << "ten times " << (looser > 1 ? "looser" : "tighter") << "\n" << tried(d);
  }
}

}  // namespace
}  // namespace hysteron
