// A folder of results is whole or absent, and never replaces what is not ours.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>

#include "engine/diagram/error.h"
#include "example.h"
#include "io/files/atomic_file.h"
#include "io/results/result.h"

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

class ResultFolder : public testing::Test {
 protected:
  ResultFolder() { fs::create_directories(root_); }
  ~ResultFolder() override { fs::remove_all(root_); }
  std::string out() const { return (root_ / "out").string(); }
  static void put(const fs::path& file, const std::string& text) { std::ofstream(file) << text; }
  /// Names in the folder around the results: anything but "out" is something left behind.
  std::vector<std::string> names() const {
    std::vector<std::string> list;
    for (const auto& entry : fs::directory_iterator(root_)) list.push_back(entry.path().filename());
    return list;
  }
  const fs::path root_ = fs::temp_directory_path() / ("hysteron_folder_" + std::to_string(getpid()));
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

/// While it lives, no file may grow beyond some bytes: what a full disk does, without filling one.
struct SmallDisk {
  explicit SmallDisk(rlim_t bytes) {
    former_handler = std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &former);
    rlimit small = former;
    small.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &small);
  }
  ~SmallDisk() {
    setrlimit(RLIMIT_FSIZE, &former);
    std::signal(SIGXFSZ, former_handler);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  rlimit former{};
  void (*former_handler)(int);
};

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
