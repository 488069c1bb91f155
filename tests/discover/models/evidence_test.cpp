// What counts as evidence, on residuals whose chi2 is known.
#include "discover/models/evidence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "blocks/register_all.h"
#include "tests/discover/synthetic.h"

namespace hysteron {
namespace {

using namespace testing;

constexpr double white = 1e-3;

class EvidenceOf : public ::testing::Test {
 protected:
  /// Three recordings of a gain of one, noise of 1 mm and `added` to it.
  DataModel measured(const std::function<double(double t, double u)>& added, double noisy = 1) {
    std::vector<Recording> list;
    for (int r = 0; r < 3; ++r) {
      const auto t = rows(4000, 0.01);
      const auto u = several_sines(t, 1, {0.1 + 0.02 * r});
      auto y = noise(t.size(), noisy * white, 0, 20 + static_cast<std::uint64_t>(r));
      for (std::size_t k = 0; k < t.size(); ++k) y[k] += u[k] + added(t[k], u[k]);
      list.push_back(recording(std::to_string(r) + ".csv", r < 2 ? Role::train : Role::validate, t, u, std::move(y)));
    }
    return {compile(plain_gain(), registry_), std::make_shared<const DataSet>(data_set(std::move(list), white, 0))};
  }

 private:
  Registry registry_ = all_blocks();
};

TEST(EvidenceOfSeveralRecordings, NrmseIsAboutTheMeanOfAllOfThemAsInCompare) {
  // 10 mm off everywhere; one recording about half a meter, one about four.
  std::vector<Recording> list;
  double n = 0, sum = 0, squares = 0;
  for (const double level : {0.0, 0.0, 4.0}) {
    const auto t = rows(500, 0.01);
    auto u = several_sines(t, 1, {0.4});
    auto y = u;
    for (std::size_t k = 0; k < u.size(); ++k) y[k] = (u[k] += level) + 0.01;
    if (!list.empty())
      for (const double v : y) n += 1, sum += v, squares += v * v;
    list.push_back(
        recording(std::to_string(list.size()) + ".csv", list.empty() ? Role::train : Role::validate, t, u, y));
  }
  const Registry registry = all_blocks();
  DataModel model(compile(plain_gain(), registry), std::make_shared<const DataSet>(data_set(list, white, 0)));
  const Evidence evidence(model);
  const ModelError e = evidence.error(model.predict({}, evidence.recordings()));
  const double deviation = std::sqrt(squares / n - (sum / n) * (sum / n));
  EXPECT_NEAR(e.nrmse_validate, 0.01 / deviation, 1e-9);
  EXPECT_NEAR(by_output(e, Role::validate).front().nrmse, 0.01 / deviation, 1e-9);
  EXPECT_NEAR(e.recordings.back().nrmse, 0.01 / (std::sqrt(1.0 / 8)), 1e-4) << "of one alone about its own";
}

/// u -> 1 m/V -> y and u -> 1 m/(s V) -> s, which read 3 and 4 % more, without noise; one recording for each role.
class TwoUnits : public ::testing::Test {
 protected:
  static DataSet read() {
    std::vector<Recording> list;
    for (const Role role : {Role::train, Role::validate, Role::test}) {
      const auto t = rows(1000, 0.01);
      const auto u = several_sines(t, 1, {0.5});
      Recording r = recording(to_text(role) + ".csv", role, t, u, u);
      r.columns["s"] = u;
      r.units["s"] = parse_unit("mm/s");
      for (double& y : r.columns["y"]) y *= 1.03;
      for (double& s : r.columns["s"]) s *= 1.04;
      list.push_back(std::move(r));
    }
    DataSet d = data_set(std::move(list), white, 0);
    d.notes["s"] = d.notes["y"];
    d.notes["s"].to = "s";
    return d;
  }
  static Diagram stage_and_speed() {
    Diagram d = plain_gain();
    Node& speed = d.blocks["speed"];
    speed = d.blocks["stage"];
    speed.parameters["gain"] = Value("1 m/(s V)");
    d.outputs["s"] = "speed";
    return d;
  }
  const Registry registry_ = all_blocks();  // the program points to its blocks
  DataModel model_{compile(stage_and_speed(), registry_), std::make_shared<const DataSet>(read())};
  const Evidence evidence_{model_};
};

TEST_F(TwoUnits, HaveNoRmsInCommonButTheMeanSquareOfTheirShares) {
  const ModelError e = evidence_.error(model_.predict({}, evidence_.recordings()));
  EXPECT_FALSE(of_one_dimension(e.recordings));
  EXPECT_EQ(e.rms_validate, 0);
  // The sines' mean is half of their top: a share of the deviation is the share of the gain times sqrt(1 + 2), for
  // 0.5 (1 - cos) has the mean square 3/8 and the variance 1/8.
  const double larger = std::sqrt(3.0);
  EXPECT_NEAR(e.nrmse_validate, larger * std::sqrt((std::pow(0.03 / 1.03, 2) + std::pow(0.04 / 1.04, 2)) / 2), 1e-4);
  const auto outputs = by_output(e, Role::validate);
  ASSERT_EQ(outputs.size(), 2U);
  EXPECT_NEAR(outputs[1].rms, 0.04 * std::sqrt(3.0 / 8), 1e-4);
  EXPECT_EQ(outputs[1].unit.text, "mm/s");
  EXPECT_TRUE(by_output(e, Role::test).empty()) << "not read yet";
}

TEST_F(TwoUnits, OfTheTestRecordingsAreReadOnDemandOnly) {
  const std::vector<int> test = model_.recordings(Role::test);
  ModelError e = evidence_.error(model_.predict({}, evidence_.recordings()));
  EXPECT_FALSE(e.nrmse_test);
  evidence_.add_test(e, model_.predict({}, test));
  ASSERT_TRUE(e.nrmse_test);
  EXPECT_NEAR(*e.nrmse_test, e.nrmse_validate, 1e-12) << "the same rows";
  EXPECT_FALSE(e.rms_test);
  EXPECT_EQ(by_output(e, Role::test).size(), 2U);
  EXPECT_EQ(e.recordings.size(), 4U) << "what counts as evidence is as before";
}

TEST_F(EvidenceOf, TheBestLineOfASensorIsFoundOverAllRecordings) {
  DataModel model = measured([](double, double u) { return 0.03 * u - 0.2; }, 0);
  const Evidence evidence(model);
  const Prediction read = evidence.calibrated(model.predict({}, evidence.recordings()), 0);
  for (const int r : evidence.recordings())
    for (std::size_t k = 0; k < read.y[static_cast<std::size_t>(r)][0].size(); ++k)
      // Values are about one; the squares of a least-squares line round to 1e-12.
      ASSERT_NEAR(read.y[static_cast<std::size_t>(r)][0][k], model.measured(r, 0)[k], 1e-9);
}

}  // namespace
}  // namespace hysteron
