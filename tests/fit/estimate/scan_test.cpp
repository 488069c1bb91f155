// Where the searches of a fit begin: values that are tried beforehand.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/fit/two_recordings.h"

namespace hysteron {
namespace {

using namespace lab;

TEST(Scan, AScanLeadsPastALocalMinimum) {
  // A sine that is one and a half periods late looks best when delayed by half a period: a local search
  // that begins near there ends there.
  DataSet data = two_recordings();
  for (auto& r : data.recordings)
    for (std::size_t i = 0; i < r.t.size(); ++i)
      r.columns["u"][i] = std::sin(2 * std::numbers::pi * 1.0 * r.t[i]) + (r.role == Role::train ? 0.3 : 0.1) * r.t[i];
  Diagram d = lab::diagram("g");
  lab::add(d, "late", "dead_time", "u").parameters["delay"] = "1 ms";
  lab::add(d, "g", "gain", "late").parameters["gain"] = "1 um/V";
  const auto program = compile(d, lab::registry());
  lab::measure(data, program, 1e-9, 6, {{parameter_index(*program, "late.delay"), 1.4}});
  DataModel model(program, lab::shared(data));
  auto free = free_parameters(*program, {"late.delay", "g.gain"});
  free[0].upper = 3;
  free[0].start = 0.4;  // one period early: the bottom of a valley of its own
  const auto without = fit(model, noise_before_fit(model), free);
  free[0].scan = {0.2, 0.5, 0.8, 1.1, 1.5, 2.0};
  const auto with = fit(model, noise_before_fit(model), free);
  EXPECT_GT(std::abs(without.values[0].value - 1.4), 0.1);
  EXPECT_NEAR(with.values[0].value, 1.4, 1e-4);
}

TEST(Scan, AScanGoesRoundAgainWhereTheBestValueOfOneDependsOnAnother) {
  // A drive whose two rates are limited, before a stage that still rings from one step (49 Hz, damping 0.035) when the
  // next one comes: without a limit downwards the best one upwards is a wrong one, and no slope leads from there.
  DataSet data = two_recordings(1600, 0.62e-3);
  const std::vector<double> levels{0, 1.8, -1.4, 0.5, 0.52, -0.36, -0.62, 0.8};
  for (auto& r : data.recordings)
    for (std::size_t i = 0; i < r.t.size(); ++i) r.columns["u"][i] = levels[i / 200];
  data.notes["y"].noise.white = 1e-9;
  Diagram d = lab::diagram("stage.position");
  Node& limit = lab::add(d, "limit", "slew_limit", "u");
  for (const char* rate : {"rate", "rise", "fall"}) limit.parameters[rate] = "5200 V/s";
  lab::add(d, "force", "gain", "limit").parameters["gain"] = "0.2 N/V";
  Node& stage = lab::add(d, "stage", "mass_spring_damper", "force");
  stage.parameters["mass"] = "0.924 kg";
  stage.parameters["damping"] = "19.7 N*s/m";
  stage.parameters["stiffness"] = "88 kN/m";
  const auto program = compile(d, lab::registry());
  lab::measure(data, program, 1e-9, 6,
               {{parameter_index(*program, "limit.rise"), 2232}, {parameter_index(*program, "limit.fall"), 2900}});
  DataModel model(program, lab::shared(data));
  auto free = free_parameters(*program, {"limit.rise", "limit.fall"});
  for (auto& f : free) {
    f.upper = 5200;
    f.log_scale = true;
    for (const double share : {1.0, 0.01, 0.03, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.78, 0.84, 0.88, 0.91, 0.94, 0.97})
      f.scan.push_back(share * 5200);
  }
  const auto found = fit(model, noise_before_fit(model), free);
  // The ringing is 500 times the noise; rows are simulated to a tenth of that, 1 part in 5000 of what a rate moves, and
  // rows of several steps add up. Other valleys lie a fifth away.
  EXPECT_NEAR(*estimate(found, "limit.rise").value, 2232, 4);
  EXPECT_NEAR(*estimate(found, "limit.fall").value, 2900, 4);
}

TEST(Scan, StartsThatMoveNoRowAreOneStart) {
  // One-sided plays at rest at 0 keep nothing of a positive past: all such values look alike, and better than one that
  // is negative as the truth is, but too large.
  DataSet data = two_recordings();
  data.recordings.front() = lab::recording("train", Role::train, 0.01, 400, decaying);
  const auto program = compile(plays(6), lab::registry());
  const int before = parameter_index(*program, "core.before");
  lab::measure(data, program, 0, 6, {{before, -0.02}});
  DataModel model(program, lab::shared(data));
  auto free = free_parameters(*program, {"core.before"});
  free[0].scan = {-1, -0.1, 0.1, 0.5, 1};
  const auto found = fit(model, noise_before_fit(model), free);
  EXPECT_NEAR(found.values[0].value, -0.02, 1e-9);
  // Also where one start alone is searched from: from 0 itself no search begins.
  FitOptions one;
  one.refine = 1;
  EXPECT_NEAR(fit(model, noise_before_fit(model), free, one).values[0].value, -0.02, 1e-9);
}

}  // namespace
}  // namespace hysteron
