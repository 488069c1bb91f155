// A fit that is stopped at any moment gives the best so far, or says that it has nothing yet; never a failure of the
// model, and never something worse than it began with.
#include "engine/diagram/stop.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

#include "fit/estimate/fit.h"
#include "fit/thesis/thesis_methods.h"
#include "tests/fit/lab.h"

namespace hysteron {
namespace {

/// A lag and a gain, far from where they are: many trials.
struct Lab {
  Lab() {
    Diagram d = lab::diagram("sensor");
    lab::add(d, "lag", "lag", "u").parameters["times"] = Value(NumberList{Number{20, "ms"}});
    auto& sensor = lab::add(d, "sensor", "calibration", "lag");
    sensor.parameters["gain"] = Value(Number{1.5, "um/V"});
    sensor.parameters["offset"] = Value(Number{0.1, "um"});
    const auto truth = compile(d, lab::registry());
    const auto wave = [](double t) { return 2 + 2 * std::sin(9 * t) + std::sin(31 * t); };
    data.recordings = {lab::recording("a", Role::train, 0.005, 2000, wave),
                       lab::recording("b", Role::validate, 0.005, 1000, wave)};
    lab::measure(data, truth, 1e-8, 3);
    d.blocks["lag"].parameters["times"] = Value(NumberList{Number{300, "ms"}});
    sensor.parameters["gain"] = Value(Number{1.0, "um/V"});
    program = compile(d, lab::registry());
    for (const char* path : {"lag.times[0]", "sensor.gain", "sensor.offset"}) {
      free.push_back(free_parameter(*program, path));
      if (std::string(path) == "lag.times[0]") {
        free.back().lower = 1e-3;
        free.back().upper = 1;
        free.back().log_scale = true;
      }
    }
  }
  DataModel model() const { return {program, std::make_shared<const DataSet>(data)}; }
  DataSet data;
  ProgramPointer program;
  std::vector<FreeParameter> free;
};

FitOptions with_everything(const std::string& global) {
  FitOptions options;
  options.starts = 4;
  options.profile = {0};
  options.global = global;
  options.global_runs = 60;
  return options;
}

TEST(StopOfAFit, AtAnyMomentLeavesTheBestSoFarOrSaysThatThereIsNothing) {
  const Lab lab;
  for (const std::string global : {"", "pso", "crs2", "direct"}) {
    long asked = 0;
    const auto fitted = [&](long at) {
      auto model = lab.model();
      asked = 0;
      const StopScope scope([&] { return ++asked >= at; });
      return fit_and_noise(model, lab.free, with_everything(global)).result;
    };
    const FitResult whole = fitted(1'000'000'000);
    ASSERT_TRUE(whole.ok) << whole.error;
    EXPECT_FALSE(whole.stopped);
    const long all = asked;
    ASSERT_GT(all, 100);
    bool kept = false;
    double best = std::numeric_limits<double>::infinity();
    for (long at = 1; at < all; at += std::max(1L, at / 3)) {
      const FitResult now = fitted(at);
      SCOPED_TRACE(global + " " + std::to_string(at) + " of " + std::to_string(all));
      EXPECT_TRUE(now.stopped);
      EXPECT_LE(asked, at + 20) << "it looks up and goes on all the same";
      if (!now.ok) {
        EXPECT_FALSE(kept) << "what was found earlier is lost";
        EXPECT_NE(now.error.find("stopped before"), std::string::npos) << now.error;
        continue;
      }
      kept = true;
      ASSERT_EQ(now.values.size(), lab.free.size());
      ASSERT_EQ(now.estimates.size(), lab.free.size());
      for (const auto& v : now.values) EXPECT_TRUE(std::isfinite(v.value));
      // Later is not worse; after the second of the two fits began, chi2 is counted by another noise.
      if (at < all / 3) {
        EXPECT_LE(now.chi2, best * (1 + 1e-9));
        best = std::min(best, now.chi2);
      }
    }
    EXPECT_TRUE(kept);
  }
}

TEST(StopOfAFit, OfTheThesisMethodsLeavesTheStepsThatWereDone) {
  Diagram d = lab::diagram("core");
  auto& core = lab::add(d, "core", "prandtl_ishlinskii", "u");
  core.parameters["thresholds"] = Value(NumberList{Number{0, "V"}, Number{1, "V"}, Number{2, "V"}});
  core.parameters["weights"] = Value(NumberList{Number{0.8, "um/V"}, Number{0.2, "um/V"}, Number{0.1, "um/V"}});
  const auto program = compile(d, lab::registry());
  DataSet data;
  data.recordings = {lab::recording("a", Role::train, 0.005, 2000, [](double t) { return 3 - 3 * std::cos(2 * t); })};
  lab::measure(data, program, 0, 1);
  DataModel model(program, std::make_shared<const DataSet>(data));
  const NoiseModel noise = noise_before_fit(model);
  const StopScope scope([] { return true; });
  EXPECT_THROW(fit_as_thesis(model, noise, "slopes", {}), Stopped) << "nothing was found yet";
}

}  // namespace
}  // namespace hysteron
