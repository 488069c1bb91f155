#include "io/data/binary_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>

#include "engine/diagram/error.h"
#include "io/data/csv.h"
#include "io/data/table_file.h"
#include "tests/io/temporary_folder.h"

namespace hysteron {
namespace {

using nlohmann::json;
using Numbers = std::vector<double>;

constexpr std::size_t many = 3 * 64 * 64 + 17;  // two levels, the last row of each incomplete

/// Times, and noise in um.
CsvTable table_of(std::size_t rows) {
  std::mt19937 random(7);
  std::normal_distribution<double> noise;
  CsvTable table;
  table.columns = {{"t", parse_unit("s"), {}}, {"tilt[0]", parse_unit("um"), {}}, {"plain \"one\"", Unit{}, {}}};
  for (std::size_t i = 0; i < rows; ++i) {
    table.columns[0].values.push_back(1e-3 * static_cast<double>(i));
    table.columns[1].values.push_back(noise(random));
    table.columns[2].values.push_back(static_cast<double>(random()));
  }
  return table;
}

std::string code_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_FALSE(error.problems[0].cure.empty());
    return error.problems[0].code;
  }
  return "";
}

TEST(BinaryTable, GivesBackEveryBit) {
  const TemporaryFolder folder;
  CsvTable table = table_of(100);
  table.columns[1].values[3] = -0.0;
  table.columns[1].values[4] = std::numeric_limits<double>::denorm_min();
  table.columns[1].values[5] = std::numeric_limits<double>::max();
  write_binary_table(folder.path("x.f64"), table);
  const CsvTable read = read_table(folder.path("x.f64"));
  EXPECT_EQ(read.rows(), 100U);
  ASSERT_EQ(read.columns.size(), 3U);
  EXPECT_EQ(read.lines.back(), 100);
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_EQ(read.columns[c].name, table.columns[c].name);
    EXPECT_EQ(read.columns[c].unit.text, table.columns[c].unit.text);
    EXPECT_EQ(std::memcmp(read.columns[c].values.data(), table.columns[c].values.data(), 100 * sizeof(double)), 0);
  }
  EXPECT_EQ(folder.count(), 1U) << "nothing is left beside it";
}

TEST(BinaryTable, IsKnownByItsContentUnderAnyName) {
  const TemporaryFolder folder;
  write_binary_table(folder.path("x.f64"), table_of(3));
  std::filesystem::rename(folder.path("x.f64"), folder.path("x.data"));
  EXPECT_EQ(read_table(folder.path("x.data")).rows(), 3U);
  EXPECT_EQ(read_table(folder.write("y.csv", "t [s],y\n0,1\n")).rows(), 1U);
}

/// Numbers of the file from a byte on: what a program in another language does.
Numbers numbers_at(const std::string& bytes, std::size_t at, std::size_t count) {
  Numbers numbers(count);
  std::memcpy(numbers.data(), bytes.data() + at, count * sizeof(double));
  return numbers;
}

TEST(BinaryTable, ItsFirstLineSaysWhereEverythingLies) {
  const TemporaryFolder folder;
  const CsvTable table = table_of(many);
  write_binary_table(folder.path("x.f64"), table);
  const std::string bytes = TemporaryFolder::read(folder.path("x.f64"));
  const json head = json::parse(bytes.substr(0, bytes.find('\n')));
  EXPECT_EQ(head["hysteron_f64"], 1);
  EXPECT_EQ(head["rows"], many);
  EXPECT_EQ(head["bytes"], bytes.size());
  ASSERT_EQ(head["pyramid"].size(), 2U);
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    const json& column = head["columns"][c];
    const Numbers& values = table.columns[c].values;
    EXPECT_EQ(column["name"], table.columns[c].name);
    EXPECT_EQ(column["unit"], table.columns[c].unit.text);
    EXPECT_EQ(numbers_at(bytes, column["at"], many), values);
    std::size_t stride = 1;
    for (std::size_t level = 0; level < 2; ++level) {
      stride *= 64;
      EXPECT_EQ(head["pyramid"][level]["stride"], stride);
      Numbers low, high;
      for (std::size_t i = 0; i < many; i += stride) {
        const auto [least, most] =
            std::minmax_element(values.begin() + static_cast<std::ptrdiff_t>(i),
                                values.begin() + static_cast<std::ptrdiff_t>(std::min(i + stride, many)));
        low.push_back(*least);
        high.push_back(*most);
      }
      ASSERT_EQ(head["pyramid"][level]["rows"], low.size());
      EXPECT_EQ(numbers_at(bytes, column["low"][level], low.size()), low);
      EXPECT_EQ(numbers_at(bytes, column["high"][level], high.size()), high);
    }
  }
}

TEST(BinaryTable, TheEnvelopeOfAnyStretchIsThatOfItsRows) {
  const TemporaryFolder folder;
  const CsvTable table = table_of(many);
  const Numbers& values = table.columns[1].values;
  write_binary_table(folder.path("x.f64"), table);
  BinaryTable binary(folder.path("x.f64"));
  std::mt19937 random(3);
  for (int trial = 0; trial < 500; ++trial) {
    const std::size_t length = std::size_t{1} << random() % 14;
    const std::size_t first = random() % many, last = first + length, most = 1 + random() % 300;
    const Envelope e = binary.envelope(1, first, last, most);
    const std::size_t end = std::min(last, many);
    ASSERT_LE(e.first, first);
    ASSERT_GE(e.last, end);
    ASSERT_LE(e.last, many);
    ASSERT_LE(e.low.size(), most);
    ASSERT_EQ(e.low.size(), (e.last - e.first + e.stride - 1) / e.stride);
    // As fine as it may be: a stretch more than is needed for half of `most`, or rows one by one.
    EXPECT_TRUE(e.stride == 1 || 2 * e.low.size() + 2 >= std::min(most, end - first)) << length << " " << most;
    EXPECT_LE((first - e.first) + (e.last - end), 2 * 64 * ((end - first) / most / 64 + 1)) << length << " " << most;
    for (std::size_t k = 0; k < e.low.size(); ++k) {
      const auto begin = static_cast<std::ptrdiff_t>(e.first + k * e.stride);
      const auto behind = static_cast<std::ptrdiff_t>(std::min(e.first + (k + 1) * e.stride, e.last));
      ASSERT_EQ(e.low[k], *std::min_element(values.begin() + begin, values.begin() + behind));
      ASSERT_EQ(e.high[k], *std::max_element(values.begin() + begin, values.begin() + behind));
    }
  }
}

TEST(BinaryTable, GivesRowsInPart) {
  const TemporaryFolder folder;
  const CsvTable table = table_of(200);
  write_binary_table(folder.path("x.f64"), table);
  BinaryTable binary(folder.path("x.f64"));
  const Numbers& values = table.columns[2].values;
  EXPECT_EQ(binary.read(2, 100, 103), Numbers(values.begin() + 100, values.begin() + 103));
  EXPECT_EQ(binary.read(2, 198, 300), Numbers(values.begin() + 198, values.end()));
  EXPECT_TRUE(binary.read(2, 7, 7).empty());
  EXPECT_TRUE(binary.envelope(2, 300, 400, 10).low.empty());
}

TEST(BinaryTable, NanIsNoPartOfThePyramidAndIsRefusedAsInText) {
  const TemporaryFolder folder;
  CsvTable table = table_of(65);
  table.columns[1].values[64] = std::numeric_limits<double>::quiet_NaN();
  table.columns[1].values[0] = std::numeric_limits<double>::quiet_NaN();
  write_binary_table(folder.path("x.f64"), table);
  const Envelope e = BinaryTable(folder.path("x.f64")).envelope(1, 0, 65, 1);
  EXPECT_EQ(e.low, Numbers{*std::min_element(table.columns[1].values.begin() + 1, table.columns[1].values.end() - 1)});
  EXPECT_EQ(code_of([&] { read_table(folder.path("x.f64")); }), "bad_number");
}

TEST(BinaryTable, WhatIsCutOffOrChangedIsTold) {
  const TemporaryFolder folder;
  write_binary_table(folder.path("x.f64"), table_of(1000));
  const std::string good = TemporaryFolder::read(folder.path("x.f64"));
  const std::size_t head = good.find('\n');
  for (const std::size_t length : {std::size_t{0}, std::size_t{5}, head / 2, head, head + 1, good.size() - 1})
    EXPECT_EQ(code_of([&] { read_table(folder.write("y.f64", good.substr(0, length))); }), "damaged_file") << length;
  EXPECT_EQ(code_of([&] { read_table(folder.write("y.f64", good + "x")); }), "damaged_file");
  std::string changed = good;
  changed[head + 1 + 8 * 1500] ^= 1;  // the last bit of a number of the second column
  EXPECT_EQ(code_of([&] { read_table(folder.write("y.f64", changed)); }), "damaged_file");
  EXPECT_EQ(code_of([&] { read_table(folder.write("y.f64", "t [s],y\n0,1\n")); }), "damaged_file");
  changed = good;
  changed.replace(changed.find(":1,"), 3, ":9,");
  EXPECT_EQ(code_of([&] { read_table(folder.write("y.f64", changed)); }), "newer_format");
  EXPECT_EQ(code_of([&] { read_table(folder.path("none.f64")); }), "no_file");
}

TEST(BinaryTable, ColumnsOfDifferentLengthsAreNotWritten) {
  const TemporaryFolder folder;
  CsvTable table = table_of(10);
  table.columns[2].values.pop_back();
  EXPECT_EQ(code_of([&] { write_binary_table(folder.path("x.f64"), table); }), "row_length");
  EXPECT_EQ(folder.count(), 0U);
}

}  // namespace
}  // namespace hysteron
