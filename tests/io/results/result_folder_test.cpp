// A folder of results is whole or absent, and never replaces what is not ours.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>

#include "engine/diagram/error.h"
#include "engine/diagram/stop.h"
#include "io/files/atomic_file.h"
#include "io/files/folder_lock.h"
#include "io/results/result.h"
#include "tests/io/results/example.h"
#include "tests/io/small_disk.h"
#include "tests/io/temporary_folder.h"

namespace hysteron {
namespace {

namespace fs = std::filesystem;

/// Code of the error that an action throws, or "". Every error must carry a cure.
template <class Action>
std::string code_of(const Action& action) {
  try {
    action();
  } catch (const Error& e) {
    EXPECT_FALSE(e.problems.front().cure.empty());
    EXPECT_FALSE(e.problems.front().path.empty());
    return e.problems.front().code;
  }
  return "";
}

void put(const fs::path& file, const std::string& text) { std::ofstream(file) << text; }

class ResultFolder : public testing::Test {
 protected:
  std::string out() const { return (root_ / "out").string(); }
  /// Names in the folder around the results: anything but "out" is something left behind.
  std::vector<std::string> names() const {
    std::vector<std::string> list;
    for (const auto& entry : fs::directory_iterator(root_)) list.push_back(entry.path().filename());
    return list;
  }
  TemporaryFolder temporary_;
  const fs::path root_ = temporary_.path();
};

TEST_F(ResultFolder, HoldsResultReportSchemaTracesAndFiles) {
  write_result(out(), example::discovery(), "<!doctype html>");
  for (const char* name :
       {"result.json", "result.schema.json", "report.html", "traces/02.csv", "step1.json", "steps/2.json"})
    EXPECT_TRUE(fs::is_regular_file(root_ / "out" / name)) << name;
  EXPECT_EQ(names(), std::vector<std::string>{"out"});
}

TEST_F(ResultFolder, IsReplacedWholeByTheNextRun) {
  write_result(out(), example::discovery(), "<!doctype html>");
  Document second;
  second.verb = "discover";
  second.title = "again";
  write_result(out() + "/", second, "");
  EXPECT_EQ(read_result(out()).title, "again");
  EXPECT_FALSE(fs::exists(root_ / "out/traces"));
  EXPECT_FALSE(fs::exists(root_ / "out/step1.json"));
  EXPECT_EQ(names(), std::vector<std::string>{"out"});
}

TEST_F(ResultFolder, WhatAnotherVerbFoundIsNotReplaced) {
  write_result(out(), example::discovery(), "");
  Document second;
  second.verb = "compare";
  EXPECT_EQ(code_of([&] { write_result(out(), second, ""); }), "folder_in_use");
  EXPECT_EQ(read_result(out()).verb, "discover");
  EXPECT_TRUE(fs::exists(root_ / "out/step1.json"));
}

TEST_F(ResultFolder, KeepsWhatOthersPutThere) {
  write_result(out(), example::discovery(), "");
  put(root_ / "out/notes.txt", "mind the third step");
  fs::create_directories(root_ / "out/mine");
  put(root_ / "out/mine/final.json", "{}");
  fs::create_directory_symlink(root_, root_ / "out/link");
  Document second;
  second.verb = "discover";
  write_result(out(), second, "");
  EXPECT_EQ(read_file((root_ / "out/notes.txt").string()), "mind the third step");
  EXPECT_EQ(read_file((root_ / "out/mine/final.json").string()), "{}");
  EXPECT_TRUE(fs::is_symlink(root_ / "out/link"));
  EXPECT_FALSE(fs::exists(root_ / "out/step1.json")) << "of the earlier run";
  // A name that the next run needs is not taken from them.
  second.files.emplace_back("notes.txt", "of a run");
  EXPECT_EQ(code_of([&] { write_result(out(), second, ""); }), "folder_in_use");
  EXPECT_EQ(read_file((root_ / "out/notes.txt").string()), "mind the third step");
  EXPECT_EQ(names(), std::vector<std::string>{"out"});
}

/// What a user sees of a file or folder.
struct Seen {
  explicit Seen(const fs::path& path) { EXPECT_EQ(::lstat(path.c_str(), &status), 0) << path; }
  bool operator==(const Seen& o) const {
    return status.st_ino == o.status.st_ino && status.st_dev == o.status.st_dev && status.st_mode == o.status.st_mode &&
           status.st_nlink == o.status.st_nlink && status.st_uid == o.status.st_uid &&
           status.st_mtim.tv_sec == o.status.st_mtim.tv_sec && status.st_mtim.tv_nsec == o.status.st_mtim.tv_nsec;
  }
  struct stat status {};
};

TEST_F(ResultFolder, WhatIsTheUsersIsNotTouched) {
  write_result(out(), example::discovery(), "");
  put(root_ / "out/notes.txt", "mind the third step");
  fs::last_write_time(root_ / "out/notes.txt", fs::file_time_type::clock::now() - std::chrono::hours(10000));
  fs::create_hard_link(root_ / "out/notes.txt", root_ / "out/linked");
  for (const char* name : {"out/private", "out/empty", "out/traces/empty"}) fs::create_directory(root_ / name);
  put(root_ / "out/private/secret", "s");
  ::chmod((root_ / "out/private").c_str(), 0700);
  ::chmod((root_ / "out").c_str(), 0750);
  ::chmod((root_ / "out/result.json").c_str(), 0600);
  ASSERT_EQ(::mkfifo((root_ / "out/pipe").c_str(), 0600), 0);
  std::vector<std::pair<fs::path, Seen>> before;
  for (const char* name : {"notes.txt", "linked", "private", "private/secret", "empty", "traces/empty", "pipe"})
    before.emplace_back(root_ / "out" / name, Seen(root_ / "out" / name));
  const Seen folder(root_ / "out");

  Document second;
  second.verb = "discover";
  write_result(out(), second, "<!doctype html>");
  for (const auto& [path, seen] : before) EXPECT_TRUE(Seen(path) == seen) << path;
  EXPECT_EQ(Seen(root_ / "out").status.st_ino, folder.status.st_ino);
  EXPECT_EQ(Seen(root_ / "out").status.st_mode, folder.status.st_mode);
  EXPECT_EQ(Seen(root_ / "out/result.json").status.st_mode & 07777, 0600U);
  EXPECT_FALSE(fs::exists(root_ / "out/traces/02.csv")) << "of the earlier run";
  EXPECT_FALSE(fs::exists(root_ / "out/.hysteron"));
}

TEST_F(ResultFolder, IsWrittenWhereTheProgramStands) {
  fs::create_directories(out());
  const fs::path before = fs::current_path();
  fs::current_path(out());
  for (const char* name : {".", "", "./"}) {
    write_result(name, example::discovery(), "");
    EXPECT_EQ(fs::current_path(), fs::canonical(out()));
  }
  fs::current_path(before);
  EXPECT_EQ(read_result(out()).verb, "discover");
}

TEST_F(ResultFolder, ANameThatTheUserHasGivenToSomethingElseIsTold) {
  write_result(out(), example::discovery(), "<!doctype html>");
  const auto refused = [&] {
    try {
      write_result(out(), example::discovery(), "<!doctype html>");
    } catch (const Error& e) {
      EXPECT_EQ(e.problems.front().code, "folder_in_use");
      return e.problems.front().what;
    }
    return std::string();
  };
  fs::remove(root_ / "out/report.html");
  ASSERT_EQ(::mkfifo((root_ / "out/report.html").c_str(), 0600), 0);
  EXPECT_NE(refused().find("out/report.html"), std::string::npos) << refused();
  fs::remove(root_ / "out/report.html");
  fs::create_directory(root_ / "out/report.html");
  EXPECT_NE(refused().find("out/report.html"), std::string::npos) << refused();
  fs::remove(root_ / "out/report.html");
  // A link to a folder elsewhere: what lies there is not ours.
  fs::rename(root_ / "out/traces", root_ / "elsewhere");
  fs::create_directory_symlink(root_ / "elsewhere", root_ / "out/traces");
  EXPECT_NE(refused().find("out/traces"), std::string::npos) << refused();
  EXPECT_TRUE(fs::exists(root_ / "elsewhere/02.csv"));
  EXPECT_FALSE(fs::exists(root_ / "out/.hysteron"));
}

TEST_F(ResultFolder, AResultThatNamesFilesOutsideTakesNoneOfThemAway) {
  put(root_ / "victim.txt", "years of work");
  fs::create_directories(root_ / "out");
  fs::create_directories(root_ / "far");
  put(root_ / "far/victim.txt", "years of work");
  fs::create_directory_symlink(root_ / "far", root_ / "out/near");
  const std::string absolute = (root_ / "victim.txt").string();
  put(root_ / "out/result.json", R"({"program": "hysteron", "verb": "discover", "traces": ["../../victim.txt"],
      "files": ["../victim.txt", "near/victim.txt", ")" +
                                     absolute + R"(", "", ".", 7], "data": "victim.txt"})");
  write_result(out(), example::discovery(), "");
  EXPECT_TRUE(fs::exists(root_ / "victim.txt"));
  EXPECT_TRUE(fs::exists(root_ / "far/victim.txt"));
  EXPECT_EQ(read_result(out()).verb, "discover");
}

/// A folder as a process leaves it that is killed while it puts the results of `document` in place: `moved` of them are
/// there, the others wait in .hysteron/new.
void leave_between(const fs::path& out, const Document& document, const std::vector<std::string>& moved) {
  const fs::path made = out.parent_path() / "made";
  write_result(made.string(), document, "<!doctype html>");
  fs::create_directories(out / ".hysteron");
  put(out / ".hysteron/lock", "process 1 on nowhere");
  fs::rename(made, out / ".hysteron/new");
  for (const auto& name : moved) {
    fs::create_directories((out / name).parent_path());
    fs::rename(out / ".hysteron/new" / name, out / name);
  }
}

TEST_F(ResultFolder, WhatAKilledProcessHadWholeIsPutInPlaceByTheNext) {
  Document older;
  older.verb = "discover";
  older.traces = {CsvTable{"old.csv", {{"t", {}, {0}}}, {}}};
  Document other;
  other.verb = "discover";
  other.files = {{"notes.txt", "of a run"}};  // so that it is refused, and nothing else is written
  const std::vector<std::string> order{"traces/02.csv", "step1.json", "report.html", "result.schema.json"};
  for (std::size_t moved = 0; moved <= order.size(); ++moved) {
    fs::remove_all(out());
    write_result(out(), older, "");
    put(root_ / "out/notes.txt", "mine");
    leave_between(out(), example::discovery(), {order.begin(), order.begin() + static_cast<std::ptrdiff_t>(moved)});
    EXPECT_EQ(code_of([&] { write_result(out(), other, ""); }), "folder_in_use");
    EXPECT_EQ(read_result(out()).title, example::discovery().title) << moved;
    EXPECT_FALSE(fs::exists(root_ / "out/traces/old.csv"));
    EXPECT_FALSE(fs::exists(root_ / "out/.hysteron"));
    EXPECT_EQ(read_file((root_ / "out/notes.txt").string()), "mine");
  }
}

TEST_F(ResultFolder, WhatAKilledProcessHadNotWholeIsRemovedByTheNext) {
  Document second;
  second.verb = "discover";
  leave_between(out(), example::discovery(), {});
  fs::remove(root_ / "out/.hysteron/new/result.json");
  write_result(out(), second, "");
  EXPECT_EQ(read_result(out()).title, "");
  EXPECT_FALSE(fs::exists(root_ / "out/traces"));
  EXPECT_FALSE(fs::exists(root_ / "out/.hysteron"));
  EXPECT_EQ(names(), std::vector<std::string>{"out"});
}

TEST_F(ResultFolder, SeveralAtOnceTakeTurns) {
  constexpr int writers = 4;
  std::vector<pid_t> children;
  for (int i = 0; i < writers; ++i) {
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      int failed = 0;
      for (int k = 0; k < 10; ++k) {
        Document d;
        d.verb = "run";
        d.title = std::to_string(i);
        d.traces = {CsvTable{"a.csv", {{"t", {}, {static_cast<double>(i)}}}, {}},
                    CsvTable{std::to_string(i) + ".csv", {{"t", {}, {static_cast<double>(i)}}}, {}}};
        try {
          write_result(out(), d, "<!doctype html>");
        } catch (...) {
          failed = 1;
        }
      }
      ::_exit(failed);
    }
    children.push_back(child);
  }
  for (const pid_t child : children) {
    int status = -1;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_EQ(status, 0);
  }
  const Document last = read_result(out());  // reads its traces, too
  for (const auto& trace : last.traces)
    EXPECT_EQ(std::to_string(static_cast<int>(trace.columns[0].values[0])), last.title);
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(root_ / "out/traces")) files += entry.is_regular_file() ? 1 : 0;
  EXPECT_EQ(files, 2U);
  EXPECT_FALSE(fs::exists(root_ / "out/.hysteron"));
}

/// Which of two results a folder holds, files and all: 0 or 1; -1 where it holds none; a mixture is a failure.
int which_result(const fs::path& out) {
  if (!fs::exists(out / "result.json")) {
    EXPECT_FALSE(fs::exists(out / "traces"));
    return -1;
  }
  const Document d = read_result(out.string());
  const int which = std::stoi(d.title);
  EXPECT_EQ(d.traces.size(), 8U);
  for (const auto& trace : d.traces) EXPECT_EQ(trace.columns[0].values[0], which) << trace.file;
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(out / "traces")) files += entry.is_regular_file() ? 1 : 0;
  EXPECT_EQ(files, 8U);
  return which;
}

/// One of two results, each with files of its own.
void write_one_of_two(const fs::path& out, int which) {
  Document d;
  d.verb = "run";
  d.title = std::to_string(which);
  for (int k = 0; k < 8; ++k)
    d.traces.push_back(
        {std::to_string(k < 4 ? k : 10 * which + k) + ".csv", {{"t", {}, {static_cast<double>(which)}}}, {}});
  write_result(out.string(), d, "<!doctype html>");
}

/// Waits until nobody puts results in place: that goes on for an instant where its process was killed.
void wait_for_others(const fs::path& out) {
  const int lock = ::open((out / ".hysteron/lock").c_str(), O_RDWR | O_CLOEXEC);
  if (lock < 0) return;
  ::flock(lock, LOCK_EX);
  ::close(lock);
}

/// Processes that write one of the two by turns are killed, so many times at least; after each kill the folder holds
/// one of them, and each of them at some time.
void kill_writers(const fs::path& out, int times) {
  const auto begin = std::chrono::steady_clock::now();
  write_one_of_two(out.parent_path() / "timed", 0);
  const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - begin;
  std::mt19937 random(46);
  std::map<int, int> held;
  for (int i = 0; i < times || held[0] == 0 || held[1] == 0; ++i) {
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      write_one_of_two(out, i % 2);
      ::pause();
    }
    ::usleep(static_cast<useconds_t>(std::uniform_real_distribution(0.0, 2 * took.count())(random)));
    ::kill(child, SIGKILL);
    ASSERT_EQ(::waitpid(child, nullptr, 0), child);
    wait_for_others(out);
    ++held[which_result(out)];
  }
  Document last;
  last.verb = "run";
  write_result(out.string(), last, "<!doctype html>");
  std::size_t entries = 0;
  for ([[maybe_unused]] const auto& entry : fs::recursive_directory_iterator(out)) ++entries;
  EXPECT_EQ(entries, 3U) << "nothing is left over";
}

TEST_F(ResultFolder, OfAProcessThatIsKilledHoldsTheOldOrTheNewResults) { kill_writers(out(), 30); }

class LongResultFolder : public ResultFolder {};
TEST_F(LongResultFolder, OfAProcessThatIsKilledHoldsTheOldOrTheNewResults) { kill_writers(out(), 3000); }

TEST_F(ResultFolder, WhatIsAskedToStopLeavesTheOldResults) {
  const StopScope scope([] { return true; });
  EXPECT_THROW(write_result(out(), example::discovery(), ""), Stopped);
  EXPECT_TRUE(names().empty());
}

TEST_F(ResultFolder, MayBeEmptyBefore) {
  fs::create_directories(out());
  write_result(out(), example::discovery(), "");
  EXPECT_TRUE(fs::exists(root_ / "out/result.json"));
}

TEST_F(ResultFolder, IsMadeWithTheFoldersAboveIt) {
  write_result((root_ / "a/b/c").string(), Document{}, "");
  EXPECT_TRUE(fs::exists(root_ / "a/b/c/result.json"));
}

TEST_F(ResultFolder, OfSomebodyElseIsLeftAlone) {
  fs::create_directories(out());
  put(root_ / "out/thesis.tex", "years of work");
  EXPECT_EQ(code_of([&] { write_result(out(), Document{}, ""); }), "folder_in_use");
  put(root_ / "out/result.json", R"({"program": "other"})");
  EXPECT_EQ(code_of([&] { write_result(out(), Document{}, ""); }), "folder_in_use");
  put(root_ / "out/result.json", "not even JSON");
  EXPECT_EQ(code_of([&] { write_result(out(), Document{}, ""); }), "folder_in_use");
  EXPECT_EQ(read_file((root_ / "out/thesis.tex").string()), "years of work");
  EXPECT_EQ(names(), std::vector<std::string>{"out"});
}

TEST_F(ResultFolder, CannotTakeThePlaceOfAFileOrLieUnderOne) {
  put(root_ / "out", "a file");
  EXPECT_EQ(code_of([&] { write_result(out(), Document{}, ""); }), "cannot_write");
  EXPECT_EQ(code_of([&] { write_result(out() + "/deeper", Document{}, ""); }), "cannot_write");
  EXPECT_EQ(code_of([&] { write_result("/dev/full", Document{}, ""); }), "cannot_write");
  EXPECT_EQ(code_of([&] { write_result("/dev/full/out", Document{}, ""); }), "cannot_write");
  EXPECT_EQ(read_file(out()), "a file");
}

TEST_F(ResultFolder, IsAbsentOrUnchangedWhenTheDiskIsFull) {
  std::string code;
  {
    const SmallDisk disk(20000);  // result.json would fit, the trace does not
    code = code_of([&] { write_result(out(), example::discovery(), ""); });
  }
  EXPECT_EQ(code, "cannot_write");
  EXPECT_TRUE(names().empty());

  Document small;
  small.headline = "the older result";
  write_result(out(), small, "");
  {
    const SmallDisk disk(20000);
    code = code_of([&] { write_result(out(), example::discovery(), ""); });
  }
  EXPECT_EQ(code, "cannot_write");
  EXPECT_EQ(read_result(out()).headline, "the older result");
  EXPECT_EQ(names(), std::vector<std::string>{"out"});
}

TEST_F(ResultFolder, NamesMustStayInside) {
  for (const char* name : {"../evil.json", "/tmp/evil.json", "", "a/../../evil.json", "folder/"}) {
    Document d;
    d.files = {{name, "text"}};
    EXPECT_EQ(code_of([&] { write_result(out(), d, ""); }), "bad_name") << name;
  }
  Document d;
  d.files = {{"result.json", "text"}};
  EXPECT_EQ(code_of([&] { write_result(out(), d, ""); }), "duplicate_name");
  EXPECT_TRUE(names().empty());
}

TEST_F(ResultFolder, RefusesACurveThatPointsNowhere) {
  Document d = example::discovery();
  d.sections[1].figures[0].curves[0].y_column = "yy";
  EXPECT_EQ(code_of([&] { write_result(out(), d, ""); }), "unknown_trace");
  d = example::discovery();
  d.traces.clear();
  EXPECT_EQ(code_of([&] { write_result(out(), d, ""); }), "unknown_trace");
}

TEST(TraceFileName, IsSafeAndEndsInCsv) {
  EXPECT_EQ(trace_file_name("02.csv"), "02.csv");
  EXPECT_EQ(trace_file_name("lab 2/02.csv (2)"), "lab_2_02.csv__2_.csv");
  EXPECT_EQ(trace_file_name("../../etc/passwd"), "_.._etc_passwd.csv");
}

}  // namespace
}  // namespace hysteron
