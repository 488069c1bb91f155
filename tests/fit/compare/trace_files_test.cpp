// Comparing traces: numbers that follow by hand, and what is refused.
#include "fit/compare/trace_files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/diagram/error.h"

namespace hysteron {
namespace {

constexpr double rounding = 1e-12;  // a few roundings of numbers near 1

CsvTable table(const std::string& file, const std::vector<std::pair<std::string, std::vector<double>>>& columns) {
  CsvTable t;
  t.file = file;
  for (const auto& [head, values] : columns) {
    const auto bracket = head.find(" [");
    CsvColumn column;
    column.name = head.substr(0, bracket);
    column.unit = parse_unit(bracket == std::string::npos ? "" : head.substr(bracket + 2, head.size() - bracket - 3));
    column.values = values;
    t.columns.push_back(column);
  }
  return t;
}

TraceComparison compared(const CsvTable& a, const CsvTable& b, const std::vector<std::string>& tolerances = {},
                         const std::string& over = "") {
  TraceWishes wishes;
  wishes.over = over;
  for (const auto& written : tolerances) wishes.tolerances.push_back(read_trace_tolerance(written));
  return compare_trace_files(a, b, wishes);
}

std::string code_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_FALSE(error.problems.front().cure.empty());
    return error.problems.front().code;
  }
  return "";
}

TEST(TraceDistance, IsTakenOnTheStraightLineBetweenPointsAndInTheCommonRangeOnly) {
  // y = t against y = t + 0.5 t (t = 0 .. 4): at t = 1.5 the second is 2.25.
  const TraceLine few{{-1, 1.5, 9}, {0, 1.5, 0}}, many{{0, 1, 2, 4}, {0, 1.5, 3, 6}};
  const TraceDistance d = distance_of(few, many, TraceCourse::rising, {});
  ASSERT_EQ(d.x.size(), 1U);
  EXPECT_EQ(d.left_out, 2U);
  EXPECT_TRUE(d.points_of_first);
  EXPECT_NEAR(d.second[0] - d.first[0], 0.75, rounding);
  EXPECT_NEAR(d.largest, 0.75, rounding);
}

TEST(TraceDistance, APointBetweenTwoRowsIsReadOnTheLineThatHasNoneInItsRange) {
  const TraceLine point{{0.5}, {2}}, rows{{0, 1, 2}, {0, 3, 6}};
  for (const bool point_first : {true, false}) {
    const TraceDistance d =
        distance_of(point_first ? point : rows, point_first ? rows : point, TraceCourse::rising, {});
    ASSERT_EQ(d.x.size(), 1U);
    EXPECT_EQ(d.points_of_first, point_first);
    EXPECT_NEAR(d.largest, 0.5, rounding);
  }
}

TEST(TraceDistance, AbsoluteAndRelativePartAddUpOnTheFirstCurve) {
  const TraceLine first{{0, 1, 2}, {10, -10, 0}}, second{{0, 1, 2}, {11, -11, 1}};
  // Allowed: 0.5 + 0.05 * |10| = 1 at the first two, 0.5 where the first curve is zero.
  const TraceDistance d = distance_of(first, second, TraceCourse::rising, {0.5, 0.05 + 1e-9, 0});
  EXPECT_EQ(d.outside, 1U);
  EXPECT_EQ(d.worst_at, 2U);
  EXPECT_NEAR(d.beyond[2], 0.5, rounding);
}

TEST(TraceDistance, ATimeToleranceForgivesALateEdgeAndNoHigherOne) {
  const TraceLine wanted{{0, 0.9999, 1, 2}, {0, 0, 1, 1}};  // a step at 1
  TraceLine late{{0, 1.0499, 1.05, 1.5, 2}, {0, 0, 1, 1, 1}};
  EXPECT_GT(distance_of(wanted, late, TraceCourse::rising, {0.01, 0, 0}).outside, 0U);
  EXPECT_EQ(distance_of(wanted, late, TraceCourse::rising, {0.01, 0, 0.06}).outside, 0U);
  EXPECT_GT(distance_of(wanted, late, TraceCourse::rising, {0.01, 0, 0.04}).outside, 0U);
  for (double& y : late.y) y *= 1.05;
  EXPECT_GT(distance_of(wanted, late, TraceCourse::rising, {0.01, 0, 0.06}).outside, 0U);
}

TEST(TraceDistance, AnInstantThatBothHaveCountsExactlyDespiteTenDigits) {
  // The second jumps at 1/3, which the first file wrote with ten digits: the line between would give 0.5.
  const TraceLine first{{0, 0.3333333333, 1}, {0, 1, 1}}, second{{0, 1.0 / 3 - 1e-10, 1.0 / 3, 1}, {0, 0, 1, 1}};
  EXPECT_EQ(distance_of(first, second, TraceCourse::rising, {1e-12, 0, 0}).outside, 0U);
}

TEST(TraceDistance, AJumpWrittenAsTwoPointsHoldsAllValuesBetween) {
  const TraceLine points{{0.5, 1}, {0, 0.4}}, jump{{0, 1, 1, 2}, {0, 0, 1, 1}};
  EXPECT_GT(distance_of(points, jump, TraceCourse::rising, {0.01, 0, 0}).outside,
            0U);  // instants count exactly: 0 or 1
  EXPECT_EQ(distance_of(points, jump, TraceCourse::rising, {0.01, 0, 1e-6}).outside, 0U);
}

TEST(TraceDistance, OnALoopTheNearestBranchCounts) {
  TraceLine loop;
  for (int i = 0; i <= 2000; ++i) {  // an ellipse of height 0.5 around y = x
    const double angle = 2 * std::numbers::pi * i / 2000;
    loop.x.push_back(std::cos(angle));
    loop.y.push_back(std::cos(angle) + 0.5 * std::sin(angle));
  }
  const TraceLine points{{0, 0, 0.6, 0, 1.4}, {0.5, -0.5, 1.0, 0.1, 0}};  // three on it, one inside, one beyond its end
  const TraceDistance d = distance_of(points, loop, TraceCourse::to_and_fro, {0.001, 0, 0});
  EXPECT_EQ(d.x.size(), 4U);
  EXPECT_EQ(d.left_out, 1U);
  EXPECT_EQ(d.outside, 1U);
  EXPECT_EQ(d.worst_at, 3U);
  EXPECT_NEAR(d.largest, 0.4, 1e-5);  // chords of 2000: the sagitta is 2.5e-6
}

TEST(TraceDistance, ALoopOfManyRowsGivesTheSameAsOneOfFew) {
  // The same square, its sides once straight and once in 50 000 pieces: bins along x must not lose any of them.
  const TraceLine few{{0, 1, 1, 0, 0}, {0, 0, 1, 1, 0}};
  TraceLine many;
  for (std::size_t side = 0; side < 4; ++side)
    for (int i = 0; i < 50000; ++i) {
      const double part = i / 50000.0;
      many.x.push_back(few.x[side] + part * (few.x[side + 1] - few.x[side]));
      many.y.push_back(few.y[side] + part * (few.y[side + 1] - few.y[side]));
    }
  const TraceLine points{{0, 0.3, 1, 0.999}, {0.5, 0.2, 1.5, 0.5}};  // the last one is beside a side that is upright
  for (const double along : {0.0, 0.01}) {
    const TraceTolerance tolerance{0.05, 0, along};
    const TraceDistance a = distance_of(points, few, TraceCourse::to_and_fro, tolerance);
    const TraceDistance b = distance_of(points, many, TraceCourse::to_and_fro, tolerance);
    EXPECT_EQ(a.outside, along > 0 ? 2U : 3U);
    ASSERT_EQ(a.x, b.x);
    for (std::size_t i = 0; i < a.x.size(); ++i) EXPECT_NEAR(a.beyond[i], b.beyond[i], 1e-9) << i;
  }
}

TEST(TraceFiles, UnitsAreConvertedAndRowsPutInOrder) {
  const CsvTable digitized = table("figure.csv", {{"t [ms]", {200, 0, 100}}, {"y [nm]", {2000, 0, 1000}}});
  const CsvTable simulated = table("run.csv", {{"t [s]", {0, 0.1, 0.2, 0.3}}, {"y [um]", {0, 1, 2.002, 3}}});
  const TraceComparison c = compared(digitized, simulated, {"1 nm + 0.1 %"});
  ASSERT_EQ(c.pairs.size(), 1U);
  EXPECT_TRUE(c.within());  // 2 nm at 2000 nm: 1 + 2 allowed
  EXPECT_NEAR(c.pairs[0].distance.largest, 2e-9, 1e-18);
  EXPECT_EQ(c.remarks.size(), 1U);
  EXPECT_FALSE(compared(digitized, simulated, {"1.9 nm"}).within());
}

TEST(TraceFiles, ANamedToleranceGoesBeforeOneForAll) {
  const CsvTable a = table("a.csv", {{"t [s]", {0, 1}}, {"y [um]", {0, 1}}, {"u [V]", {0, 1}}});
  const CsvTable b = table("b.csv", {{"t [s]", {0, 1}}, {"y [um]", {0, 1.5}}, {"u [V]", {0, 1.5}}});
  EXPECT_FALSE(compared(a, b, {"y: 1 um", "10 %"}).within());  // u is outside 10 %
  EXPECT_TRUE(compared(a, b, {"y: 1 um", "60 %", "0.1 V"}).pairs[0].distance.outside == 0);
  EXPECT_TRUE(compared(a, b, {"u: 1 V", "y: 1 um", "10 %"}).within());
  EXPECT_FALSE(compared(a, b, {"1 um"}).pairs[1].written.has_value());  // a tolerance in um says nothing of u
}

TEST(TraceFiles, NamedPairsAloneAreCompared) {
  const CsvTable a = table("a.csv", {{"t [s]", {0, 1}}, {"y [um]", {0, 1}}, {"u [V]", {0, 1}}});
  const CsvTable b = table("b.csv", {{"t [s]", {0, 1}}, {"stage [nm]", {0, 1500}}, {"u [V]", {0, 1}}});
  TraceWishes wishes;
  wishes.pairs = {{"y", "stage"}};
  const TraceComparison c = compare_trace_files(a, b, wishes);
  ASSERT_EQ(c.pairs.size(), 1U);
  EXPECT_NEAR(c.pairs[0].distance.largest, 0.5e-6, 1e-18);
  EXPECT_TRUE(c.remarks.empty());
}

TEST(TraceFiles, WhatCannotBeComparedIsSaidWithACure) {
  const CsvTable a = table("a.csv", {{"t [s]", {0, 1}}, {"y [um]", {0, 1}}});
  const CsvTable bare = table("b.csv", {{"t [s]", {0, 1}}, {"y", {0, 1}}});
  const CsvTable later = table("b.csv", {{"t [s]", {2, 3}}, {"y [um]", {0, 1}}});
  const CsvTable other = table("b.csv", {{"t [s]", {0, 1}}, {"stage [um]", {0, 1}}});
  const CsvTable loop = table("b.csv", {{"u [V]", {0, 1}}, {"y [um]", {0, 1}}});
  EXPECT_EQ(code_of([&] { compared(a, bare); }), "wrong_unit");
  EXPECT_EQ(code_of([&] { compared(a, later); }), "no_overlap");
  EXPECT_EQ(code_of([&] { compared(a, other); }), "nothing_to_compare");
  EXPECT_EQ(code_of([&] { compared(a, loop); }), "missing_column");
  EXPECT_EQ(code_of([&] { compared(a, a, {"z: 1 um"}); }), "unknown_signal");
  EXPECT_EQ(code_of([&] { compared(a, a, {"1 V"}); }), "wrong_unit");
  EXPECT_EQ(code_of([&] { compared(a, a, {"y: 1 um, 2 V"}); }), "wrong_unit");
}

TEST(TraceTolerance, ThatAllowsEverythingOrSaysTwoThingsIsRefused) {
  EXPECT_EQ(code_of([] { read_trace_tolerance("inf nm"); }), "bad_command_line");
  EXPECT_EQ(code_of([] { read_trace_tolerance("1 nm, inf s"); }), "bad_command_line");
  const auto a = table("a.csv", {{"t [s]", {0, 1}}, {"y [um]", {0, 1}}});
  EXPECT_EQ(code_of([&] { compared(a, a, {"y: 1 nm", "y: 2 nm"}); }), "bad_command_line");
}

TEST(TraceTolerance, IsReadInAllItsForms) {
  const WrittenTolerance full = read_trace_tolerance("stage.y: 1e+3 nm + 0.1 %, 0.1 ms");
  EXPECT_EQ(full.signal, "stage.y");
  EXPECT_NEAR(full.unit.difference_to_si(*full.absolute), 1e-6, 1e-18);
  EXPECT_NEAR(*full.relative, 1e-3, 1e-15);
  EXPECT_NEAR(full.along_unit.difference_to_si(*full.along), 1e-4, 1e-16);
  EXPECT_FALSE(read_trace_tolerance("5 %").absolute.has_value());
  EXPECT_FALSE(read_trace_tolerance("y: , 1 ms").relative.has_value());
  for (const char* wrong :
       {"", "y:", ": 1 nm", "1 nm + 2 nm", "1 % + 2 %", "-1 nm", "1 nm +", "some", "1 nm, 1 s, 2 s"})
    EXPECT_EQ(code_of([&] { read_trace_tolerance(wrong); }), "bad_command_line") << wrong;
}

}  // namespace
}  // namespace hysteron
