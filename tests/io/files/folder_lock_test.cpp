// One process at a time changes a folder of results.
#include "io/files/folder_lock.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <optional>
#include <thread>

#include "engine/diagram/error.h"
#include "engine/diagram/stop.h"
#include "tests/io/temporary_folder.h"

namespace hysteron {
namespace {

namespace fs = std::filesystem;

TEST(FolderLock, TheSecondWaitsAndIsToldForWhom) {
  const TemporaryFolder folder;
  std::atomic<bool> free_again{false}, told{false};
  std::optional<FolderLock> first(std::in_place, folder.path("out"));
  std::string holder;
  std::thread second([&] {
    const FolderLock lock(folder.path("out"), [&](const std::string& who) {
      holder = who;
      told = true;
    });
    EXPECT_TRUE(free_again);
  });
  while (!told) std::this_thread::yield();
  free_again = true;
  first.reset();
  second.join();
  EXPECT_TRUE(holder.starts_with("process " + std::to_string(getpid()) + " on ")) << holder;
  EXPECT_EQ(folder.count(), 0U) << "folders that were made for the lock and stayed empty go";
}

TEST(FolderLock, ManyTakeTurns) {
  const TemporaryFolder folder;
  std::atomic<int> inside{0}, most{0};
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i)
    threads.emplace_back([&] {
      for (int k = 0; k < 3; ++k) {
        const FolderLock lock(folder.path("deep/out"));
        const int now = ++inside;
        most = std::max<int>(most, now);
        std::this_thread::yield();
        --inside;
      }
    });
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(most, 1);
  EXPECT_FALSE(fs::exists(folder.path("deep/out/.hysteron")));
}

TEST(FolderLock, EndsWithItsProcessHoweverThatEnds) {
  const TemporaryFolder folder;
  int ready[2];
  ASSERT_EQ(::pipe2(ready, O_CLOEXEC), 0);
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    const FolderLock lock(folder.path("out"));
    [[maybe_unused]] const auto written = ::write(ready[1], "x", 1);
    ::pause();
    ::_exit(0);
  }
  char byte = 0;
  ASSERT_EQ(::read(ready[0], &byte, 1), 1);
  const auto never = [] { return true; };
  {
    const StopScope at_once(never);
    EXPECT_THROW(FolderLock(folder.path("out")), Stopped);
  }
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  EXPECT_TRUE(fs::exists(folder.path("out/.hysteron/lock")));
  EXPECT_TRUE(is_free(folder.path("out")));
  const StopScope at_once(never);  // nobody has it: it is not waited
  { const FolderLock lock(folder.path("out")); }
  EXPECT_TRUE(fs::is_empty(folder.path("out"))) << "what the killed one left is gone";
  ::close(ready[0]);
  ::close(ready[1]);
}

TEST(FolderLock, AFolderThatIsThereStays) {
  const TemporaryFolder folder;
  folder.write("out/notes.txt", "mine");
  fs::permissions(folder.path("out"), fs::perms::owner_all);
  { const FolderLock lock(folder.path("out") + "/"); }
  EXPECT_EQ(folder.count(), 1U);
  EXPECT_FALSE(fs::exists(folder.path("out/.hysteron")));
  EXPECT_EQ(fs::status(folder.path("out")).permissions(), fs::perms::owner_all);
}

TEST(FolderLock, WhereNoFolderCanBeIsTold) {
  const TemporaryFolder folder;
  folder.write("file", "");
  for (const char* place : {"file", "file/out"}) {
    try {
      const FolderLock lock(folder.path(place));
      ADD_FAILURE() << place;
    } catch (const Error& error) {
      EXPECT_EQ(error.problems.front().code, "cannot_write");
      EXPECT_FALSE(error.problems.front().cure.empty());
    }
  }
  EXPECT_EQ(folder.count(), 1U);
}

// Of the folders of the kernel the system says that what cannot be made in them is not there, as it says of a folder
// that somebody else takes away this instant.
TEST(FolderLock, WhereNothingCanBeMadeItDoesNotWaitForEver) {
  const TemporaryFolder folder;
  fs::create_directory(folder.path("out"));
  fs::create_symlink("/proc/self", folder.path("out/.hysteron"));  // is a folder, in which no lock can be made
  for (const std::string& place : {std::string("/proc/x"), std::string("/proc/x/y"), folder.path("out")}) {
    try {
      const FolderLock lock(place);
      ADD_FAILURE() << place;
    } catch (const Error& error) {
      const auto& problem = error.problems.front();
      EXPECT_EQ(problem.code, "cannot_write");
      EXPECT_EQ(problem.path, place);
      EXPECT_NE(problem.what.find("cannot be made: No such file or directory"), std::string::npos) << problem.what;
      EXPECT_NE(problem.cure.find("-o"), std::string::npos) << problem.cure;
    }
  }
}

}  // namespace
}  // namespace hysteron
