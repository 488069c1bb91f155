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

TEST(Csv, EachOfManyColumnsIsFoundByItsName) {
  CsvTable table;
  constexpr int many = 100'000;  // searched from the first each time, some minutes
  for (int k = 0; k < many; ++k) table.columns.push_back({"c" + std::to_string(k), {}, {}});
  for (int k = 0; k < many; ++k)
    ASSERT_EQ(table.find("c" + std::to_string(k)), &table.columns[static_cast<std::size_t>(k)]);
  EXPECT_EQ(table.find("d"), nullptr);
  table.columns[5].name = "d";  // after it was asked
  EXPECT_EQ(table.find("d"), &table.columns[5]);
  EXPECT_EQ(table.find("c5"), nullptr);
  table.columns.erase(table.columns.begin(), table.columns.begin() + 5);
  EXPECT_EQ(table.find("c6"), &table.columns[1]);
}

TEST(Csv, RowsOfEveryFormStandBesideEachOtherAndKeepTheirLines) {
  // Plain rows are read in one go, each other one field by field; the outcome must not tell which was which.
  const auto table = read_text(
      "a,b\n"        // 1
      "1,2\n"        // 2
      " 3 ,\t4 \n"   // 3
      "# 5,5\n"      // 4
      "\"5\",6\r\n"  // 5
      "\n"           // 6
      "+7,8\r\n"     // 7
      "9,10\r"       // 8: a line may end so, too
      "13,1e-400\n"  // 9
      "15,16");      // 10
  EXPECT_EQ(table.columns[0].values, (Numbers{1, 3, 5, 7, 9, 13, 15}));
  EXPECT_EQ(table.columns[1].values, (Numbers{2, 4, 6, 8, 10, 0, 16}));
  EXPECT_EQ(table.lines, (Lines{2, 3, 5, 7, 8, 9, 10}));
}

TEST(Csv, WhatIsWrongInAPlainRowIsToldWithItsLine) {
  for (const auto& [row, code] : {std::pair("1,2,3", "row_length"),
                                  {"1", "row_length"},
                                  {"1,", "bad_number"},
                                  {"1,2x", "bad_number"},
                                  {"1,inf", "bad_number"},
                                  {"nan,2", "bad_number"},
                                  {"1,1e999", "bad_number"},
                                  {"1;2", "row_length"},
                                  {"1,--2", "bad_number"}}) {
    try {
      read_text(std::string("a,b\n5,6\n") + row + "\n7,8\n");
      ADD_FAILURE() << row;
    } catch (const Error& e) {
      ASSERT_EQ(e.problems.size(), 1U) << row;
      EXPECT_EQ(e.problems[0].code, code) << row;
      EXPECT_EQ(e.problems[0].line, 3) << row;
    }
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
