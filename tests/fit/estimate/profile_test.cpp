// Profiles: where the model is linear they are the parabola of the standard deviation, elsewhere they know better.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/fit/two_recordings.h"

namespace hysteron {
namespace {

using namespace lab;

DataSet data_of(double noise, std::size_t rows = 400) {
  DataSet data;
  data.notes["u"].to = "u";
  data.notes["y"].to = "y";
  data.notes["y"].noise.white = noise;
  data.notes["y"].noise.one_over_f = 0.0;
  data.recordings = {lab::recording("train", Role::train, 0.01, rows, sweep)};
  return data;
}

TEST(ProfileLikelihood, OfALinearParameterIsItsInterval) {
  DataSet data = data_of(10e-9);
  const auto program = compile(lag_and_gain(), lab::registry());
  lab::measure(data, program, 10e-9, 41);
  DataModel model(program, lab::shared(data));
  FitOptions options;
  options.profile = {0};
  const auto r = fit(model, noise_before_fit(model), free_parameters(*program, {"g.gain"}), options);
  ASSERT_TRUE(r.ok) << r.error;
  ASSERT_EQ(r.profiles.size(), 1U);
  const auto& p = r.profiles[0];
  const auto& e = r.estimates[0];
  ASSERT_TRUE(p.low95 && p.high95);
  // sqrt(3.84) = 1.96 standard deviations; the rise is an exact parabola, found on a straight line of its root.
  EXPECT_NEAR((*p.high95 - *e.value) / *e.sigma, 1.96, 0.001);
  EXPECT_NEAR((*e.value - *p.low95) / *e.sigma, 1.96, 0.001);
  for (std::size_t i = 0; i < p.value.size(); ++i)
    EXPECT_NEAR(p.rise[i], std::pow((p.value[i] - *e.value) / *e.sigma, 2), 1e-4 * (1 + p.rise[i]));
}

TEST(ProfileLikelihood, FitsTheOthersAgainAtEveryValue) {
  // Held, the gain alone would rise by (x / conditional sigma)^2; with the time constant fitted again it is the joint
  // one.
  DataSet data = data_of(100e-9);
  const auto program = compile(lag_and_gain(), lab::registry());
  lab::measure(data, program, 100e-9, 42);
  DataModel model(program, lab::shared(data));
  FitOptions options;
  options.profile = {0, 1};
  const auto r = fit(model, noise_before_fit(model), free_parameters(*program, {"amplifier.times", "g.gain"}), options);
  ASSERT_EQ(r.profiles.size(), 2U);
  for (const auto& p : r.profiles) {
    const auto& e = r.estimates[static_cast<std::size_t>(p.estimate)];
    ASSERT_TRUE(p.low95 && p.high95);
    // Sure to better than a per cent, the model is all but linear within the interval.
    EXPECT_NEAR((*p.high95 - *p.low95) / (2 * *e.sigma), 1.96, 0.04) << e.path;
    EXPECT_TRUE(std::is_sorted(p.value.begin(), p.value.end()));
    EXPECT_EQ(*std::min_element(p.rise.begin(), p.rise.end()), 0);
  }
}

TEST(ProfileLikelihood, HasAnOpenEndWhereTheDataSayNoLimit) {
  // A lag far below the row step: any smaller one fits as well, a much larger one does not.
  DataSet data = data_of(10e-9);
  const auto program = compile(lag_and_gain(), lab::registry());
  const int tau = parameter_index(*program, "amplifier.times[0]");
  lab::measure(data, program, 10e-9, 43, {{tau, 1e-6}});
  DataModel model(program, lab::shared(data));
  auto free = free_parameters(*program, {"amplifier.times", "g.gain"});
  free[0].start = 1e-4;
  free[0].lower = 1e-9;
  free[0].upper = 10;
  FitOptions options;
  options.profile = {0};
  const auto r = fit(model, noise_before_fit(model), free, options);
  ASSERT_EQ(r.profiles.size(), 1U);
  EXPECT_FALSE(r.profiles[0].low95);
  ASSERT_TRUE(r.profiles[0].high95);
  EXPECT_LT(*r.profiles[0].high95, 1e-3);
}

TEST(GlobalStart, ASwarmFindsTheValleyThatTheStartMisses) {
  // A sine one and a half periods late looks best half a period late to a search that begins at zero.
  DataSet data = data_of(1e-9);
  auto& r0 = data.recordings[0];
  for (std::size_t i = 0; i < r0.t.size(); ++i)
    r0.columns["u"][i] = std::sin(2 * std::numbers::pi * r0.t[i]) + 0.3 * r0.t[i];
  Diagram d = lab::diagram("g");
  lab::add(d, "late", "dead_time", "u").parameters["delay"] = "1 ms";
  lab::add(d, "g", "gain", "late").parameters["gain"] = "1 um/V";
  const auto program = compile(d, lab::registry());
  lab::measure(data, program, 1e-9, 44, {{parameter_index(*program, "late.delay"), 1.4}});
  DataModel model(program, lab::shared(data));
  auto free = free_parameters(*program, {"late.delay", "g.gain"});
  free[0].lower = 0;
  free[0].upper = 3;
  free[0].log_scale = false;
  const auto noise = noise_before_fit(model);
  FitOptions options;
  for (const char* method : {"pso", "direct"}) {
    options.global = method;
    options.global_runs = 200;
    const auto r = fit(model, noise, free, options);
    ASSERT_TRUE(r.ok) << r.error;
    EXPECT_NEAR(r.values[0].value, 1.4, 1e-4) << method;
    EXPECT_FALSE(r.global_history.empty());
    EXPECT_NE(r.method.find(method), std::string::npos) << r.method;
  }
  options.global.clear();
  options.starts = 40;
  EXPECT_NEAR(fit(model, noise, free, options).values[0].value, 1.4, 1e-4);
}

}  // namespace
}  // namespace hysteron
