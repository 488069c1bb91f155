// Which part of long recordings a search looks at, and what is told of all rows.
#include "discover/selection/first_part.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "discover/selection/discover.h"
#include "tests/discover/discoveries.h"
#include "tests/discover/synthetic.h"

namespace hysteron {
namespace {

using namespace testing;

Recording moved(const std::string& name, Role role, int n, double end_rises_by = 0) {
  const auto t = rows(n, 0.01);
  auto u = sampled(t, [&](double x) { return std::sin(x) + end_rises_by * x / t.back(); });
  return recording(name, role, t, u, u);
}

TEST(FirstPart, ShortRecordingsAreSearchedInWhole) {
  EXPECT_FALSE(first_part(data_set({moved("a", Role::train, 3999)}, 0), 1000));
  EXPECT_TRUE(first_part(data_set({moved("a", Role::train, 4000)}, 0), 1000));
  // One that is short keeps all rows of the others: they are a quarter of the whole at least.
  EXPECT_FALSE(first_part(data_set({moved("a", Role::train, 4000), moved("b", Role::validate, 900)}, 0), 1000));
}

TEST(FirstPart, ThePartHasTheFirstRowsOfEachAndWhatIsSaidOfThem) {
  DataSet data =
      data_set({moved("a", Role::train, 5000), moved("t", Role::test, 5000), moved("b", Role::validate, 9000)}, 0);
  data.recordings[0].first = 100;
  data.recordings[0].left_out.assign(5000, false);
  data.recordings[0].left_out[150] = true;
  data.recordings[2].initial_values["x"] = 3;
  const auto part = first_part(data, 1000);
  ASSERT_TRUE(part);
  ASSERT_EQ(part->recordings.size(), 3u);
  const auto& a = part->recordings[0];
  EXPECT_EQ(a.t.size(), 1100u);
  EXPECT_EQ(a.columns.at("u").size(), 1100u);
  EXPECT_EQ(a.first, 100u);
  EXPECT_EQ(a.last, 1100u);
  EXPECT_EQ(a.count_judged(), 999u);
  EXPECT_EQ(part->recordings[1].t.size(), 5000u);  // read once, at the end
  EXPECT_EQ(part->recordings[2].last, 1000u);
  EXPECT_EQ(part->recordings[2].initial_values.at("x"), 3);
}

TEST(FirstPart, EveryColumnGoesThroughMostOfItsRange) {
  // sin(x) + r x/T: of a range of 2 + r the first rows have 2 + r times their share.
  const auto rows_with = [](double rise) {
    const auto part = first_part(data_set({moved("a", Role::train, 16000, rise)}, 0), 1000);
    return part ? part->recordings[0].last : 0;
  };
  EXPECT_EQ(rows_with(0), 1000u);
  EXPECT_EQ(rows_with(0.9), 4000u);  // all 2.86; 2000 rows 2.05, 4000 rows 2.19 (at x = 12.5 pi), more than 3/4 of that
  EXPECT_EQ(rows_with(5), 0u);       // a quarter of the rows has 3.25 of 7
}

TEST(FirstPart, WhatIsCutInTimeIsCutByTheSameShares) {
  DataSet data = data_set({moved("a", Role::train, 100000)}, 0);
  data.single = true;
  cut_in_time(data, 0);
  const auto part = first_part(data, 1000);
  ASSERT_TRUE(part);
  EXPECT_EQ(part->recordings[0].first, 0u);
  EXPECT_EQ(part->recordings[0].last, 1200u);  // 60 % of two times 1000
  EXPECT_EQ(part->recordings[1].first, 1200u);
  EXPECT_EQ(part->recordings[1].last, 2000u);
  EXPECT_EQ(part->recordings[1].t.size(), 2000u);
}

class PartOfLongRecordings : public Discoveries {
 protected:
  static constexpr int n = 4 * static_cast<int>(rows_that_tell) + 1000;
  static constexpr double white = 0.01;
  /// A gain that saturates; `jump`: of the zero, after half the time.
  Discovery selected(double jump) {
    std::vector<Recording> list;
    for (int r = 0; r < 2; ++r) {
      const auto t = rows(n, 1e-3);
      const auto u = several_sines(t, 1, {0.31 + 0.1 * r, 1.7, 3.9});
      auto y = noise(t.size(), white, 0, 5 + static_cast<std::uint64_t>(r));
      for (std::size_t k = 0; k < t.size(); ++k) y[k] += std::min(u[k], 0.8) + (2 * k > t.size() ? jump : 0);
      list.push_back(recording(std::to_string(r) + ".csv", r == 0 ? Role::train : Role::validate, t, u, std::move(y)));
    }
    DiscoverOptions options;
    options.only = {"saturation", "calibration"};
    return discover(plain_gain(), data_set(std::move(list), white, 0), registry, effects, options);
  }
  static bool is_told(const Discovery& d, const std::string& words) {
    return std::any_of(d.warnings.begin(), d.warnings.end(),
                       [&](const std::string& w) { return w.find(words) != w.npos; });
  }
};

TEST_F(PartOfLongRecordings, WhatIsFoundInTheFirstPartIsFittedToAllRowsAndJudgedInThem) {
  const Discovery d = selected(0);
  EXPECT_EQ(d.verdict, Verdict::missing_effect) << tried(d);
  ASSERT_EQ(d.steps.size(), 1u) << tried(d);
  EXPECT_EQ(winner(d), "saturation") << tried(d);
  EXPECT_TRUE(is_told(d, "searched for in the first 20000 rows of 0.csv, 20000 rows of 1.csv"));
  ASSERT_EQ(d.final_error.recordings.size(), 2u);
  for (const auto& r : d.final_error.recordings) EXPECT_EQ(r.rows, static_cast<std::size_t>(n));
  // Of the mean square of 81 000 values of white noise one standard deviation is 0.5 %, of the rms a quarter of one.
  EXPECT_NEAR(d.final_error.rms_validate, white, 0.01 * white);
  EXPECT_EQ(d.final_prediction.y[1].front().size(), static_cast<std::size_t>(n));
}

TEST_F(PartOfLongRecordings, WhatActsLaterIsSearchedForInAllRows) {
  const Discovery d = selected(5 * white);
  EXPECT_TRUE(is_told(d, "do not show all that acts")) << tried(d);
  EXPECT_EQ(d.remainder, Remainder::structured);
}

}  // namespace
}  // namespace hysteron
