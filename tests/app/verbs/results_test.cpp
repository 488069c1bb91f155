// What is written into folders of results, whatever happens meanwhile: full disks, signals, other processes.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <random>

#include "tests/app/hysteron_process.h"
#include "tests/app/small_study.h"

namespace hysteron {
namespace {

namespace fs = std::filesystem;
using process::Folder;
using process::hysteron;
using process::hysteron_killed;
using process::hysteron_terminated;
using process::Outcome;
using process::shell;

constexpr char driven_loop[] = R"({"format": 1, "title": "loop", "blocks": {
  "drive": {"type": "sine", "amplitude": "3 um", "frequency": "5 Hz"},
  "plant": {"type": "lag", "times": ["2 ms"], "in": "drive"}},
  "outputs": {"y": "plant"}, "record": ["drive", "plant"], "simulate": {"until": "0.5 s", "every": "1 ms"}})";

/// A thousand million steps: nobody waits for their end.
constexpr char slow[] = R"({"format": 1, "title": "slow", "blocks": { SOURCE
  "law": {"type": "bouc_wen", "alpha": "0.6 um/V", "beta": "0.24 1/V", "gamma": "0.02 1/V", "d_p": "1.6 um/V",
          "in": "DRIVE"}},
  INPUTS "outputs": {"y": "law"}, "record": ["law"],
  "simulate": {"until": "1000 s", "every": "1 s", "solver": {"method": "rk4", "step": "1 us"}}})";

std::string slow_diagram(bool with_input) {
  std::string text = slow;
  const auto put = [&](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  // A carrier of 10^6 periods, so that no method gets through quickly where nothing else moves.
  put("SOURCE", with_input ? R"("carrier": {"type": "sine", "amplitude": "3 V", "frequency": "1 kHz"},
                                "drive": {"type": "sum", "signs": "++", "in": ["carrier", "u"]},)"
                           : R"("drive": {"type": "sine", "amplitude": "3 V", "frequency": "5 Hz"},)");
  put("DRIVE", "drive");
  put("INPUTS", with_input ? R"("inputs": {"u": {"unit": "V"}},)" : "");
  return text;
}

/// The files below a folder, with their content.
std::map<std::string, std::string> content_of(const std::string& folder) {
  std::map<std::string, std::string> files;
  std::error_code code;
  for (const auto& entry : fs::recursive_directory_iterator(folder, code)) {
    const std::string name = entry.path().lexically_relative(folder).string();
    std::ifstream in(entry.path(), std::ios::binary);
    files[name] = entry.is_directory() ? "folder" : std::string(std::istreambuf_iterator<char>(in), {});
  }
  return files;
}

TEST(Results, GoIntoTheFolderInWhichOneStands) {
  const Folder folder;
  folder.write("loop.json", driven_loop);
  const Outcome outcome = shell(folder.path(),
                                "mkdir here && cd here && hysteron run ../loop.json -o . && pwd -P >&2 && "
                                "hysteron check ../loop.json && hysteron run ../loop.json -o .");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(folder.has("here/result.json"));
  EXPECT_EQ(folder.entries(), (std::vector<std::string>{"here/", "loop.json"}));
}

/// Runs a command where `disk` is a file system of its own of so many bytes; code 77 where none can be mounted.
Outcome on_a_disk_of(const Folder& folder, const std::string& size, const std::string& command) {
  folder.write("on_a_disk", "mkdir -p disk && mount -t tmpfs -o size=" + size + " disk disk || exit 77\n" + command);
  return shell(folder.path(), "unshare --mount /bin/sh ./on_a_disk || exit $?");
}
#define SKIP_WITHOUT_DISK(outcome)                                                \
  if ((outcome).code == 77 || (outcome).err.find("unshare") != std::string::npos) \
  GTEST_SKIP() << "no file system can be mounted here (root may): " << (outcome).err

TEST(Results, GoIntoTheRootOfAFileSystem) {
  const Folder folder;
  folder.write("loop.json", driven_loop);
  const Outcome outcome = on_a_disk_of(folder, "4m", R"(mkdir disk/lost+found
      hysteron run loop.json -o disk && hysteron run loop.json -o disk && ls -A disk)");
  SKIP_WITHOUT_DISK(outcome);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(outcome.out.ends_with("lost+found\nreport.html\nresult.json\nresult.schema.json\ntraces\n"))
      << outcome.out;
}

TEST(Results, AStudyOnAFullDiskEndsWithAMessage) {
  const Folder folder;
  small_study::write(folder, "", 40);
  for (const char* words : {"--threads 1", "--threads 2", "--shard 1/2"}) {
    const Outcome outcome =
        on_a_disk_of(folder, "16k",
                     std::string("hysteron study job.json -o disk/st ") + words + "\ncode=$?\nls -AR disk\nexit $code");
    SKIP_WITHOUT_DISK(outcome);
    EXPECT_EQ(outcome.code, 2) << words << outcome.err;
    EXPECT_NE(outcome.err.find("No space left on device"), std::string::npos) << words << outcome.err;
    EXPECT_EQ(outcome.out.find("partial"), std::string::npos) << outcome.out;
    EXPECT_EQ(outcome.out.find(".hysteron"), std::string::npos) << outcome.out;
  }
}

TEST(Results, AFileBeyondTheLimitOfTheShellIsAnErrorAndLeavesNothing) {
  const Folder folder;
  folder.write("loop.json", driven_loop);
  small_study::write(folder, "", 40);
  for (const char* command : {"run loop.json -o out", "study job.json -o out", "study job.json -o out --shard 1/4"}) {
    const Outcome outcome = shell(folder.path(), std::string("ulimit -f 8; hysteron ") + command);
    EXPECT_EQ(outcome.code, 2) << command << outcome.err;
    EXPECT_NE(outcome.err.find("ulimit -f"), std::string::npos) << outcome.err;
    for (const auto& [name, content] : content_of(folder.path() + "/out"))
      EXPECT_TRUE(name == "shards" || name == "shards/study.txt") << name;
  }
}

/// Starts `commands` at once; the sum of their exit codes.
Outcome at_once(const Folder& folder, const std::vector<std::string>& commands) {
  std::string script = "sum=0; list=''\n";
  for (const auto& command : commands) script += command + " & list=\"$list $!\"\n";
  return shell(folder.path(), script + "for p in $list; do wait $p; sum=$((sum + $?)); done; exit $sum");
}

TEST(Results, SeveralRunsIntoOneFolderTakeTurns) {
  const Folder folder;
  folder.write("loop.json", driven_loop);
  const auto command = [](int i, const std::string& out) {
    return "hysteron run loop.json --set drive.amplitude='" + std::to_string(i) + " um' --quiet -o " + out;
  };
  std::vector<std::string> commands;
  for (int i = 1; i <= 4; ++i) {
    commands.push_back(command(i, "out"));
    ASSERT_EQ(shell(folder.path(), command(i, "alone" + std::to_string(i))).code, 0);
  }
  for (int round = 0; round < 3; ++round) {
    const Outcome outcome = at_once(folder, commands);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const auto out = content_of(folder.path() + "/out");
    int same = 0;
    for (int i = 1; i <= 4; ++i) same += out == content_of(folder.path() + "/alone" + std::to_string(i)) ? 1 : 0;
    EXPECT_EQ(same, 1) << "the folder holds the results of one of them, whole";
  }
}

TEST(Results, SeveralStudiesInOneFolderTakeTurns) {
  const Folder folder;
  small_study::write(folder, "", 200);
  ASSERT_EQ(shell(folder.path(), "hysteron study job.json -o alone --quiet").code, 0);
  const auto alone = content_of(folder.path() + "/alone");
  const std::string study = "hysteron study job.json -o out --quiet";
  for (int round = 0; round < 3; ++round) {
    const Outcome outcome = at_once(folder, {study, study, study, study + " --shard 2/4", study + " --shard 4/4"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_TRUE(content_of(folder.path() + "/out") == alone);
    fs::remove_all(folder.path() + "/out");
  }
}

class ResultsAfterSigterm : public testing::Test {
 protected:
  /// Ends with 130 and a sentence; `out` is as it was, and nothing else has appeared.
  void ends(const std::vector<std::string>& words) {
    const auto before = content_of(folder_.path());
    const Outcome outcome = hysteron_terminated(folder_.path(), words);
    EXPECT_EQ(outcome.code, 130) << outcome.out << outcome.err;
    EXPECT_NE(outcome.err.find("interrupted"), std::string::npos) << outcome.err;
    EXPECT_TRUE(content_of(folder_.path()) == before);
  }
  const Folder folder_;
};

TEST_F(ResultsAfterSigterm, OfRun) {
  folder_.write("slow.json", slow_diagram(false));
  ends({"run", "slow.json", "-o", "out"});
  // Where an earlier run has left results, they stay.
  ASSERT_EQ(hysteron(folder_.path(), {"run", "slow.json", "-o", "out", "--until", "1 s"}).code, 0);
  ends({"run", "slow.json", "-o", "out"});
}

TEST_F(ResultsAfterSigterm, OfCompare) {
  folder_.write("slow.json", slow_diagram(true));
  std::string csv = "t [s],u [V],y [um]\n";
  for (int i = 0; i <= 1000; ++i) csv += std::to_string(i) + ",1,1\n";
  folder_.write("lab.csv", csv);
  ends({"compare", "slow.json", "--data", "lab.csv", "-o", "out"});
}

TEST_F(ResultsAfterSigterm, OfReproduce) {
  folder_.write("hysteron.project", "");
  folder_.write("diagrams/claims.json", R"({"format": 1, "claims": {}})");
  folder_.write("diagrams/chapter2/slow.json", slow_diagram(false));
  folder_.write("diagrams/chapter2/fig2_1.json", R"({"format": 1, "do": "runs", "title": "Slow", "diagram": "slow.json",
    "runs": {"a": {}, "b": {}}, "plots": [{"y": {"signal": "y"}}]})");
  ends({"reproduce", "all", "-o", "out", "--baseline", "baseline"});
}

TEST_F(ResultsAfterSigterm, OfStudyKeepsWhatIsFinished) {
  std::string diagram = slow_diagram(false);  // in steps of any length: one draw after the other, each of minutes
  const std::string fixed = R"("method": "rk4", "step": "1 us")";
  diagram.replace(diagram.find(fixed), fixed.size(), R"("method": "auto")");
  diagram.replace(diagram.find("5 Hz"), 4, "1 kHz");
  folder_.write("slow.json", diagram);
  folder_.write("job.json", R"({"format": 1, "do": "study", "title": "slow", "diagram": "slow.json",
    "sample": {"method": "uniform", "seed": 5, "draws": 8, "shards": 4,
               "parameters": {"law.alpha": {"from": "0.4 um/V", "to": "0.8 um/V"}}},
    "features": {"stroke": {"take": "stroke", "of": "y"}}})");
  const Outcome outcome = hysteron_terminated(folder_.path(), {"study", "job.json", "-o", "out"});
  EXPECT_EQ(outcome.code, 130) << outcome.err;
  EXPECT_NE(outcome.err.find("0 of 4 shards are finished and kept in out/shards"), std::string::npos) << outcome.err;
  const auto out = content_of(folder_.path() + "/out");
  EXPECT_EQ(out.size(), 2U);
  EXPECT_TRUE(out.contains("shards/study.txt"));
}

TEST_F(ResultsAfterSigterm, OfAStudyThatWaitsForAnother) {
  small_study::write(folder_, "", 40);
  fs::create_directories(folder_.path() + "/out/.hysteron");
  const int other = ::open((folder_.path() + "/out/.hysteron/lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  ASSERT_EQ(::write(other, "process 7 on node3", 18), 18);
  ASSERT_EQ(::flock(other, LOCK_EX | LOCK_NB), 0);
  const Outcome outcome = hysteron_terminated(folder_.path(), {"study", "job.json", "-o", "out"});
  EXPECT_EQ(outcome.code, 130) << outcome.err;
  ::close(other);
  EXPECT_EQ(hysteron(folder_.path(), {"study", "job.json", "-o", "out"}).code, 0);
  EXPECT_FALSE(folder_.has("out/.hysteron"));
}

/// Waits until nobody puts results in place in this folder: after a kill that goes on for an instant.
void wait_for_others(const std::string& folder) {
  const int lock = ::open((folder + "/.hysteron/lock").c_str(), O_RDWR | O_CLOEXEC);
  if (lock < 0) return;
  ::flock(lock, LOCK_EX);
  ::close(lock);
}

/// Two runs by turns into one folder, each killed at a random moment: it holds what one of them gives, whole.
void kill_runs(int times) {
  const Folder folder;
  folder.write("loop.json", driven_loop);
  const auto words = [](int i, const std::string& out) {
    return std::vector<std::string>{"run", "loop.json", "--set", "drive.amplitude=" + std::to_string(1 + i) + " um",
                                    "-o",  out};
  };
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_EQ(hysteron(folder.path(), words(0, "first")).code, 0);
  const auto took = std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::steady_clock::now() - begin);
  ASSERT_EQ(hysteron(folder.path(), words(1, "second")).code, 0);
  const auto first = content_of(folder.path() + "/first"), second = content_of(folder.path() + "/second");
  std::mt19937 random(13);
  bool there = false;
  for (int kills = 0, turn = 0; kills < times; ++turn) {
    const int after = 1 + static_cast<int>(random() % static_cast<unsigned>(took.count() + 2));
    kills += hysteron_killed(folder.path(), words(turn % 2, "out"), after).code == 137 ? 1 : 0;
    wait_for_others(folder.path() + "/out");
    auto out = content_of(folder.path() + "/out");
    std::erase_if(out, [](const auto& entry) { return entry.first.starts_with(".hysteron"); });
    const bool whole = out == first || out == second;
    EXPECT_TRUE(whole || (!there && out.empty()));
    there = there || whole;
    auto others = folder.entries();
    std::erase(others, "out/");  // not there yet where the first ones were killed at their beginning
    EXPECT_EQ(others, (std::vector<std::string>{"first/", "loop.json", "second/"})) << "nothing lies beside it";
  }
  ASSERT_EQ(hysteron(folder.path(), words(0, "out")).code, 0);
  EXPECT_TRUE(content_of(folder.path() + "/out") == first) << "nothing is left over";
}

TEST(Results, AreThoseOfOneRunWheneverAnotherIsKilled) { kill_runs(15); }
TEST(LongResults, AreThoseOfOneRunWheneverAnotherIsKilled) { kill_runs(300); }

}  // namespace
}  // namespace hysteron
