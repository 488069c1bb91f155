// Real recordings, used in place: what others and a fit by hand reached is reached here.
#include <gtest/gtest.h>

#include <filesystem>

#include "fit/compare/compare.h"
#include "fit/estimate/fit.h"
#include "fit/inspect/delay.h"
#include "tests/fit/lab.h"

namespace hysteron {
namespace {

const std::string measured = HYSTERON_SHARED_DIR "/measured";

std::vector<int> all(const DataModel& model) {
  std::vector<int> list;
  for (int r = 0; r < model.n_recordings(); ++r) list.push_back(r);
  return list;
}

/// Train and first half of the test file of the piezo stack, as its README says: first 2 s skipped, own zero, one
/// sample late.
std::shared_ptr<const DataSet> piezo_stack(int delay) {
  DataSet data;
  data.notes["u"].to = "u";
  auto& y = data.notes["y"];
  y.to = "y";
  y.zero_per_recording = true;
  y.delay_samples = delay;
  const std::string folder = measured + "/piezo-stack-p885/";
  for (const auto& [file, role] :
       {std::pair{"train_sine_1Hz.csv", Role::train}, {"test_varying_amplitude.csv", Role::validate}}) {
    auto whole = read_dataset(folder + file, {measured});
    Recording r = whole.recordings.front();
    r.name = file;
    r.role = role;
    r.first = static_cast<std::size_t>(std::lower_bound(r.t.begin(), r.t.end(), r.t.front() + 2) - r.t.begin());
    const double until = role == Role::validate ? 37 : 1e9;
    r.last = static_cast<std::size_t>(std::upper_bound(r.t.begin(), r.t.end(), until) - r.t.begin());
    data.recordings.push_back(std::move(r));
  }
  return std::make_shared<DataSet>(std::move(data));
}

double nrmse(DataModel& model, const FitWithNoise& r, Role role) {
  const Judge judge(model, r.noise);
  return compare(model, judge, model.predict(r.result.values, all(model))).find(role, 0)->nrmse;
}

TEST(MeasuredPiezoStack, PlaysFittedOnTheMajorLoopPredictTheMinorOnes) {
  if (!std::filesystem::exists(measured)) GTEST_SKIP() << measured << " is not there";
  const auto data = piezo_stack(1);
  Diagram gain = lab::diagram("g");
  lab::add(gain, "g", "gain", "u").parameters["gain"] = "1 um/V";
  DataModel base(compile(gain, lab::registry()), data);
  const auto line = fit_and_noise(base, free_parameters(base.program(), {"g.gain"}));
  EXPECT_NEAR(nrmse(base, line, Role::train), 0.179, 0.002);     // README: 17.9 %
  EXPECT_NEAR(nrmse(base, line, Role::validate), 0.180, 0.005);  // README: 18.3 % on the whole test file

  Diagram d = lab::diagram("core");
  auto& core = lab::add(d, "core", "prandtl_ishlinskii", "u");
  NumberList thresholds, weights;
  for (int i = 0; i < 15; ++i) {
    thresholds.push_back({0.22 * i, "V"});
    weights.push_back({1, "um/V"});
  }
  core.parameters["thresholds"] = thresholds;
  core.parameters["weights"] = weights;
  DataModel model(compile(d, lab::registry()), data);
  auto free = free_parameters(model.program(), {"core.weights"});
  for (auto& f : free) f.lower = 0;
  const auto plays = fit_and_noise(model, free);
  EXPECT_LT(nrmse(model, plays, Role::train), 0.024);     // by hand 2.1-2.2 %
  EXPECT_LT(nrmse(model, plays, Role::validate), 0.037);  // by hand 3.4-3.6 %
}

TEST(MeasuredPiezoStack, AHystereticResidualIsNotSoldAsADelay) {
  if (!std::filesystem::exists(measured)) GTEST_SKIP() << measured << " is not there";
  Diagram gain = lab::diagram("g");
  lab::add(gain, "g", "gain", "u").parameters["gain"] = "1 um/V";
  DataModel base(compile(gain, lab::registry()), piezo_stack(1));
  const auto line = fit_and_noise(base, free_parameters(base.program(), {"g.gain"}));
  const Judge judge(base, line.noise);
  EXPECT_EQ(find_delays(base, judge, base.predict(line.result.values, all(base))).front().kind, DelayKind::unclear);
}

TEST(MeasuredHeater, ASecondLagTakesTheRestOfTheRecordBelowSixPercent) {
  if (!std::filesystem::exists(measured)) GTEST_SKIP() << measured << " is not there";
  DataSet data = read_dataset(measured + "/thermal-tclab/one_heater_steps.csv", {measured});
  data.notes["u1"].to = "u1";
  data.notes["u1"].between = Between::hold;
  const auto shared = std::make_shared<DataSet>(data);
  Diagram d;
  d.inputs["u1"].unit = "%";
  d.outputs["T1"] = "sensor";
  auto& plant = lab::add(d, "plant", "lag", "u1");
  plant.parameters["times"] = NumberList{{100, "s"}};
  auto& sensor = lab::add(d, "sensor", "calibration", "plant");
  sensor.parameters["gain"] = "0.5 K/%";
  sensor.parameters["offset"] = "20 degC";
  {
    DataModel model(compile(d, lab::registry()), shared);
    const auto r =
        fit_and_noise(model, free_parameters(model.program(), {"plant.times", "sensor.gain", "sensor.offset"}));
    EXPECT_NEAR(nrmse(model, r, Role::validate), 0.39, 0.02);  // README: 39 %
  }
  d.blocks["plant"].parameters["times"] = NumberList{{100, "s"}, {10, "s"}};
  DataModel model(compile(d, lab::registry()), shared);
  const auto r =
      fit_and_noise(model, free_parameters(model.program(), {"plant.times", "sensor.gain", "sensor.offset"}));
  ASSERT_TRUE(r.result.ok) << r.result.error;
  EXPECT_LT(nrmse(model, r, Role::validate), 0.06);
  for (const auto& e : r.result.estimates) {
    if (e.path == "plant.times[0]") {
      EXPECT_NEAR(*e.value, 132, 5);
    }  // by hand 132 s
    if (e.path == "plant.times[1]") {
      EXPECT_NEAR(*e.value, 16, 1.5);
    }  // and 16 s
  }
}

}  // namespace
}  // namespace hysteron
