#include "fit/model/free_parameter.h"

#include <gtest/gtest.h>

#include "engine/diagram/error.h"
#include "tests/fit/lab.h"

namespace hysteron {
namespace {

/// u -> plays (weights) -> lag -> calibration (gain, offset) -> y
Diagram chain() {
  Diagram d = lab::diagram("sensor");
  auto& core = lab::add(d, "core", "prandtl_ishlinskii", "u");
  core.parameters["thresholds"] = NumberList{{0, "V"}, {1, "V"}, {2, "V"}};
  core.parameters["weights"] = NumberList{{1, "um/V"}, {0.2, "um/V"}, {0.1, "um/V"}};
  lab::add(d, "amplifier", "lag", "core").parameters["times"] = NumberList{{1, "ms"}};
  auto& sensor = lab::add(d, "sensor", "calibration", "amplifier");
  sensor.parameters["gain"] = 1.0;
  sensor.parameters["offset"] = "0 um";
  return d;
}

std::vector<bool> affine(const Diagram& d, const std::vector<std::string>& paths) {
  const auto program = compile(d, lab::registry());
  std::vector<int> parameters;
  for (const auto& p : paths) parameters.push_back(parameter_index(*program, p));
  return jointly_affine(*program, parameters, program->output_signals);
}

TEST(FreeParameters, AListNameMeansAllItsElementsInOrder) {
  const auto program = compile(chain(), lab::registry());
  const auto free = free_parameters(*program, {"core.weights"});
  ASSERT_EQ(free.size(), 3U);
  EXPECT_EQ(program->parameters[static_cast<std::size_t>(free[2].parameter)].path, "core.weights[2]");
  EXPECT_DOUBLE_EQ(free[1].start, 0.2e-6);
}

TEST(FreeParameters, ThoseOfTheDiagramComeWithTheirBounds) {
  Diagram d = chain();
  d.parameters["gain"] = {Value(Number{2, {}}), Number{0.5, {}}, Number{4, {}}, true, ""};
  d.blocks["sensor"].parameters["gain"] = Reference{"gain"};
  const auto program = compile(d, lab::registry());
  const auto free = free_parameters(*program);
  ASSERT_EQ(free.size(), 1U);
  EXPECT_EQ(free[0].start, 2);
  EXPECT_EQ(free[0].lower, 0.5);
  EXPECT_EQ(free[0].upper, 4);
  EXPECT_FALSE(free[0].log_scale);
}

TEST(FreeParameters, ATimeConstantIsSearchedOnALogarithmicScale) {
  const auto program = compile(chain(), lab::registry());
  EXPECT_TRUE(free_parameter(*program, "amplifier.times[0]").log_scale);
}

TEST(FreeParameters, AnUnknownOneIsNamedWithTheNearest) {
  const auto program = compile(chain(), lab::registry());
  try {
    free_parameters(*program, {"core.weight"});
    FAIL() << "an unknown parameter was taken";
  } catch (const Error& e) {
    EXPECT_EQ(e.problems.front().code, "unknown_parameter");
    EXPECT_EQ(e.problems.front().path, "core.weight");
    EXPECT_NE(e.problems.front().cure.find("core.weights"), std::string::npos) << e.problems.front().cure;
  }
}

TEST(JointlyAffine, WeightsBeforeALinearChainAndAnOffsetBehindItGoTogether) {
  EXPECT_EQ(affine(chain(), {"core.weights[0]", "core.weights[1]", "sensor.offset"}),
            (std::vector<bool>{true, true, true}));
}

TEST(JointlyAffine, AGainBehindTheWeightsMultipliesThemAndStaysOut) {
  EXPECT_EQ(affine(chain(), {"sensor.gain", "core.weights[0]", "core.weights[1]", "sensor.offset"}),
            (std::vector<bool>{false, true, true, true}));
}

TEST(JointlyAffine, TheGainIsTakenWhereItIsAlone) {
  EXPECT_EQ(affine(chain(), {"sensor.gain", "sensor.offset", "amplifier.times[0]"}),
            (std::vector<bool>{true, true, false}));
}

TEST(JointlyAffine, AnOffsetBeforeAGainStaysOutWhereBothAreFree) {
  // y = gain (u + offset): bilinear. Whichever is left, never both.
  Diagram d = lab::diagram("g");
  auto& before = lab::add(d, "before", "calibration", "u");
  before.parameters["gain"] = 1.0;
  before.parameters["offset"] = "1 V";
  lab::add(d, "g", "gain", "before").parameters["gain"] = "2 um/V";
  const auto both = affine(d, {"before.offset", "g.gain"});
  EXPECT_NE(both[0], both[1]);
}

TEST(JointlyAffine, NothingBeforeASaturationIs) {
  Diagram d = lab::diagram("limit");
  lab::add(d, "g", "gain", "u").parameters["gain"] = "2 um/V";
  auto& limit = lab::add(d, "limit", "saturation", "g");
  limit.parameters["lower"] = "0 um";
  limit.parameters["upper"] = "10 um";
  EXPECT_EQ(affine(d, {"g.gain"}), (std::vector<bool>{false}));
}

TEST(JointlyAffine, GainsOfParallelPathsGoTogether) {
  Diagram d = lab::diagram("sum");
  lab::add(d, "a", "gain", "u").parameters["gain"] = "2 um/V";
  lab::add(d, "b", "gain", "u").parameters["gain"] = "1 um/V";
  lab::add(d, "late", "dead_time", "b").parameters["delay"] = "1 ms";
  auto& sum = d.blocks["sum"];
  sum.type = "sum";
  sum.in = {{"", "a"}, {"", "late"}};
  EXPECT_EQ(affine(d, {"a.gain", "b.gain"}), (std::vector<bool>{true, true}));
}

}  // namespace
}  // namespace hysteron
