#include "fit/estimate/thresholds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/diagram/error.h"
#include "tests/fit/lab.h"

namespace hysteron {
namespace {

std::vector<double> triangle(double low, double high, int rows) {
  std::vector<double> u;
  for (int i = 0; i <= rows; ++i) u.push_back(low + (high - low) * i / rows);
  for (int i = rows - 1; i >= 0; --i) u.push_back(low + (high - low) * i / rows);
  return u;
}

TEST(Thresholds, LieEvenlyOverTheSwingOneSidedAndOverHalfOfItTwoSided) {
  const std::vector<std::vector<double>> inputs{triangle(2, 10, 100)};
  const auto one = place_thresholds(inputs, 4, false, Placement::even);
  ASSERT_EQ(one.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(one[i], 2.0 * static_cast<double>(i), 1e-12);  // 8 V in four parts
  const auto two = place_thresholds(inputs, 4, true, Placement::even);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(two[i], static_cast<double>(i), 1e-12);
}

TEST(Thresholds, BySwingTheyLieWhereTheRowsAre) {
  // Nine small loops of 1 V for one of 10 V: half of the rows move within half a volt of a turn, or nearly so.
  std::vector<double> u = triangle(0, 10, 100);
  for (int k = 0; k < 90; ++k) {
    const auto small = triangle(0, 1, 100);
    u.insert(u.end(), small.begin(), small.end());
  }
  const auto placed = place_thresholds(std::vector<std::vector<double>>{u}, 10, false, Placement::by_swing);
  EXPECT_GE(std::count_if(placed.begin(), placed.end(), [](double r) { return r < 1.01; }), 9);
  EXPECT_TRUE(std::is_sorted(placed.begin(), placed.end()));
}

TEST(Thresholds, WithoutMotionThereIsTheLinearPartAlone) {
  EXPECT_EQ(place_thresholds(std::vector<std::vector<double>>{{3, 3, 3}}, 5, false, Placement::even),
            std::vector<double>{0});
}

TEST(Thresholds, MergingKeepsTheSumOfWeightsTheirCentreAndTheLinearPart) {
  const auto few = merge_operators({{0, 1, 2, 3, 10}, {5, 1, 0, 3, 2}}, 3);
  // 1 and 3 lie closest: weight 4 at (1 * 1 + 3 * 3) / 4 = 2.5; the operator without weight is gone.
  EXPECT_EQ(few.thresholds, (std::vector<double>{0, 2.5, 10}));
  EXPECT_EQ(few.weights, (std::vector<double>{5, 4, 2}));
}

TEST(Thresholds, AreFoundWhereTheyAre) {
  // Three operators at thresholds that no even grid holds.
  Diagram d = lab::diagram("core");
  auto& core = lab::add(d, "core", "prandtl_ishlinskii", "u");
  core.parameters["thresholds"] = NumberList{{0, "V"}, {1.37, "V"}, {3.9, "V"}, {6.61, "V"}};
  core.parameters["weights"] = NumberList{{0.8, "um/V"}, {0.3, "um/V"}, {0.2, "um/V"}, {0.25, "um/V"}};
  DataSet data;
  data.notes["u"].to = "u";
  data.notes["y"].to = "y";
  data.notes["y"].noise.white = 1e-9;
  data.notes["y"].noise.one_over_f = 0.0;
  data.recordings = {lab::recording("train", Role::train, 0.005, 2000, [](double t) {
    return 5 - 5 * std::cos(2 * std::numbers::pi * t) * (0.6 + 0.4 * std::cos(2 * std::numbers::pi * 0.1 * t));
  })};
  lab::measure(data, compile(d, lab::registry()), 1e-9, 61);
  core.parameters["thresholds"] = NumberList{{0, "V"}, {1, "V"}};
  core.parameters["weights"] = NumberList{{1, "um/V"}, {0.1, "um/V"}};
  const auto found = fit_thresholds(d, lab::registry(), lab::shared(data), "core", 4);
  ASSERT_TRUE(found.result.ok) << found.result.error;
  const auto* thresholds =
      std::get_if<NumberList>(&found.diagram.blocks.find("core")->parameters.find("thresholds")->content);
  ASSERT_NE(thresholds, nullptr);
  ASSERT_EQ(thresholds->size(), 4U);
  const double truth[] = {0, 1.37, 3.9, 6.61};
  // 2000 rows of 1 nm noise against 0.2 um/V: a threshold is sure to about a millivolt.
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR((*thresholds)[i].value, truth[i], 0.01) << i;
    EXPECT_EQ((*thresholds)[i].unit.value_or(""), "V");
  }
  EXPECT_LT(found.result.chi2 / found.result.n, 1.2) << found.result.convergence;
}

TEST(Thresholds, OfWhatHasNoneAreAnErrorWithACure) {
  Diagram d = lab::diagram("g");
  lab::add(d, "g", "gain", "u").parameters["gain"] = "1 um/V";
  DataSet data;
  data.recordings = {lab::recording("train", Role::train, 0.01, 10, [](double t) { return t; })};
  for (const auto& [block, code] : {std::pair{"g", "wrong_type"}, {"h", "no_block"}}) {
    try {
      fit_thresholds(d, lab::registry(), lab::shared(data), block, 4);
      FAIL();
    } catch (const Error& error) {
      EXPECT_EQ(error.problems.front().code, code);
      EXPECT_FALSE(error.problems.front().cure.empty());
    }
  }
}

}  // namespace
}  // namespace hysteron
