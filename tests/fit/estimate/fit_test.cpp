#include "fit/estimate/fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/diagram/error.h"
#include "tests/fit/two_recordings.h"

namespace hysteron {
namespace {

using namespace lab;

Diagram gain_and_offset() {
  Diagram d = lab::diagram("sensor");
  auto& sensor = lab::add(d, "sensor", "calibration", "u");
  sensor.parameters["gain"] = "1 um/V";
  sensor.parameters["offset"] = "0 um";
  return d;
}

TEST(Fit, FindsGainAndOffsetExactlyWhereThereIsNoNoise) {
  DataSet data = two_recordings();
  const auto program = compile(gain_and_offset(), lab::registry());
  lab::measure(
      data, program, 0, 1,
      {{parameter_index(*program, "sensor.gain"), 2.5e-6}, {parameter_index(*program, "sensor.offset"), -3e-6}});
  DataModel model(program, lab::shared(data));
  const auto r = fit(model, noise_before_fit(model), free_parameters(*program, {"sensor.gain", "sensor.offset"}));
  ASSERT_TRUE(r.ok) << r.error;
  EXPECT_NEAR(*estimate(r, "sensor.gain").value, 2.5e-6, 1e-17);
  EXPECT_NEAR(*estimate(r, "sensor.offset").value, -3e-6, 1e-16);
  EXPECT_TRUE(estimate(r, "sensor.gain").linear);
  EXPECT_EQ(r.method, "linear least squares (2)");
}

TEST(Fit, ReportsChiSquareOnBothRolesAndTheRmsBeforeAndAfter) {
  DataSet data = two_recordings();
  const auto program = compile(gain_and_offset(), lab::registry());
  lab::measure(data, program, 10e-9, 2, {{parameter_index(*program, "sensor.gain"), 2e-6}});
  DataModel model(program, lab::shared(data));
  const auto r = fit(model, noise_before_fit(model), free_parameters(*program, {"sensor.gain", "sensor.offset"}));
  ASSERT_TRUE(r.ok);
  // 400 rows of white noise: chi2 = 400 +- 5 sqrt(800).
  EXPECT_NEAR(r.after.chi2(Role::train), 400, 142);
  EXPECT_NEAR(r.after.chi2(Role::validate), 400, 142);
  EXPECT_NEAR(r.after.find(1)->rms[0], 10e-9, 1.5e-9);
  // Before, the gain was 1 um/V short: the rms of u in um. 2 V and more.
  EXPECT_GT(r.before.find(0)->rms[0], 2e-6);
  EXPECT_NEAR(r.chi2, r.after.chi2(Role::train), 1e-9 * r.chi2);
}

TEST(Fit, FindsTheWeightsOfPlaysAndHoldsTheOneThatIsNotThereAtZero) {
  DataSet data = two_recordings();
  const auto program = compile(plays(6), lab::registry());
  std::vector<ParameterValue> truth;
  const double weights[] = {1e-6, 0.3e-6, 0, 0.2e-6, 0.1e-6, 0.05e-6};
  for (int i = 0; i < 6; ++i)
    truth.push_back({parameter_index(*program, "core.weights[" + std::to_string(i) + "]"), weights[i]});
  lab::measure(data, program, 0, 3, truth);
  DataModel model(program, lab::shared(data));
  auto free = free_parameters(*program, {"core.weights"});
  for (auto& f : free) f.lower = 0;
  const auto r = fit(model, noise_before_fit(model), free);
  ASSERT_TRUE(r.ok) << r.error;
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(r.values[static_cast<std::size_t>(i)].value, weights[i], 1e-14) << i;
}

TEST(Fit, AWeightThatWouldBeNegativeIsHeldAtItsBoundAndSaidSo) {
  DataSet data = two_recordings();
  const auto program = compile(plays(3), lab::registry());
  lab::measure(data, program, 1e-9, 4,
               {{parameter_index(*program, "core.weights[0]"), 1e-6},
                {parameter_index(*program, "core.weights[1]"), -0.3e-6},
                {parameter_index(*program, "core.weights[2]"), 0.4e-6}});
  DataModel model(program, lab::shared(data));
  auto free = free_parameters(*program, {"core.weights"});
  for (auto& f : free) f.lower = 0;
  const auto r = fit(model, noise_before_fit(model), free);
  ASSERT_TRUE(r.ok);
  const auto& held = estimate(r, "core.weights[1]");
  EXPECT_TRUE(held.at_lower);
  EXPECT_EQ(*held.value, 0);
  EXPECT_FALSE(held.sigma.has_value());
  EXPECT_TRUE(estimate(r, "core.weights[0]").sigma.has_value());
}

TEST(Fit, FindsATimeConstantFromAPoorStartOnALogScale) {
  DataSet data = two_recordings();
  const auto program = compile(lag_and_gain(), lab::registry());
  const int tau = parameter_index(*program, "amplifier.times[0]"), gain = parameter_index(*program, "g.gain");
  lab::measure(data, program, 1e-9, 5, {{tau, 0.02}, {gain, 3e-6}});
  DataModel model(program, lab::shared(data));
  for (const double start : {1e-3, 0.05, 2.0}) {
    auto free = free_parameters(*program, {"amplifier.times", "g.gain"});
    free[0].start = start;
    free[0].lower = 1e-4;
    free[0].upper = 100;
    const auto r = fit(model, noise_before_fit(model), free);
    ASSERT_TRUE(r.ok) << r.error;
    const auto& e = estimate(r, "amplifier.times[0]");
    EXPECT_TRUE(e.log_scale);
    EXPECT_FALSE(e.linear);
    EXPECT_TRUE(estimate(r, "g.gain").linear);
    EXPECT_NEAR(*e.value, 0.02, 5 * *e.sigma) << start;
    EXPECT_LT(*e.sigma, 2e-4);
    EXPECT_NEAR(*estimate(r, "g.gain").value, 3e-6, 5 * *estimate(r, "g.gain").sigma);
    EXPECT_TRUE(r.converged) << r.convergence;
  }
}

TEST(Fit, DerivativesOfAnotherFitSaveSimulationsAndChangeNoResult) {
  DataSet data = two_recordings();
  const auto program = compile(lag_and_gain(), lab::registry());
  const int tau = parameter_index(*program, "amplifier.times[0]");
  lab::measure(data, program, 10e-9, 6, {{tau, 0.02}});
  DataModel model(program, lab::shared(data));
  auto free = free_parameters(*program, {"amplifier.times", "g.gain"});
  FitOptions options;
  options.matters = 0.2;
  options.intervals = false;
  options.scores = false;
  free[0].start = 0.019;
  const auto first = fit(model, noise_before_fit(model), free, options);
  ASSERT_TRUE(first.ok && first.derivatives);
  EXPECT_TRUE(first.before.recordings.empty() && first.after.recordings.empty()) << "nobody asked for scores";
  free[0].start = 0.021;
  const auto alone = fit(model, noise_before_fit(model), free, options);
  options.known_derivatives = first.derivatives;
  const auto again = fit(model, noise_before_fit(model), free, options);
  ASSERT_TRUE(alone.ok && again.ok);
  EXPECT_LT(again.runs, alone.runs);
  EXPECT_FALSE(again.derivatives) << "it needed none of its own";
  EXPECT_NEAR(again.chi2, alone.chi2, 2 * options.matters);
  // Of another size they are of something else.
  options.known_derivatives = std::make_shared<Dense>(3, 1);
  const auto other = fit(model, noise_before_fit(model), free, options);
  EXPECT_EQ(other.runs, alone.runs);
  EXPECT_EQ(other.chi2, alone.chi2);
}

TEST(Fit, TimeConstantsOfTwoRelaxationsAreFoundFromThirtyPerCentAway) {
  // Sums of relaxations are badly conditioned: an unbounded step of a logarithm would leave for times of 1e-15 s or
  // 1e+293 s, where no slope leads back.
  const auto steps = [](double t) { return 2 + 2 * std::floor(std::fmod(t * 0.7, 4.0)); };
  Diagram d = lab::diagram("g");
  auto& creep = lab::add(d, "creep", "creep", "u");
  creep.parameters["amounts"] = NumberList{{0.02, {}}, {0.03, {}}};
  creep.parameters["times"] = NumberList{{0.1, "s"}, {1, "s"}};
  lab::add(d, "g", "gain", "creep").parameters["gain"] = "1 um/V";
  const auto program = compile(d, lab::registry());
  const auto free = free_parameters(*program, {"creep.amounts", "creep.times", "g.gain"});
  for (unsigned draw = 0; draw < 10; ++draw) {
    lab::Noise random(300 + draw);
    std::vector<ParameterValue> truth;
    for (const auto& f : free) truth.push_back({f.parameter, f.start * (0.7 + 0.6 * random.uniform())});
    DataSet data = two_recordings(1500, 0.006);
    data.notes["y"].noise.white = 20e-9;
    for (auto& r : data.recordings)
      for (std::size_t i = 0; i < r.t.size(); ++i) r.columns["u"][i] = steps(r.t[i]);
    lab::measure(data, program, 20e-9, 400 + draw, truth);
    DataModel model(program, lab::shared(data));
    const auto r = fit(model, noise_before_fit(model), free);
    ASSERT_TRUE(r.ok) << r.error;
    EXPECT_TRUE(r.converged) << r.convergence;
    EXPECT_LT(r.chi2 / r.n, 1.15);  // 1500 rows: 1 +- 0.037; a step gone astray leaves 1.3 and more
  }
}

TEST(Fit, AValueFarBelowOneInSiIsNotTakenForItsLowerBound) {
  DataSet data = two_recordings();
  for (auto& r : data.recordings)
    for (auto& u : r.columns["u"]) u *= 1e-9;  // nanovolts
  Diagram d = lab::diagram("g");
  lab::add(d, "gap", "backlash", "u").parameters["gap"] = "1 nV";
  lab::add(d, "g", "gain", "gap").parameters["gain"] = "1e9 um/V";
  const auto lost = compile(d, lab::registry());
  lab::measure(data, lost, 1e-9, 6, {{parameter_index(*lost, "gap.gap"), 0.3e-9}});
  DataModel model(lost, lab::shared(data));
  auto free = free_parameters(*lost, {"gap.gap"});
  free[0].lower = 0;
  const auto r = fit(model, noise_before_fit(model), free);
  // Noise of 1 nm behind 1e9 um/V: 1e-12 V in a row, of which several hundred lie on flanks.
  EXPECT_NEAR(*estimate(r, "gap.gap").value, 0.3e-9, 1e-12);
  EXPECT_FALSE(estimate(r, "gap.gap").at_lower);
  EXPECT_TRUE(estimate(r, "gap.gap").sigma.has_value());
}

TEST(Fit, TwoGainsInSeriesAreNamedAndGetNoValue) {
  DataSet data = two_recordings();
  Diagram d = lab::diagram("b");
  lab::add(d, "a", "gain", "u").parameters["gain"] = "1 um/V";
  lab::add(d, "b", "gain", "a").parameters["gain"] = 2.0;
  const auto program = compile(d, lab::registry());
  lab::measure(data, program, 10e-9, 7, {{parameter_index(*program, "b.gain"), 3}});
  DataModel model(program, lab::shared(data));
  const auto r = fit(model, noise_before_fit(model), free_parameters(*program, {"a.gain", "b.gain"}));
  ASSERT_TRUE(r.ok) << r.error;
  ASSERT_EQ(r.undetermined.size(), 1U);
  EXPECT_EQ(r.undetermined[0].paths.size(), 2U);
  // One up by as much as the other goes down leaves the product as it is.
  EXPECT_NEAR(r.undetermined[0].direction[0], -r.undetermined[0].direction[1], 1e-3);
  for (const auto& e : r.estimates) {
    EXPECT_FALSE(e.determined);
    EXPECT_FALSE(e.value.has_value());
    EXPECT_FALSE(e.sigma.has_value());
  }
  EXPECT_NEAR(r.values[0].value * r.values[1].value, 3e-6, 1e-9);  // what was simulated still fits
  EXPECT_NE(r.undetermined[0].sentence.find("a.gain"), std::string::npos);
  EXPECT_LT(r.after.chi2(), 1200);
}

TEST(Fit, AThresholdBeyondTheDriveLeavesItsWeightWithoutAValue) {
  DataSet data = two_recordings();
  Diagram d = plays(3);
  d.blocks["core"].parameters["thresholds"] = NumberList{{0, "V"}, {1, "V"}, {50, "V"}};
  const auto program = compile(d, lab::registry());
  lab::measure(data, program, 1e-9, 8);
  DataModel model(program, lab::shared(data));
  const auto r = fit(model, noise_before_fit(model), free_parameters(*program, {"core.weights"}));
  ASSERT_TRUE(r.ok);
  EXPECT_TRUE(estimate(r, "core.weights[0]").determined);
  EXPECT_FALSE(estimate(r, "core.weights[2]").determined);
  EXPECT_FALSE(estimate(r, "core.weights[2]").value.has_value());
  EXPECT_EQ(estimate(r, "core.weights[2]").used, estimate(r, "core.weights[2]").start);
  ASSERT_EQ(r.undetermined.size(), 1U);
  EXPECT_EQ(r.undetermined[0].paths, (std::vector<std::string>{"core.weights[2]"}));
}

TEST(Fit, ALagFarBelowTheSampleStepHasNoValue) {
  // 10 ms rows, 1 us lag: the response differs by 1e-4 of a row; with 10 nm of noise nothing can be seen.
  DataSet data = two_recordings();
  const auto program = compile(lag_and_gain(), lab::registry());
  const int tau = parameter_index(*program, "amplifier.times[0]");
  lab::measure(data, program, 10e-9, 9, {{tau, 1e-8}});
  DataModel model(program, lab::shared(data));
  auto free = free_parameters(*program, {"amplifier.times", "g.gain"});
  free[0].start = 1e-8;
  free[0].lower = 1e-9;
  free[0].upper = 1;
  const auto r = fit(model, noise_before_fit(model), free);
  ASSERT_TRUE(r.ok);
  const auto& e = estimate(r, "amplifier.times[0]");
  EXPECT_TRUE(!e.determined || e.at_lower);
  EXPECT_TRUE(estimate(r, "g.gain").determined);
}

TEST(Fit, IntervalsHoldTheTruthInNinetyFivePercentOfDraws) {
  DataSet data = two_recordings(120, 0.03);
  const auto program = compile(lag_and_gain(), lab::registry());
  const int tau = parameter_index(*program, "amplifier.times[0]"), gain = parameter_index(*program, "g.gain");
  constexpr int draws = 200;
  int inside_tau = 0, inside_gain = 0;
  for (int k = 0; k < draws; ++k) {
    lab::measure(data, program, 300e-9, static_cast<unsigned>(100 + k), {{tau, 0.1}, {gain, 2e-6}});
    DataSet noted = data;
    noted.notes["y"].noise.white = 300e-9;
    DataModel model(program, lab::shared(noted));
    const auto r = fit(model, noise_before_fit(model), free_parameters(*program, {"amplifier.times", "g.gain"}));
    ASSERT_TRUE(r.ok) << r.error;
    const auto &t = estimate(r, "amplifier.times[0]"), &g = estimate(r, "g.gain");
    ASSERT_TRUE(t.low95 && g.low95);
    inside_tau += *t.low95 <= 0.1 && 0.1 <= *t.high95;
    inside_gain += *g.low95 <= 2e-6 && 2e-6 <= *g.high95;
  }
  // 95 % of 200 with 3 standard deviations of a binomial: 190 +- 9.
  EXPECT_GE(inside_tau, 181);
  EXPECT_LE(inside_tau, 199);
  EXPECT_GE(inside_gain, 181);
  EXPECT_LE(inside_gain, 199);
}

TEST(Fit, AParameterOfEachRecordingIsFoundInEachAndTheSharedOneInAll) {
  // The same lag with another gain in each recording: as one gain for both, neither would fit.
  DataSet data = two_recordings();
  data.recordings[1].role = Role::train;
  const auto program = compile(lag_and_gain(), lab::registry());
  const int tau = parameter_index(*program, "amplifier.times[0]"), gain = parameter_index(*program, "g.gain");
  lab::measure(data, program, 1e-9, 21, {{tau, 0.02}, {gain, 3e-6, 0}, {gain, 5e-6, 1}});
  DataModel model(program, lab::shared(data));
  auto free = free_parameters(*program, {"amplifier.times", "g.gain"});
  free.push_back(free[1]);
  free[1].recording = 0;
  free[2].recording = 1;
  const auto r = fit(model, noise_before_fit(model), free);
  ASSERT_TRUE(r.ok) << r.error;
  const double truth[] = {0.02, 3e-6, 5e-6};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(r.values[i].recording, free[i].recording);
    EXPECT_EQ(r.estimates[i].linear, i > 0);
    ASSERT_TRUE(r.estimates[i].sigma);
    EXPECT_NEAR(*r.estimates[i].value, truth[i], 5 * *r.estimates[i].sigma);
    EXPECT_LT(*r.estimates[i].sigma, 1e-3 * truth[i]);
  }
}

TEST(Fit, ANonlinearParameterOfEachRecordingIsSimulatedInItsRecordingOnly) {
  DataSet data = two_recordings();
  data.recordings[1].role = Role::train;
  const auto program = compile(lag_and_gain(), lab::registry());
  const int tau = parameter_index(*program, "amplifier.times[0]");
  lab::measure(data, program, 1e-9, 22, {{tau, 0.02, 0}, {tau, 0.06, 1}});
  DataModel model(program, lab::shared(data));
  std::vector<FreeParameter> free(2, free_parameter(*program, "amplifier.times[0]"));
  free[0].recording = 0;
  free[1].recording = 1;
  const auto r = fit(model, noise_before_fit(model), free);
  ASSERT_TRUE(r.ok) << r.error;
  EXPECT_NEAR(*r.estimates[0].value, 0.02, 5 * *r.estimates[0].sigma);
  EXPECT_NEAR(*r.estimates[1].value, 0.06, 5 * *r.estimates[1].sigma);
  EXPECT_LT(*r.estimates[1].sigma, 1e-4);
  // Each is blind to the other's recording.
  ASSERT_EQ(r.correlation.size(), 4U);
  EXPECT_NEAR(r.correlation[1], 0, 1e-12);
}

TEST(Fit, APriorPullsByItsWeightAndIsCountedApart) {
  // One gain, white noise of known size: the posterior mean of two normal distributions in closed form.
  DataSet data = two_recordings();
  const auto program = compile(gain_and_offset(), lab::registry());
  const int gain = parameter_index(*program, "sensor.gain");
  lab::measure(data, program, 10e-9, 23, {{gain, 2.5e-6}});
  DataModel model(program, lab::shared(data));
  auto free = free_parameters(*program, {"sensor.gain"});
  const auto noise = noise_before_fit(model);
  const auto plain = fit(model, noise, free);
  const double sigma_data = 10e-9 / std::sqrt([&] {
                              double sum = 0;
                              for (const double u : data.recordings[0].columns["u"]) sum += u * u;
                              return sum;
                            }());
  // 95 % of the prior within four standard deviations of the data, one hundred of them away.
  const double mean = *plain.estimates[0].value + 100 * sigma_data, sigma = 2 * sigma_data;
  free[0].prior = {mean - 1.959963984540054 * sigma, mean + 1.959963984540054 * sigma};
  const auto r = fit(model, noise, free);
  ASSERT_TRUE(r.ok) << r.error;
  const double weight = 1 / (sigma_data * sigma_data), prior_weight = 1 / (sigma * sigma);
  const double expected = (weight * *plain.estimates[0].value + prior_weight * mean) / (weight + prior_weight);
  EXPECT_NEAR(*r.estimates[0].value, expected, 1e-6 * sigma_data);
  // The data alone: chi2 rises by ((x - x_data) / sigma_data)^2; the prior's own part is ((mean - x) / sigma)^2.
  EXPECT_NEAR(r.chi2 - plain.chi2, std::pow((expected - *plain.estimates[0].value) / sigma_data, 2), 1e-3);
  EXPECT_NEAR(r.prior_chi2, std::pow((mean - expected) / sigma, 2), 1e-3);
}

TEST(Fit, CorrelationsAreOneOnTheDiagonalAndSymmetric) {
  DataSet data = two_recordings();
  const auto program = compile(plays(4), lab::registry());
  lab::measure(data, program, 10e-9, 10);
  DataModel model(program, lab::shared(data));
  const auto r = fit(model, noise_before_fit(model), free_parameters(*program, {"core.weights"}));
  const std::size_t n = r.correlated.size();
  ASSERT_EQ(n, 4U);
  for (std::size_t i = 0; i < n; ++i) {
    EXPECT_NEAR(r.correlation[i * n + i], 1, 1e-12);
    for (std::size_t j = 0; j < n; ++j) {
      EXPECT_NEAR(r.correlation[i * n + j], r.correlation[j * n + i], 1e-12);
      EXPECT_LE(std::abs(r.correlation[i * n + j]), 1 + 1e-12);
    }
  }
}

TEST(Fit, TrialsThatCannotBeSimulatedCostOnlyThemselves) {
  // A pole in the right half plane: x grows as exp(rate t) and overflows within 4 s for rates above 180 1/s. The scan
  // tries some.
  DataSet data = two_recordings();
  Diagram d = lab::diagram("plant");
  auto& plant = lab::add(d, "plant", "transfer_function", "u");
  plant.parameters["gain"] = "1 um/V";
  plant.parameters["num"] = NumberList{{1, {}}};
  plant.parameters["den"] = NumberList{{1, {}}, {10, {}}};
  const auto program = compile(d, lab::registry());
  const int pole = parameter_index(*program, "plant.den[1]");
  lab::measure(data, program, 10e-9, 11, {{pole, 5}});
  DataModel model(program, lab::shared(data));
  auto free = free_parameters(*program, {"plant.gain", "plant.den[1]"});
  for (auto& f : free)
    if (f.parameter == pole) f.scan = {-1e4, -400, 1, 8, 100};
  const auto r = fit(model, noise_before_fit(model), free);
  ASSERT_TRUE(r.ok) << r.error;
  EXPECT_GE(r.failed_runs, 1);
  EXPECT_NEAR(*estimate(r, "plant.den[1]").value, 5, 5 * *estimate(r, "plant.den[1]").sigma);
  EXPECT_LT(*estimate(r, "plant.den[1]").sigma, 0.02);
}

TEST(Fit, AModelThatCannotBeSimulatedAnywhereIsAnAnswerAndNoCrash) {
  DataSet data = two_recordings();
  Diagram d = lab::diagram("plant");
  auto& plant = lab::add(d, "plant", "transfer_function", "u");
  plant.parameters["gain"] = "1 um/V";
  plant.parameters["num"] = NumberList{{1, {}}};
  plant.parameters["den"] = NumberList{{1, {}}, {-1e4, {}}};
  const auto program = compile(d, lab::registry());
  DataModel model(program, lab::shared(data));
  auto free = free_parameters(*program, {"plant.den[1]"});
  free[0].lower = -2e4;
  free[0].upper = -5e3;
  const auto r = fit(model, noise_before_fit(model), free);
  EXPECT_FALSE(r.ok);
  EXPECT_FALSE(r.error.empty());
}

TEST(Fit, GivesTheSameNumbersTwiceAndOnTwoThreads) {
  DataSet data = two_recordings();
  data.recordings[1].role = Role::train;
  const auto program = compile(lag_and_gain(), lab::registry());
  lab::measure(data, program, 10e-9, 12);
  const auto run = [&](int threads) {
    DataModelOptions o;
    o.threads = threads;
    DataModel model(program, lab::shared(data), o);
    return fit(model, noise_before_fit(model), free_parameters(*program, {"amplifier.times", "g.gain"}));
  };
  const auto a = run(1), b = run(1), c = run(2);
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    EXPECT_EQ(a.values[i].value, b.values[i].value);
    EXPECT_EQ(a.values[i].value, c.values[i].value);
    EXPECT_EQ(*a.estimates[i].sigma, *c.estimates[i].sigma);
  }
}

TEST(Fit, AZeroPerRecordingIsTakenOutOfEachRecording) {
  DataSet data = two_recordings();
  data.recordings[1].role = Role::train;
  data.notes["y"].zero_per_recording = true;
  const auto program = compile(lag_and_gain(), lab::registry());
  lab::measure(data, program, 1e-9, 13);
  for (double& y : data.recordings[0].columns["y"]) y += 4e-6;
  for (double& y : data.recordings[1].columns["y"]) y -= 7e-6;
  DataModel model(program, lab::shared(data));
  const auto r = fit(model, noise_before_fit(model), free_parameters(*program, {"amplifier.times", "g.gain"}));
  ASSERT_TRUE(r.ok);
  EXPECT_NEAR(*estimate(r, "g.gain").value, 1e-6, 5 * *estimate(r, "g.gain").sigma);
  EXPECT_NEAR(r.after.find(0)->zero[0], 4e-6, 1e-9);
  EXPECT_NEAR(r.after.find(1)->zero[0], -7e-6, 1e-9);
  EXPECT_NEAR(r.after.find(0)->rms[0], 1e-9, 2e-10);
}

TEST(Fit, AStartPerRecordingIsEstimatedWithTheParameters) {
  // The lag begins 2 V above its equilibrium in one recording; taken as rest, the gain and time constant would be
  // wrong.
  DataSet data = two_recordings();
  const auto program = compile(lag_and_gain(), lab::registry());
  const int tau = parameter_index(*program, "amplifier.times[0]");
  lab::measure(data, program, 1e-9, 14, {{tau, 0.3}});
  auto& r0 = data.recordings[0];
  for (std::size_t i = 0; i < r0.t.size(); ++i) r0.columns["y"][i] += 1e-6 * 2 * std::exp(-r0.t[i] / 0.3);
  r0.at_rest = false;
  r0.initial_per_recording = true;
  DataModel model(program, lab::shared(data));
  ASSERT_EQ(model.free_initial_states().size(), 1U);
  const auto r = fit(model, noise_before_fit(model), free_parameters(*program, {"amplifier.times", "g.gain"}));
  ASSERT_TRUE(r.ok) << r.error;
  EXPECT_NEAR(*estimate(r, "amplifier.times[0]").value, 0.3, 1e-4);
  EXPECT_NEAR(*estimate(r, "g.gain").value, 1e-6, 1e-10);
  EXPECT_NEAR(r.after.find(0)->rms[0], 1e-9, 2e-10);
}

void fit_bouc_wen(bool by_cvode) {
  DataSet data = two_recordings(150, 0.02);
  for (auto& r : data.recordings)
    for (std::size_t i = 0; i < r.t.size(); ++i)
      r.columns["u"][i] = 5 * std::sin(2 * std::numbers::pi * (r.role == Role::train ? 1.0 : 1.4) * r.t[i]);
  Diagram d = lab::diagram("core");
  auto& core = lab::add(d, "core", "bouc_wen", "u");
  core.parameters["alpha"] = "0.6 um/V";
  core.parameters["beta"] = "0.3 1/V";
  core.parameters["gamma"] = "0.05 1/V";
  core.parameters["d_p"] = "1.5 um/V";
  const auto program = compile(d, lab::registry());
  lab::measure(data, program, 1e-9, 20);
  DataModel model(program, lab::shared(data), {.force_cvode = by_cvode});
  EXPECT_EQ(model.why_not_exact().empty(), !by_cvode);
  auto free = free_parameters(*program, {"core.alpha", "core.beta", "core.d_p"});
  const double truth[] = {0.6e-6, 0.3, 1.5e-6};
  for (auto& f : free) f.start *= 1.3;
  const auto r = fit(model, noise_before_fit(model), free);
  ASSERT_TRUE(r.ok) << r.error;
  for (std::size_t i = 0; i < 3; ++i) {
    ASSERT_TRUE(r.estimates[i].sigma) << r.estimates[i].path;
    // BDF at 1e-7 adds a little to the noise.
    EXPECT_NEAR(*r.estimates[i].value, truth[i], 5 * *r.estimates[i].sigma + 1e-5 * truth[i]) << r.estimates[i].path;
    EXPECT_LT(*r.estimates[i].sigma, 0.01 * truth[i]);
  }
  if (by_cvode) return;
  for (const double worst : model.cross_check({}, model.recordings(Role::train))) EXPECT_LT(worst, 1e-5);
}

TEST(Fit, NonlinearStatesAreFittedThroughCvode) { fit_bouc_wen(true); }
TEST(Fit, NonlinearStatesAreFittedRowByRow) { fit_bouc_wen(false); }

TEST(Fit, NothingFreeAndNothingToFitAreErrorsWithACure) {
  DataSet data = two_recordings();
  const auto program = compile(gain_and_offset(), lab::registry());
  DataModel model(program, lab::shared(data));
  const auto code = [&](const auto& action) -> std::string {
    try {
      action();
    } catch (const Error& e) {
      EXPECT_FALSE(e.problems.front().cure.empty());
      return e.problems.front().code;
    }
    return "";
  };
  EXPECT_EQ(code([&] { fit(model, noise_before_fit(model), {}); }), "no_free_parameter");
  auto free = free_parameters(*program, {"sensor.gain"});
  free[0].lower = 1;
  EXPECT_EQ(code([&] { fit(model, noise_before_fit(model), free); }), "start_outside");
  for (auto& r : data.recordings) r.role = Role::validate;
  DataModel other(program, lab::shared(data));
  EXPECT_EQ(code([&] { fit(other, noise_before_fit(other), free_parameters(*program, {"sensor.gain"})); }),
            "no_train_recording");
}

TEST(Fit, StopsWhenAskedAndKeepsTheBest) {
  DataSet data = two_recordings();
  const auto program = compile(lag_and_gain(), lab::registry());
  lab::measure(data, program, 1e-9, 15, {{parameter_index(*program, "amplifier.times[0]"), 0.02}});
  DataModel model(program, lab::shared(data));
  FitOptions options;
  int calls = 0;
  options.progress = [&](const FitProgress&) { return ++calls < 3; };
  const auto r = fit(model, noise_before_fit(model), free_parameters(*program, {"amplifier.times", "g.gain"}), options);
  EXPECT_TRUE(r.ok);
  EXPECT_TRUE(r.stopped);
  EXPECT_LT(r.chi2, r.before.chi2(Role::train));
}

TEST(Fit, ADiagramThatNeedsNoFitStaysWhereItIs) {
  DataSet data = two_recordings();
  const auto program = compile(lag_and_gain(), lab::registry());
  lab::measure(data, program, 10e-9, 19);
  DataModel model(program, lab::shared(data));
  const auto r = fit(model, noise_before_fit(model), free_parameters(*program, {"amplifier.times", "g.gain"}));
  ASSERT_TRUE(r.ok);
  for (const auto& e : r.estimates) EXPECT_NEAR(*e.value, e.start, 4 * *e.sigma) << e.path;
  EXPECT_LE(r.chi2, r.before.chi2(Role::train));
}

}  // namespace
}  // namespace hysteron
