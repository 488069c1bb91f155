// Files of columns: what is written is read, the same bytes each time, whole or not at all.
#include "io/data/column_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <thread>

#include "engine/diagram/error.h"
#include "io/files/sealed_file.h"
#include "tests/io/small_disk.h"
#include "tests/io/temporary_folder.h"

namespace hysteron {
namespace {

const std::vector<ColumnHead> heads{
    {"draw", "", "number of the draw", true}, {"stage/controller.kp", "V/um", "a parameter"}, {"stroke", "um", ""}};

std::vector<double> row(int i) {
  return {static_cast<double>(i) * 1e12, 0.1 * i, i == 7 ? std::numeric_limits<double>::quiet_NaN() : -1e-300 * i};
}

void write(const std::string& file, int rows, bool sealed = false) {
  ColumnWriter writer(file, heads);
  for (int i = 0; i < rows; ++i) writer.append(row(i));
  writer.finish({{"job", "a1b2"},
                 {"remark", ""},
                 {"draws", std::int64_t{1} << 60},
                 {"passed", std::vector<std::int64_t>{3, -4, 5}},
                 {"none", std::vector<std::int64_t>{}}},
                sealed);
}

/// All numbers of a column; throws what the reader throws.
std::vector<double> column(const std::string& file, std::size_t which) {
  const ColumnReader reader(file);
  std::vector<double> values(reader.rows());
  reader.read(which, 0, values);
  return values;
}

std::string problem(const std::string& file) {
  try {
    const ColumnReader reader(file);
  } catch (const Error& error) {
    EXPECT_FALSE(error.problems.front().cure.empty());
    return error.problems.front().code;
  }
  return "";
}

TEST(ColumnFile, RowsUnitsMeaningsAndFactsComeBack) {
  const TemporaryFolder folder;
  const std::string file = folder.path() + "/a.h5";
  constexpr int rows = 2500;  // two full pieces and a part
  write(file, rows);
  const ColumnReader reader(file);
  ASSERT_EQ(reader.columns().size(), 3U);
  EXPECT_EQ(reader.rows(), 2500U);
  EXPECT_EQ(reader.columns()[1].name, "stage/controller.kp");
  EXPECT_EQ(reader.columns()[1].unit, "V/um");
  EXPECT_EQ(reader.columns()[1].meaning, "a parameter");
  EXPECT_EQ(reader.columns()[0].unit, "");
  EXPECT_EQ(reader.text("job"), "a1b2");
  EXPECT_EQ(reader.text("remark", "x"), "");
  EXPECT_EQ(reader.text("nothing", "x"), "x");
  EXPECT_EQ(reader.text("draws", "x"), "x");
  EXPECT_EQ(reader.whole("draws"), std::int64_t{1} << 60);
  EXPECT_EQ(reader.whole("job", -1), -1);
  EXPECT_EQ(reader.list("passed"), (std::vector<std::int64_t>{3, -4, 5}));
  EXPECT_TRUE(reader.list("none").empty());
  for (std::size_t c = 0; c < 3; ++c) {
    std::vector<double> values(1500);
    reader.read(c, 1000, values);
    for (int i = 0; i < 1500; ++i) EXPECT_EQ(values[static_cast<std::size_t>(i)], row(1000 + i)[c]);
  }
  std::vector<double> one(1);
  reader.read(2, 7, one);
  EXPECT_NE(one[0], one[0]);
}

TEST(ColumnFile, TheSameContentGivesTheSameBytes) {
  const TemporaryFolder folder;
  write(folder.path() + "/a.h5", 1500);
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // a time stamp would be another one
  write(folder.path() + "/b.h5", 1500);
  EXPECT_TRUE(TemporaryFolder::read(folder.path() + "/a.h5") == TemporaryFolder::read(folder.path() + "/b.h5"));
}

TEST(ColumnFile, AFileWithoutRowsIsAFile) {
  const TemporaryFolder folder;
  write(folder.path() + "/a.h5", 0);
  EXPECT_EQ(ColumnReader(folder.path() + "/a.h5").rows(), 0U);
}

TEST(ColumnFile, WhatIsNotFinishedLeavesNothing) {
  const TemporaryFolder folder;
  {
    ColumnWriter writer(folder.path() + "/a.h5", heads);
    for (int i = 0; i < 3000; ++i) writer.append(row(i));
    EXPECT_FALSE(std::filesystem::exists(folder.path() + "/a.h5"));
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(ColumnFile, SeveralAreWrittenAtOnce) {
  const TemporaryFolder folder;
  const auto name = [&](int i) { return folder.path() + "/" + std::to_string(i) + ".h5"; };
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) threads.emplace_back([&, i] { write(name(i), 5000); });
  for (auto& thread : threads) thread.join();
  for (int i = 1; i < 4; ++i) EXPECT_TRUE(TemporaryFolder::read(name(i)) == TemporaryFolder::read(name(0)));
}

TEST(ColumnFile, ANumberThatChangedOnTheDiskIsRefused) {
  const TemporaryFolder folder;
  const std::string file = folder.path() + "/a.h5";
  write(file, 1500);
  std::string bytes = TemporaryFolder::read(file);
  const double number = row(700)[1];
  const auto at = bytes.find(std::string(reinterpret_cast<const char*>(&number), sizeof number));
  ASSERT_NE(at, std::string::npos);
  bytes[at + 6] = static_cast<char>(bytes[at + 6] ^ 0x10);
  folder.write("a.h5", bytes);
  EXPECT_EQ(column(file, 0).size(), 1500U);
  try {
    column(file, 1);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.problems.front().code, "damaged_file");
  }
}

TEST(ColumnFile, ASealedOneIsReadAsOneWithoutSeal) {
  const TemporaryFolder folder;
  write(folder.path() + "/a.h5", 1500, true);
  write(folder.path() + "/b.h5", 1500);
  EXPECT_EQ(seal_of(folder.path() + "/a.h5"), Seal::whole);
  EXPECT_EQ(seal_of(folder.path() + "/b.h5"), Seal::none);
  EXPECT_EQ(column(folder.path() + "/a.h5", 1), column(folder.path() + "/b.h5", 1));
  EXPECT_TRUE(
      TemporaryFolder::read(folder.path() + "/a.h5").starts_with(TemporaryFolder::read(folder.path() + "/b.h5")));
}

TEST(ColumnFile, AFullDiskIsToldAndTheNextFileCanBeWritten) {
  const TemporaryFolder folder;
  for (const rlim_t size : {100, 4000, 20000, 50000}) {
    const SmallDisk disk(size);
    try {
      write(folder.path() + "/a.h5", 3000);
      ADD_FAILURE() << size;
    } catch (const Error& error) {
      EXPECT_EQ(error.problems.front().code, "cannot_write");
    }
    EXPECT_TRUE(std::filesystem::is_empty(folder.path())) << size;
  }
  write(folder.path() + "/a.h5", 3000);
  EXPECT_EQ(column(folder.path() + "/a.h5", 1).back(), row(2999)[1]);
}

TEST(ColumnFile, WhatIsNoFileOfColumnsIsTold) {
  const TemporaryFolder folder;
  EXPECT_EQ(problem(folder.path() + "/none.h5"), "no_file");
  EXPECT_EQ(problem(folder.path()), "is_directory");
  EXPECT_EQ(problem(folder.write("text.h5", "draw,stroke\n1,2\n")), "damaged_file");
  write(folder.path() + "/a.h5", 3000);
  const std::string whole = TemporaryFolder::read(folder.path() + "/a.h5");
  EXPECT_EQ(problem(folder.write("half.h5", whole.substr(0, whole.size() / 2))), "damaged_file");
  try {
    ColumnWriter writer(folder.path() + "/no/folder/a.h5", heads);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.problems.front().code, "cannot_write");
  }
}

}  // namespace
}  // namespace hysteron
