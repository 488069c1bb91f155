#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "blocks/register_all.h"
#include "discover/effects/all.h"
#include "discover/placement/rows.h"
#include "discover/search/investigation.h"
#include "discover/selection/discover.h"
#include "io/diagram/diagram_file.h"
#include "tests/discover/synthetic.h"

namespace hysteron {
namespace {

using namespace testing;
using std::numbers::pi;

class Verdicts : public ::testing::Test {
 protected:
  Discovery found(const Diagram& d, const DataSet& data, bool exact = false) {
    DiscoverOptions options;
    options.numbers_are_exact = exact;
    return discover(d, data, registry, effects, options);
  }
  static std::vector<std::string> names(const Discovery& d) {
    std::vector<std::string> list;
    for (const auto& s : d.steps) list.push_back(s.winner.effect);
    return list;
  }
  Registry registry = all_blocks();
  Effects effects = all_effects();
};

std::vector<double> plus(std::vector<double> a, const std::vector<double>& b) {
  for (std::size_t k = 0; k < a.size(); ++k) a[k] += b[k];
  return a;
}

/// Preisach's model: a triangle of relays that switch up at alpha and down at beta, more of them where the level is
/// high. Another law than the plays that hysteron inserts: its loops are not congruent.
std::vector<double> relay_response(const std::vector<double>& u, double share) {
  const int n = 60;
  std::vector<char> up(static_cast<std::size_t>(n * n), 0);
  const auto level = [&](int k) { return (k + 0.5) / n; };
  std::vector<double> y;
  for (const double now : u) {
    double sum = 0;
    double all = 0;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j <= i; ++j) {
        auto& state = up[static_cast<std::size_t>(i * n + j)];
        if (now >= level(i)) state = 1;
        if (now <= level(j)) state = 0;
        const double density = std::exp(-(level(i) - level(j)) / 0.3) * (1 + 0.05 * (level(i) + level(j)));
        all += density;
        sum += density * state;
      }
    y.push_back((1 - share) * now + share * sum / all);
  }
  return y;
}

TEST_F(Verdicts, AModelsOwnOutputWithWhiteNoiseIsAdequateForTwentySeeds) {
  Diagram d = plain_gain();
  d.blocks["stage"].type = "prandtl_ishlinskii";
  d.blocks["stage"].parameters = {};
  d.blocks["stage"].parameters["thresholds"] =
      Value(NumberList{Number{0, "V"}, Number{0.1, "V"}, Number{0.3, "V"}, Number{0.6, "V"}});
  d.blocks["stage"].parameters["weights"] =
      Value(NumberList{Number{1, "m/V"}, Number{0.1, "m/V"}, Number{0.1, "m/V"}, Number{0.1, "m/V"}});
  const auto program = compile(d, registry);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    std::vector<Recording> list;
    int k = 0;
    for (const Role role : {Role::train, Role::train, Role::validate}) {
      const auto t = rows(600, k == 1 ? 0.05 : 0.01);
      const auto u = k == 0   ? decaying_triangle(t, 1, 4)
                     : k == 1 ? levels(t, {0.5, 1, 0.2, 0.7})
                              : several_sines(t, 1, {0.7, 1.9});
      const auto series = std::make_shared<const Series>(Series{t, u, Between::linear});
      const auto y = simulate_rows(program, {series}, t, program->output_signals, true).front();
      list.push_back(recording(std::to_string(k) + ".csv", role, t, u,
                               plus(y, noise(t.size(), 1e-2, 0, 100 * seed + static_cast<std::uint64_t>(k)))));
      ++k;
    }
    const Discovery result = found(d, data_set(list, 1e-2));
    EXPECT_EQ(to_text(result.verdict), "adequate") << "seed " << seed << ": " << result.headline;
    EXPECT_TRUE(result.steps.empty()) << "seed " << seed;
    EXPECT_EQ(diagram_text(result.final_diagram), diagram_text(d)) << "nothing was added";
  }
}

TEST_F(Verdicts, AnotherLawOfHysteresisIsNamedAndTheErrorFallsToTheNoise) {
  std::vector<Recording> list;
  std::uint64_t seed = 7;
  const auto add = [&](Role role, const std::vector<double>& t, const std::vector<double>& u) {
    list.push_back(recording(std::to_string(seed) + ".csv", role, t, u,
                             plus(relay_response(u, 0.4), noise(t.size(), 3e-3, 0, seed))));
    ++seed;
  };
  add(Role::train, rows(800, 0.01), decaying_triangle(rows(800, 0.01), 1, 5));
  add(Role::train, rows(800, 0.002), several_sines(rows(800, 0.002), 1, {2.5, 7.5}));
  add(Role::validate, rows(800, 0.005), several_sines(rows(800, 0.005), 1, {0.5, 1.25}));
  const Discovery d = found(plain_gain(), data_set(list, 3e-3));
  EXPECT_EQ(to_text(d.verdict), "missing_effect") << d.headline;
  ASSERT_EQ(names(d), std::vector<std::string>{"hysteresis"});
  // Six plays leave about a quarter of the loop, more of them less.
  EXPECT_LT(d.final_error.rms_validate, 2 * 3e-3);
  EXPECT_LT(d.final_error.rms_validate, 0.2 * d.base.rms_validate);
  ASSERT_EQ(effects_in(d.final_diagram).size(), 1u);
}

TEST_F(Verdicts, LogarithmicCreepIsNamedWithItsAmountPerDecade) {
  // y = sum of steps du (1 + gamma log10(1 + t / 10 ms)): no relaxations in it.
  const double gamma = 0.03;
  std::vector<Recording> list;
  std::uint64_t seed = 40;
  for (const auto& [role, step, values] : {std::tuple{Role::train, 0.05, std::vector<double>{1, 0.3, 0.8, 0}},
                                           {Role::train, 0.01, {0.4, 1, 0.1}},
                                           {Role::validate, 0.04, {0.7, 0.2, 1, 0.5}}}) {
    const auto t = rows(1000, step);
    const auto u = levels(t, values);
    std::vector<double> y;
    for (std::size_t k = 0; k < t.size(); ++k) {
      double sum = u[k];
      for (std::size_t j = 1; j <= k; ++j)
        if (u[j] != u[j - 1]) sum += gamma * (u[j] - u[j - 1]) * std::log10(1 + (t[k] - t[j] + step / 2) / 0.01);
      y.push_back(sum);
    }
    list.push_back(recording(std::to_string(seed) + ".csv", role, t, u, plus(y, noise(t.size(), 1e-3, 0.2e-3, seed))));
    ++seed;
  }
  const Discovery d = found(plain_gain(), data_set(list, 1e-3));
  EXPECT_EQ(to_text(d.verdict), "missing_effect") << d.headline;
  ASSERT_FALSE(d.steps.empty());
  EXPECT_EQ(d.steps.front().winner.effect, "creep");
  EXPECT_LT(d.final_error.rms_validate, 1.5e-3) << "noise 1.02e-3";
  EXPECT_NE(d.steps.front().winner.summary.find("per decade"), std::string::npos) << d.steps.front().winner.summary;
}

TEST_F(Verdicts, ALagSeenAtOneFrequencyAloneCannotBeToldFromADelayAndAnExperimentIsNamed) {
  // At one frequency a lag is a phase and a gain, and so is a delay with a gain. The gain is the user's, and free.
  const double f = 2;
  const double tau = 0.01;
  std::vector<Recording> list;
  std::uint64_t seed = 3;
  for (const Role role : {Role::train, Role::validate}) {
    const auto t = rows(1000, 0.004);
    const double a = role == Role::train ? 1.0 : 0.6;
    const auto u = sampled(t, [&](double x) { return a * std::sin(2 * pi * f * x); });
    // Steady state of tau y' = u - y plus its start from rest.
    const double w = 2 * pi * f * tau;
    const auto y = sampled(t, [&](double x) {
      return a / (1 + w * w) * (std::sin(2 * pi * f * x) - w * std::cos(2 * pi * f * x) + w * std::exp(-x / tau));
    });
    list.push_back(recording(std::to_string(seed) + ".csv", role, t, u, plus(y, noise(t.size(), 2e-2, 0, seed))));
    ++seed;
  }
  const Discovery d = found(plain_gain(), data_set(list, 2e-2));
  EXPECT_EQ(to_text(d.verdict), "not_distinguishable") << d.headline;
  ASSERT_EQ(d.steps.size(), 1u);
  std::vector<std::string> all{d.steps.front().winner.effect};
  for (const auto& t : d.steps.front().ties) all.push_back(t.effect);
  std::sort(all.begin(), all.end());
  EXPECT_EQ(all, (std::vector<std::string>{"amplifier_lag", "dead_time"}));
  ASSERT_TRUE(d.experiment.has_value());
  EXPECT_GT(d.experiment->separation, 1);
  EXPECT_FALSE(d.experiment->text.empty());
  const auto& items = d.steps.front().menu.items;
  const auto chosen = std::find_if(items.begin(), items.end(), [](const MenuItem& i) { return i.chosen; });
  ASSERT_NE(chosen, items.end());
  EXPECT_EQ(chosen->word, d.experiment->word);
  EXPECT_EQ(chosen->separation, d.experiment->separation);
}

/// A gain that is 2 % low, in three recordings of which each has its room.
DataSet low_gain_in_rooms_of(const std::array<double, 3>& kelvins) {
  std::vector<Recording> list;
  std::uint64_t seed = 21;
  for (const double kelvin : kelvins) {
    const Role role = list.size() < 2 ? Role::train : Role::validate;
    const auto t = rows(500, 0.02);
    const auto u = several_sines(t, 1, {0.3, 0.7 + 0.1 * static_cast<double>(list.size())});
    auto y = u;
    for (auto& v : y) v *= 0.98;
    auto r = recording(std::to_string(seed) + ".csv", role, t, u, plus(y, noise(t.size(), 3e-3, 0, seed)));
    r.columns["T"] = plus(std::vector<double>(t.size(), kelvin), noise(t.size(), 0.05, 0, seed + 100));
    r.units["T"] = parse_unit("degC");
    list.push_back(std::move(r));
    ++seed;
  }
  auto d = data_set(std::move(list), 3e-3);
  d.notes["T"].to = "T";
  return d;
}

DataSet low_gain_in_a_room_of(double kelvin) { return low_gain_in_rooms_of({kelvin, kelvin, kelvin}); }

TEST_F(Verdicts, AGainFoundInAHotRoomMayBeTheTemperatures) {
  // 40 degC in all recordings: nothing shows what the gain would be at another temperature.
  const Discovery hot = found(plain_gain(), low_gain_in_a_room_of(313.15), true);
  EXPECT_EQ(to_text(hot.verdict), "not_distinguishable") << hot.headline;
  ASSERT_EQ(names(hot), std::vector<std::string>{"calibration"});
  ASSERT_EQ(hot.steps.front().ties.size(), 1u);
  EXPECT_EQ(hot.steps.front().ties.front().effect, "temperature_gain");
  ASSERT_TRUE(hot.experiment.has_value());
  EXPECT_EQ(hot.experiment->word, "temperature_staircase");
  EXPECT_NE(hot.experiment->text.find("below today's"), std::string::npos) << hot.experiment->text;
}

TEST_F(Verdicts, AGainFoundInAUsualRoomIsACalibration) {
  const Discovery usual = found(plain_gain(), low_gain_in_a_room_of(295.15), true);
  EXPECT_EQ(to_text(usual.verdict), "missing_effect") << usual.headline;
  ASSERT_EQ(names(usual), std::vector<std::string>{"calibration"});
  EXPECT_TRUE(usual.steps.front().ties.empty());
}

TEST_F(Verdicts, AGainThatIsTheSameAtTwoTemperaturesIsACalibration) {
  // One recording is cooler than the others and as low. After so few, look-alikes are compared with a spare gain each:
  // beside it a gain by temperature would be the calibration again.
  const Discovery both = found(plain_gain(), low_gain_in_rooms_of({305.15, 313.15, 313.15}), true);
  EXPECT_EQ(to_text(both.verdict), "missing_effect") << both.headline;
  ASSERT_EQ(names(both), std::vector<std::string>{"calibration"});
  const auto other = std::find_if(both.candidates.begin(), both.candidates.end(),
                                  [](const Candidate& c) { return c.effect == "temperature_gain"; });
  ASSERT_NE(other, both.candidates.end());
  EXPECT_GT(other->share_removed, 0.5) << "a rival that would be taken if there were no calibration";
  EXPECT_TRUE(both.steps.front().ties.empty());
}

TEST_F(Verdicts, WhatLeavesTwiceTheErrorIsNoTieThoughNeitherIsRight) {
  // A bend, and ripples over the level that no effect explains, in short strokes: the evidence lies in one piece of
  // eight, so that no difference is steady. A knee follows the bend, not as well as a polynomial.
  const auto stroke = [](double x) { return x < 1.25 ? 0.5 * (1 - std::cos(2 * pi * x / 1.25)) : 0.0; };
  std::vector<Recording> list;
  std::uint64_t seed = 41;
  for (const Role role : {Role::train, Role::train, Role::validate}) {
    const auto t = rows(1000, 0.01);
    const auto u = sampled(t, stroke);
    auto y = noise(t.size(), 1e-4, 0, seed);
    for (std::size_t k = 0; k < y.size(); ++k)
      y[k] += u[k] + 0.02 * u[k] - 0.15 * std::pow(u[k], 3) + 5e-4 * std::sin(30 * u[k]);
    list.push_back(recording(std::to_string(seed++) + ".csv", role, t, u, std::move(y)));
  }
  DiscoverOptions options;
  options.only = {"asymmetry", "saturation"};
  options.max_steps = 1;
  const Discovery d = discover(plain_gain(), data_set(list, 1e-4), registry, effects, options);
  ASSERT_EQ(names(d), std::vector<std::string>{"asymmetry"}) << d.headline;
  const auto knee = std::find_if(d.candidates.begin(), d.candidates.end(),
                                 [](const Candidate& c) { return c.effect == "saturation"; });
  ASSERT_NE(knee, d.candidates.end());
  EXPECT_GT(knee->share_removed, 0.9);
  EXPECT_TRUE(d.steps.front().ties.empty()) << d.headline;
}

/// Of all structures that competed one is told, the others with why they are not.
void expect_all_recorded(const Discovery& d) {
  int told = 0;
  for (const auto& s : d.structures) {
    EXPECT_FALSE(s.reason.empty()) << s.structure.kind;
    EXPECT_TRUE(s.structure.intervals.empty()) << s.structure.kind;
    if (!s.told) continue;
    ++told;
    EXPECT_EQ(s.structure.kind, d.structure->kind);
    ASSERT_TRUE(s.needed.has_value());
    EXPECT_GT(over(s.structure.fall, s.where), *s.needed);
  }
  EXPECT_EQ(told, 1);
  EXPECT_GE(d.structures.size(), 3u) << "lines and kinks were looked for, too";
}

TEST_F(Verdicts, JumpsBetweenTwoLevelsAreUnexplainedAndTheirTimesAreTold) {
  std::vector<Recording> list;
  std::uint64_t seed = 11;
  std::vector<double> first_jumps;
  for (const Role role : {Role::train, Role::train, Role::validate, Role::validate}) {
    const auto t = rows(1000, 0.01);
    const auto u = several_sines(t, 1, {0.3, 0.7});
    std::mt19937_64 engine(seed);
    std::exponential_distribution<double> wait(1.0);
    double next = wait(engine);
    double level = 1;
    std::vector<double> y;
    for (std::size_t k = 0; k < t.size(); ++k) {
      if (t[k] > next) {
        level = -level;
        next += wait(engine);
        if (list.empty()) first_jumps.push_back(t[k]);
      }
      y.push_back(u[k] + 0.02 * level);
    }
    list.push_back(recording(std::to_string(seed) + ".csv", role, t, u, plus(y, noise(t.size(), 1e-3, 0, seed))));
    ++seed;
  }
  const Discovery d = found(plain_gain(), data_set(list, 1e-3));
  EXPECT_EQ(to_text(d.verdict), "unexplained") << d.headline;
  EXPECT_TRUE(d.steps.empty());
  EXPECT_EQ(to_text(d.remainder), "structured");
  ASSERT_TRUE(d.structure.has_value());
  EXPECT_EQ(d.structure->kind, "jumps");
  expect_all_recorded(d);
  // Every true jump lies in an interval that was told.
  const auto& intervals = d.structure->intervals.front().second;
  for (const double t : first_jumps)
    EXPECT_TRUE(std::any_of(intervals.begin(), intervals.end(),
                            [&](const auto& i) { return t >= i.first - 0.011 && t <= i.second + 0.011; }))
        << t << " s";
}

/// A gain of 1 m/V read by a sensor that nothing is known of but its white noise of 1e-3, and what is added to it.
DataSet with_added(const std::function<double(double t, double u)>& added, double slow, std::uint64_t seed) {
  std::vector<Recording> list;
  for (const auto& [role, hertz] : {std::pair{Role::train, 0.9}, {Role::train, 2.3}, {Role::validate, 1.4}}) {
    const auto t = rows(1200, 0.005);
    const auto u = several_sines(t, 1, {hertz, 2.7 * hertz});
    auto y = plus(u, noise(t.size(), 1e-3, slow, seed));
    for (std::size_t k = 0; k < y.size(); ++k) y[k] += added(t[k], u[k]);
    list.push_back(recording(std::to_string(seed++) + ".csv", role, t, u, std::move(y)));
  }
  DataSet data = data_set(std::move(list), 1e-3);
  data.notes["y"].noise.one_over_f.reset();
  return data;
}

TEST_F(Verdicts, AStepAtALevelIsNoCurveThoughACurveLeavesOnlyNoise) {
  const auto d = found(plain_gain(), with_added([](double, double u) { return u > 0.62 ? 1.4e-3 : 0.0; }, 0, 3300));
  EXPECT_EQ(d.verdict, Verdict::unexplained) << d.headline;
  ASSERT_TRUE(d.structure.has_value());
  EXPECT_NEAR(d.structure->threshold, 0.62, 0.02);
  // A curve stays one: it leaves less than a kink would.
  const auto curve = [](double, double u) { return 0.01 * u * (1 - u) * (0.6 - u); };
  const auto bent = found(plain_gain(), with_added(curve, 0, 3400));
  EXPECT_EQ(bent.verdict, Verdict::missing_effect) << bent.headline;
}

TEST_F(Verdicts, WhatIsSlowAndLargerThanTheNoiseOfSensorsIsNotAdequate) {
  const auto nothing = [](double, double) { return 0.0; };
  DiscoverOptions options;
  options.only = {"amplifier_lag", "saturation", "calibration"};
  const auto judged = [&](double slow) {
    return discover(plain_gain(), with_added(nothing, slow, 3500), registry, effects, options).verdict;
  };
  EXPECT_EQ(judged(0.5e-3), Verdict::adequate);
  EXPECT_NE(judged(3e-3), Verdict::adequate);
}

TEST_F(Verdicts, WhatOtherRecordingsProveIsNoPatchWhereNothingIsLeftToPatch) {
  // The sensor of the recording that judges is a quarter noisier than its data sheet says: of what stands above the
  // noise there a lag of a quarter of it takes a small part, but no chance takes as much, and nothing else is there.
  std::vector<Recording> list;
  std::uint64_t seed = 3700;
  constexpr double tau = 7e-5;
  for (const Role role : {Role::train, Role::train, Role::validate}) {
    const auto t = rows(1000, 0.004);
    const double f = 5 + static_cast<double>(list.size());
    const auto u = sampled(t, [f](double x) { return 0.15 * (1 - std::cos(2 * pi * f * x)); });
    // Of slow motion a lag is its rate, times the lag: what is left out is its square, of 3e-3 of that.
    const auto y = sampled(t, [f](double x) {
      return 0.15 * (1 - std::cos(2 * pi * f * x)) - tau * 0.15 * 2 * pi * f * std::sin(2 * pi * f * x);
    });
    list.push_back(recording(std::to_string(seed) + ".csv", role, t, u,
                             plus(y, noise(t.size(), role == Role::validate ? 1.25e-3 : 1e-3, 0, seed))));
    ++seed;
  }
  DiscoverOptions options;
  options.only = {"amplifier_lag"};
  const Discovery d = discover(plain_gain(), data_set(list, 1e-3, 0), registry, effects, options);
  EXPECT_EQ(to_text(d.verdict), "missing_effect") << d.headline;
  ASSERT_FALSE(d.steps.empty());
  EXPECT_EQ(d.steps.front().winner.effect, "amplifier_lag");
  EXPECT_LT(d.steps.front().winner.share_removed, 0.5);
}

TEST_F(Verdicts, AWrongGainIsACalibrationAndNothingElse) {
  std::vector<Recording> list;
  std::uint64_t seed = 5;
  for (const Role role : {Role::train, Role::train, Role::validate}) {
    const auto t = rows(600, 0.01);
    const auto u = several_sines(t, 1, {0.4, 1.1 + 0.3 * static_cast<double>(list.size())});
    auto y = u;
    for (auto& v : y) v = 1.02 * v + 0.01;
    list.push_back(recording(std::to_string(seed) + ".csv", role, t, u, plus(y, noise(t.size(), 1e-3, 0, seed))));
    ++seed;
  }
  const Discovery d = found(plain_gain(), data_set(list, 1e-3), true);
  EXPECT_EQ(to_text(d.verdict), "missing_effect") << d.headline;
  EXPECT_EQ(names(d), std::vector<std::string>{"calibration"});
  ASSERT_FALSE(d.steps.empty());
  EXPECT_TRUE(d.steps.front().ties.empty());
  for (const auto& p : d.steps.front().winner.found) {
    if (!p.estimate.path.ends_with(".gain")) continue;
    EXPECT_NEAR(p.estimate.used, 1.02, 4 * 1e-3 / std::sqrt(1200 * 0.08));  // four standard deviations
  }
}

TEST_F(Verdicts, WhatTheDataCannotShowIsRefusedWithTheReason) {
  std::vector<Recording> list;
  for (const Role role : {Role::train, Role::validate}) {
    const auto t = rows(400, 0.01);
    const auto u = several_sines(t, 1, {0.4, 1.1});
    list.push_back(recording(role == Role::train ? "a" : "b", role, t, u,
                             plus(u, noise(t.size(), 1e-3, 0, role == Role::train ? 1 : 2))));
  }
  const Discovery d = found(plain_gain(), data_set(list, 1e-3));
  const auto refused = [&](const std::string& id) {
    for (const auto& r : d.refused)
      if (r.effect == id) return r.reason;
    return std::string();
  };
  EXPECT_NE(refused("mains_interference").find("120 Hz"), std::string::npos) << refused("mains_interference");
  EXPECT_NE(refused("initial_remanence").find("memory"), std::string::npos) << refused("initial_remanence");
}

TEST_F(Verdicts, TheSameQuestionHasTheSameAnswer) {
  const auto t = rows(400, 0.01);
  const auto u = several_sines(t, 1, {0.4, 1.1});
  auto y = relay_response(u, 0.4);
  const DataSet data = data_set({recording("a", Role::train, t, u, plus(y, noise(t.size(), 1e-3, 0, 1))),
                                 recording("b", Role::validate, t, u, plus(y, noise(t.size(), 1e-3, 0, 2)))},
                                1e-3);
  const Discovery a = found(plain_gain(), data);
  const Discovery b = found(plain_gain(), data);
  EXPECT_EQ(diagram_text(a.final_diagram), diagram_text(b.final_diagram));
  EXPECT_EQ(a.headline, b.headline);
}

TEST_F(Verdicts, WithoutARecordingToJudgeOnThereIsNoDiscovery) {
  const auto t = rows(400, 0.01);
  const auto u = several_sines(t, 1, {0.4, 1.1});
  try {
    found(plain_gain(), data_set({recording("a", Role::train, t, u, u)}, 1e-3));
    FAIL() << "nothing to judge on";
  } catch (const Error& e) {
    EXPECT_EQ(e.problems.front().code, "no_validation");
    EXPECT_FALSE(e.problems.front().cure.empty());
  }
}

/// A pump hums once in nine seconds, with a new phase in each recording; those that judge are shorter than that.
DataSet beside_a_pump() {
  std::vector<Recording> list;
  std::uint64_t seed = 7700;
  const auto add = [&](Role role, double phase, int count, double step, const std::vector<double>& hertz) {
    const auto t = rows(count, step);
    const auto u = hertz.empty() ? decaying_triangle(t, 1, 4) : several_sines(t, 1, hertz);
    auto y = noise(t.size(), 2e-4, 0, seed);
    for (std::size_t k = 0; k < t.size(); ++k) y[k] += u[k] + 7e-4 * std::sin(2 * pi * t[k] / 8.9 + phase);
    list.push_back(recording(std::to_string(seed++) + ".csv", role, t, u, y));
  };
  add(Role::train, 0.5, 2000, 0.0067, {1.0, 2.2});
  add(Role::train, 2.0, 1100, 1.3, {0.004, 0.011});
  add(Role::train, 4.0, 2000, 0.014, {0.11, 0.3});
  add(Role::train, 5.5, 2000, 0.094, {});
  add(Role::validate, 1.2, 1100, 0.0067, {1.0, 2.2});
  add(Role::validate, 3.0, 1500, 0.00045, {9.0, 30.0});
  return data_set(list, 2e-4, 0);
}

TEST_F(Verdicts, APumpTooSlowForTheRecordingsThatJudgeIsToldFromAllOfThem) {
  DiscoverOptions options;
  options.only = {"structural_resonance", "creep"};
  const Discovery d = discover(plain_gain(), beside_a_pump(), registry, effects, options);
  EXPECT_EQ(d.verdict, Verdict::unexplained) << d.headline;
  // A mode takes most of the hum away, and never stops ringing once it is fitted to its end.
  EXPECT_TRUE(std::any_of(d.candidates.begin(), d.candidates.end(), [](const Candidate& c) {
    return !c.claimed && c.reason.find("fitted to its end it is not itself") != std::string::npos;
  })) << d.headline;
  ASSERT_TRUE(d.structure.has_value());
  EXPECT_EQ(d.structure->kind, "line_in_time");
  // Cramer-Rao of the longest recording: sqrt(6/1100)/(pi 1430 s)/3.5 = 5e-6 Hz, 4e-4 s of the period; five of these.
  EXPECT_NEAR(d.structure->period, 8.9, 2e-3);
  EXPECT_NE(d.structure->sentence.find("in all recordings"), std::string::npos) << d.structure->sentence;
}

}  // namespace
}  // namespace hysteron
