// What a model predicts for recordings: both ways of advancing, refined rows, failures.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/fit/two_recordings.h"

namespace hysteron {
namespace {

using namespace lab;

TEST(DataModel, ExactAdvanceAndCvodeAgree) {
  DataSet data = two_recordings();
  const auto program = compile(lag_and_gain(), lab::registry());
  lab::measure(data, program, 0, 17);
  DataModel model(program, lab::shared(data));
  EXPECT_EQ(model.why_not_exact(), "");
  const std::vector<int> all{0, 1};
  EXPECT_LT(model.cross_check({}, all)[0], 1e-5);  // BDF at 1e-7 per step, some hundred corners
}

TEST(DataModel, RowsAreRefinedUntilPlaysBehindWhichALagStandsNoLongerChange) {
  DataSet data = two_recordings(200, 0.02);
  Diagram d = plays(4);
  lab::add(d, "slow", "lag", "core").parameters["times"] = NumberList{{15, "ms"}};
  d.outputs["y"] = "slow";
  const auto program = compile(d, lab::registry());
  lab::measure(data, program, 0, 18);
  DataModel model(program, lab::shared(data));
  const std::vector<int> all{0, 1};
  model.predict({}, all);
  EXPECT_GT(model.substeps(0), 1);
  EXPECT_LT(model.cross_check({}, all)[0], 2e-5);
  const std::vector<double> coarse_noise{1e-6};
  model.choose_substeps({}, coarse_noise);
  EXPECT_LE(model.substeps(0), 8);
}

TEST(DataModel, AFailingSimulationIsAValue) {
  DataSet data = two_recordings();
  const auto program = compile(lag_and_gain(), lab::registry());
  DataModel model(program, lab::shared(data));
  const std::vector<ParameterValue> bad{{parameter_index(*program, "amplifier.times[0]"), std::nan("")}};
  const std::vector<int> all{0, 1};
  const auto p = model.predict(bad, all);
  EXPECT_FALSE(p.ok);
  EXPECT_FALSE(p.error.empty());
  EXPECT_EQ(model.failures(), 2);
}

}  // namespace
}  // namespace hysteron
