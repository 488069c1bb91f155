// Loops, phase planes and the closer look of reports, on tables whose answers are known by construction.
#include "report/pages/loops.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace hysteron {
namespace {

constexpr std::size_t rows = 1200;  // twelve parts of a hundred

CsvTable table_of(const std::vector<std::pair<std::string, std::string>>& columns) {
  CsvTable table;
  table.file = "01.csv";
  for (const auto& [name, unit] : columns) table.columns.push_back({name, parse_unit(unit), std::vector<double>(rows)});
  for (std::size_t i = 0; i < rows; ++i) table.columns[0].values[i] = 0.01 * static_cast<double>(i);
  return table;
}

std::vector<double>& values(CsvTable& table, const std::string& name) {
  for (auto& column : table.columns)
    if (column.name == name) return column.values;
  throw std::runtime_error("no column " + name);
}

const Plotted u{"u", "u", "u"}, y{"y", "y_measured", "y_simulated"};

CsvTable recording() {
  CsvTable table =
      table_of({{"t", "s"}, {"u", "V"}, {"y_measured", "um"}, {"y_simulated", "um"}, {"y_residual", "um"}});
  for (std::size_t i = 0; i < rows; ++i)
    values(table, "u")[i] = std::sin(2 * std::numbers::pi * static_cast<double>(i) / 400);
  return table;
}

TEST(Loop, HoldsMeasuredAndSimulatedOverTheInputColouredByTime) {
  const Figure figure = loop_figure(recording(), u, y);
  ASSERT_EQ(figure.curves.size(), 2U);
  EXPECT_EQ(figure.x_label, "u [V]");
  EXPECT_EQ(figure.y_label, "y [um]");
  for (const auto& curve : figure.curves) {
    EXPECT_EQ(curve.x_column, "u");
    EXPECT_EQ(curve.colour, "time");
  }
  EXPECT_EQ(figure.curves[0].role, "measured");
  EXPECT_EQ(figure.curves[1].y_column, "y_simulated");
}

TEST(Loop, IsNotDrawnWhereTheInputNeverTurns) {
  CsvTable table = recording();
  for (std::size_t i = 0; i < rows; ++i) values(table, "u")[i] = static_cast<double>(i);  // a ramp
  EXPECT_TRUE(loop_figure(table, u, y).curves.empty());
  EXPECT_TRUE(loop_figure(recording(), u, {"z", "z_measured", "z_simulated"}).curves.empty());  // not measured
}

TEST(CloserLook, ShowsTheTwelfthOfTheTimeInWhichTheErrorIsLargest) {
  CsvTable table = recording();
  for (std::size_t i = 0; i < rows; ++i) values(table, "y_residual")[i] = i == 10 ? 3 : i >= 720 && i < 820 ? 1 : 0.1;
  // 100 rows of 1 are more than a single 3 (9 + 99 * 0.01): the part is 7.2 s to 8.2 s, give or take a row.
  const Figure figure = closest_look(table, y, "y_residual");
  ASSERT_EQ(figure.x_range.size(), 2U);
  EXPECT_NEAR(figure.x_range[0], 7.2, 0.011);
  EXPECT_NEAR(figure.x_range[1], 8.2, 0.011);
  EXPECT_EQ(figure.curves.size(), 2U);
}

TEST(CloserLook, PassesOverGapsAndShortRecordings) {
  CsvTable table = recording();
  for (auto& value : values(table, "y_residual")) value = 0.1;
  values(table, "y_residual")[50] = std::nan("");
  for (std::size_t i = 600; i < 700; ++i) values(table, "y_residual")[i] = 1;
  EXPECT_NEAR(closest_look(table, y, "y_residual").x_range.at(0), 6, 0.011);
  for (auto& column : table.columns) column.values.resize(20);
  EXPECT_TRUE(closest_look(table, y, "y_residual").curves.empty());
}

TEST(PhasePlane, IsForceOverEachVelocityAndDisplacement) {
  const CsvTable table = table_of({{"t", "s"}, {"F", "N"}, {"v", "mm/s"}, {"x", "mm"}, {"T", "K"}});
  std::vector<Plotted> signals;
  for (const char* name : {"F", "v", "x", "T"}) signals.push_back({name, name, name});
  const auto figures = phase_planes(table, signals);
  ASSERT_EQ(figures.size(), 2U);
  EXPECT_EQ(figures[0].x_label, "v [mm/s]");
  EXPECT_EQ(figures[0].y_label, "F [N]");
  EXPECT_EQ(figures[1].x_label, "x [mm]");
  EXPECT_EQ(figures[0].curves.size(), 1U);  // simulated alone
}

TEST(PhasePlane, NeedsAVelocity) {
  const CsvTable table = table_of({{"t", "s"}, {"M", "N m"}, {"phi", "deg"}});
  EXPECT_TRUE(phase_planes(table, {{"M", "M", "M"}, {"phi", "phi", "phi"}}).empty());
}

TEST(PhasePlane, OfARotationTakesTorqueAndSpeed) {
  const CsvTable table = table_of({{"t", "s"}, {"M", "mN m"}, {"w_measured", "rpm"}, {"w_simulated", "rpm"}});
  const auto figures = phase_planes(table, {{"M", "M", "M"}, {"w", "w_measured", "w_simulated"}});
  ASSERT_EQ(figures.size(), 1U);
  EXPECT_EQ(figures[0].curves.size(), 2U);  // over the measured and over the simulated speed
  EXPECT_EQ(figures[0].curves[0].x_column, "w_measured");
}

}  // namespace
}  // namespace hysteron
