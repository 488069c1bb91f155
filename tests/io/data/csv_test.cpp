#include "io/data/csv.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <random>

#include "engine/diagram/error.h"
#include "tests/io/temporary_folder.h"

namespace hysteron {
namespace {

using Numbers = std::vector<double>;
using Lines = std::vector<int>;

CsvTable read_text(const std::string& text) {
  const TemporaryFolder folder;
  return read_csv(folder.write("x.csv", text));
}

TEST(Csv, ReadsNamesUnitsAndNumbersAsWritten) {
  const auto table = read_text("t [s],u [V],count\n0,1.5,3\n0.1,-2e-3,4\n");
  ASSERT_EQ(table.columns.size(), 3U);
  EXPECT_EQ(table.columns[0].name, "t");
  EXPECT_EQ(table.columns[1].unit.text, "V");
  EXPECT_TRUE(table.columns[2].unit.dimension.none());
  EXPECT_EQ(table.columns[1].values, (Numbers{1.5, -2e-3}));
  EXPECT_EQ(table.lines, (Lines{2, 3}));
}

TEST(Csv, SubnormalNumbersAreNumbers) {
  const auto table = read_text("t [s],y\n0,5e-324\n1,-1e-308\n2,1e-400\n");
  EXPECT_EQ(table.columns[1].values, (Numbers{std::numeric_limits<double>::denorm_min(), -1e-308, 0}));
}

TEST(Csv, ManyColumnsAreReadAndTheTwiceNamedOneIsFound) {
  std::string header = "t [s]", row = "0";
  for (int k = 0; k < 200'000; ++k) {
    header += ",c" + std::to_string(k);
    row += ",1";
  }
  EXPECT_EQ(read_text(header + "\n" + row + "\n").columns.size(), 200'001U);
  try {
    read_text(header + ",c199999\n" + row + ",1\n");
    ADD_FAILURE() << "taken";
  } catch (const Error& e) {
    EXPECT_EQ(e.problems[0].code, "duplicate_column");
    EXPECT_EQ(e.problems[0].path, "c199999");
  }
}

TEST(Csv, AnElementOfAVectorIsANameAndNoUnit) {
  const TemporaryFolder folder;
  const std::string file = folder.write("x.csv", "t [s],tilt[0],tilt[1] [urad],a [1]\n0,1,2,3\n");
  const CsvTable table = read_csv(file);
  ASSERT_EQ(table.columns.size(), 4U);
  EXPECT_EQ(table.columns[1].name, "tilt[0]");
  EXPECT_TRUE(table.columns[1].unit.dimension.none());
  EXPECT_EQ(table.columns[2].name, "tilt[1]");
  EXPECT_EQ(table.columns[2].unit.text, "urad");
  EXPECT_EQ(table.columns[3].name, "a");
  write_csv(folder.path("y.csv"), table);
  EXPECT_EQ(read_csv(folder.path("y.csv")).columns[1].name, "tilt[0]");
}

TEST(Csv, CommentsBlankLinesCarriageReturnsAndAByteOrderMarkDoNotMatter) {
  const auto table =
      read_text("\xEF\xBB\xBF# recorded in May\r\n\r\nt [s] , y [um]\r\n# first row\r\n 0 ,\t1\r\n\r\n1,2");
  EXPECT_EQ(table.columns[1].name, "y");
  EXPECT_EQ(table.columns[1].values, (Numbers{1, 2}));
  EXPECT_EQ(table.lines, (Lines{5, 7}));
}

TEST(Csv, QuotedCellsMayHoldCommasQuotesAndNewLines) {
  const auto table = read_text("\"t [s]\",\"force, \"\"left\"\" [N]\",\"two\nlines\"\n\"0\",\"1\",2\n");
  EXPECT_EQ(table.columns[1].name, "force, \"left\"");
  EXPECT_EQ(table.columns[1].unit.text, "N");
  EXPECT_EQ(table.columns[2].name, "two\nlines");
  EXPECT_EQ(table.lines, (Lines{3}));  // the header took two lines
}

TEST(Csv, NumbersMayCarryAPlusSignAndTinyOnesAreNotRefused) {
  const auto table = read_text("a\n+1.5\n1e-320\n1e-400\n");
  EXPECT_EQ(table.columns[0].values[0], 1.5);
  EXPECT_EQ(table.columns[0].values[1], 1e-320);
  EXPECT_EQ(table.columns[0].values[2], 0.0);
}

TEST(Csv, WhatIsWrittenIsReadBackToTheLastBit) {
  const TemporaryFolder folder;
  std::mt19937_64 random(7);
  CsvTable table;
  table.columns = {{"t", parse_unit("s"), {}}, {"force, \"x\"", parse_unit("N"), {}}, {"plain", {}, {}}};
  for (int row = 0; row < 500; ++row)
    for (auto& column : table.columns) {
      double value = 0;
      do {  // any bit pattern that is a finite number
        const std::uint64_t bits = random();
        std::memcpy(&value, &bits, sizeof value);
      } while (!std::isfinite(value));
      column.values.push_back(value);
    }
  write_csv(folder.path("x.csv"), table, {"made by a test"});
  const auto back = read_csv(folder.path("x.csv"));
  ASSERT_EQ(back.columns.size(), table.columns.size());
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    EXPECT_EQ(back.columns[i].name, table.columns[i].name);
    EXPECT_EQ(back.columns[i].unit.text, table.columns[i].unit.text);
    EXPECT_EQ(back.columns[i].values, table.columns[i].values);
  }
  EXPECT_TRUE(TemporaryFolder::read(folder.path("x.csv")).starts_with("# made by a test\n"));
}

TEST(Csv, AFileFullOfTextStopsAfterTwentyProblems) {
  std::string text = "t [s],y\n";
  for (int i = 0; i < 1000; ++i) text += "a,b\n";
  try {
    read_text(text);
    FAIL() << "text was taken for numbers";
  } catch (const Error& error) {
    EXPECT_GE(error.problems.size(), 20U);
    EXPECT_LE(error.problems.size(), 21U);  // the last row has two cells
  }
}

TEST(Csv, AFullDiskFailsAndLeavesNothing) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full here";
  CsvTable table;
  table.columns = {{"t", parse_unit("s"), {1, 2}}};
  try {
    write_csv("/dev/full", table);
    FAIL() << "a full disk went unnoticed";
  } catch (const Error& error) {
    EXPECT_EQ(error.problems.front().code, "cannot_write");
  }
}

}  // namespace
}  // namespace hysteron
