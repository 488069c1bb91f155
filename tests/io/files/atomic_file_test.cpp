#include "io/files/atomic_file.h"

#include <sys/stat.h>

#include "engine/diagram/error.h"
#include "engine/diagram/stop.h"
#include "tests/io/temporary_folder.h"

namespace hysteron {
namespace {

std::string code_of(const auto& action) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(error.fault, Fault::input);
    for (const auto& p : error.problems) EXPECT_FALSE(p.cure.empty()) << p.code;
    return error.problems.front().code;
  }
  return "none";
}

TEST(AtomicFile, WhatWasWrittenIsReadBackByteByByte) {
  const TemporaryFolder folder;
  const std::string content("a\0b\r\n\xff", 6);
  write_file(folder.path("x"), content);
  EXPECT_EQ(read_file(folder.path("x")), content);
}

TEST(AtomicFile, LeavesNothingButTheFileBehind) {
  const TemporaryFolder folder;
  write_file(folder.path("x"), "old");
  write_file(folder.path("x"), "new");
  EXPECT_EQ(folder.count(), 1U);
  EXPECT_EQ(TemporaryFolder::read(folder.path("x")), "new");
}

TEST(AtomicFile, KeepsThePermissionsOfAFileThatItReplaces) {
  const TemporaryFolder folder;
  folder.write("x", "old");
  ::chmod(folder.path("x").c_str(), 0640);
  write_file(folder.path("x"), "new");
  struct stat status {};
  ::stat(folder.path("x").c_str(), &status);
  EXPECT_EQ(status.st_mode & 07777, 0640U);
}

TEST(AtomicFile, ASymbolicLinkStaysOneAndItsTargetIsReplaced) {
  const TemporaryFolder folder;
  folder.write("real", "old");
  std::filesystem::create_symlink("real", folder.path("link"));
  write_file(folder.path("link"), "new");
  EXPECT_TRUE(std::filesystem::is_symlink(folder.path("link")));
  EXPECT_EQ(TemporaryFolder::read(folder.path("real")), "new");
}

TEST(AtomicFile, AFullDiskIsAnErrorAndNotSilence) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full here";
  EXPECT_EQ(code_of([] { write_file("/dev/full", "content"); }), "cannot_write");
}

TEST(AtomicFile, WhatAKilledProcessLeftIsRemovedByTheNextWrite) {
  const TemporaryFolder folder;
  std::string left;
  {
    const UnfinishedFile unfinished(folder.path("x"));
    left = unfinished.path();
  }
  folder.write(left.substr(folder.path("").size()), "half of it");  // as if nobody had removed it
  ASSERT_TRUE(std::filesystem::exists(left));
  write_file(folder.path("x"), "whole");
  EXPECT_EQ(folder.count(), 1U);
  EXPECT_EQ(TemporaryFolder::read(folder.path("x")), "whole");
}

TEST(AtomicFile, WhatAnotherProcessIsWritingStays) {
  const TemporaryFolder folder;
  UnfinishedFile slow(folder.path("x"));
  slow.append("the ");
  EXPECT_FALSE(remove_leftover(slow.path()));
  write_file(folder.path("x"), "quick");
  EXPECT_EQ(TemporaryFolder::read(folder.path("x")), "quick");
  slow.append("slow one");
  slow.finish();
  EXPECT_EQ(TemporaryFolder::read(folder.path("x")), "the slow one");
  EXPECT_EQ(folder.count(), 1U);
}

TEST(AtomicFile, OnlyAFileIsTakenForALeftover) {
  const TemporaryFolder folder;
  const std::string name = folder.path("x.partial-hysteron");
  ASSERT_EQ(::mkfifo(name.c_str(), 0600), 0);
  EXPECT_FALSE(remove_leftover(name));
  write_file(folder.path("x"), "content");
  EXPECT_TRUE(std::filesystem::is_fifo(name));
}

TEST(AtomicFile, WorkThatIsAskedToStopLeavesTheOldFile) {
  const TemporaryFolder folder;
  folder.write("x", "old");
  const StopScope scope([] { return true; });
  EXPECT_THROW(write_file(folder.path("x"), "new"), Stopped);
  EXPECT_EQ(TemporaryFolder::read(folder.path("x")), "old");
  EXPECT_EQ(folder.count(), 1U);
}

TEST(AtomicFile, AFolderAsTargetAndAMissingFolderAreErrors) {
  const TemporaryFolder folder;
  EXPECT_EQ(code_of([&] { write_file(folder.path(), "content"); }), "cannot_write");
  EXPECT_EQ(code_of([&] { write_file(folder.path("not/there"), "content"); }), "cannot_write");
  EXPECT_EQ(folder.count(), 0U);
}

TEST(AtomicFile, ReadingNamesWhatStandsInTheWay) {
  const TemporaryFolder folder;
  EXPECT_EQ(code_of([&] { read_file(folder.path("nothing")); }), "no_file");
  EXPECT_EQ(code_of([&] { read_file(folder.path()); }), "is_directory");
  EXPECT_EQ(code_of([&] { read_file("/dev/zero"); }), "not_a_file");
}

}  // namespace
}  // namespace hysteron
