// Intervals where the model bends: profiles take over, and what is hardly told apart is said.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fit/estimate/fit.h"
#include "tests/fit/lab.h"

namespace hysteron {
namespace {

bool says(const FitResult& r, const std::string& words) {
  return std::any_of(r.remarks.begin(), r.remarks.end(),
                     [&](const std::string& remark) { return remark.find(words) != std::string::npos; });
}

/// A lag of 50 ms and a gain; `noise` [m] against a motion of some 10 um.
FitResult fitted_lag_and_gain(double noise, FitOptions options = {}) {
  Diagram d = lab::diagram("g");
  lab::add(d, "amplifier", "lag", "u").parameters["times"] = NumberList{{50, "ms"}};
  lab::add(d, "g", "gain", "amplifier").parameters["gain"] = "1 um/V";
  DataSet data;
  data.notes["u"].to = "u";
  data.notes["y"].to = "y";
  data.notes["y"].noise.white = noise;
  data.notes["y"].noise.one_over_f = 0.0;
  data.recordings = {lab::recording("train", Role::train, 0.01, 400,
                                    [](double t) { return 5 - 5 * std::cos(2 * std::numbers::pi * 0.8 * t); })};
  const auto program = compile(d, lab::registry());
  lab::measure(data, program, noise, 7);
  DataModel model(program, lab::shared(data));
  auto free = free_parameters(*program, {"amplifier.times", "g.gain"});
  for (auto& f : free)
    if (f.lower == 0) f.lower = 1e-9;
  return fit(model, noise_before_fit(model), free, options);
}

TEST(Curvature, WithLittleNoiseIntervalsAreThoseOfTheLinearization) {
  const auto r = fitted_lag_and_gain(10e-9);
  ASSERT_TRUE(r.ok) << r.error;
  EXPECT_FALSE(says(r, "bends"));
  const auto& e = r.estimates[0];
  const double middle = e.log_scale ? std::sqrt(*e.low95 * *e.high95) : 0.5 * (*e.low95 + *e.high95);
  EXPECT_NEAR(middle / *e.value, 1, 1e-9);
}

TEST(Curvature, WithMuchNoiseTheIntervalIsThatOfTheProfile) {
  FitOptions options;
  options.profile = {0};
  const auto r = fitted_lag_and_gain(15e-6, options);  // the time constant is known to a factor of some two
  ASSERT_TRUE(r.ok) << r.error;
  ASSERT_EQ(r.profiles.size(), 1U);
  const auto& e = r.estimates[0];
  ASSERT_TRUE(says(r, "is not linear over the intervals of amplifier.times[0]"));
  if (!e.determined) {
    EXPECT_FALSE(r.profiles[0].low95 && r.profiles[0].high95);
  } else {
    EXPECT_EQ(*e.low95, r.profiles[0].low95.value_or(e.lower));
    EXPECT_EQ(*e.high95, r.profiles[0].high95.value_or(e.upper));
  }
}

TEST(Curvature, AProfileThatWouldTakeTooLongIsOfferedAndNotMade) {
  FitOptions options;
  options.profile_steps = 1;
  const auto r = fitted_lag_and_gain(15e-6, options);
  ASSERT_TRUE(r.ok) << r.error;
  EXPECT_TRUE(says(r, "follow them with --profile"));
  const auto& e = r.estimates[0];
  const double middle = e.log_scale ? std::sqrt(*e.low95 * *e.high95) : 0.5 * (*e.low95 + *e.high95);
  EXPECT_NEAR(middle / *e.value, 1, 1e-9) << "the interval of the linearization";
}

FitResult fitted_jiles_atherton(double reach) {
  Diagram d = lab::diagram("core");
  auto& core = lab::add(d, "core", "jiles_atherton", "u");
  core.parameters["p_s"] = "50 um";
  core.parameters["a"] = "40 V";
  core.parameters["alpha"] = "0.1 V/um";
  core.parameters["k"] = "4 V";
  core.parameters["c"] = 0.6;
  DataSet data;
  data.notes["u"].to = "u";
  data.notes["y"].to = "y";
  data.notes["y"].noise.white = 30e-9;
  data.notes["y"].noise.one_over_f = 0.0;
  data.recordings = {lab::recording("train", Role::train, 2e-4, 1000, [reach](double t) {
    return reach / 2 * (1 - std::cos(2 * std::numbers::pi * 10 * t)) * (t < .1 ? 1 : .6);
  })};
  const auto program = compile(d, lab::registry());
  lab::measure(data, program, 30e-9, 3);
  DataModel model(program, lab::shared(data));
  return fit(model, noise_before_fit(model),
             free_parameters(*program, {"core.p_s", "core.a", "core.alpha", "core.k", "core.c"}), {});
}

TEST(Curvature, WhatASmallLoopHardlyTellsApartIsSaid) {
  const auto small = fitted_jiles_atherton(6);
  ASSERT_TRUE(small.ok) << small.error;
  EXPECT_TRUE(says(small, "core.p_s, core.a, core.alpha are strongly correlated"));
  const auto large = fitted_jiles_atherton(100);
  ASSERT_TRUE(large.ok) << large.error;
  EXPECT_FALSE(says(large, "strongly correlated"));
  EXPECT_TRUE(large.undetermined.empty());
}

}  // namespace
}  // namespace hysteron
