// The verb study: shards, their merge, what is kept when it is killed, and wrong input.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <random>

#include "tests/app/hysteron_process.h"
#include "tests/app/schema_check.h"

namespace hysteron {
namespace {

using nlohmann::json;
using process::Folder;
using process::hysteron;
using process::hysteron_killed;
using process::Outcome;

/// The drive limited to 0 V ... upper, which the limit refuses where it is not above 0 V; times a gain.
constexpr char studied_stage[] = R"({
  "format": 1, "title": "Stage",
  "blocks": {
    "drive": {"type": "sine", "amplitude": "3 V", "offset": "1 V", "frequency": "5 Hz"},
    "limit": {"type": "saturation", "lower": "0 V", "upper": "3 V", "in": "drive"},
    "gain":  {"type": "gain", "gain": "2 um/V", "in": "limit"}
  },
  "outputs": {"y": "gain"}, "simulate": {"until": "0.2 s", "every": "1 ms", "solver": {"method": "rk4", "step": "1 ms"}}
})";

std::string job(const std::string& counts, const std::string& more = "", const std::string& method = "uniform") {
  return R"({
  "format": 1, "do": "study", "title": "Limits", "diagram": "stage.json",
  "sample": {"method": ")" +
         method + R"(", "seed": 5, )" + counts + R"(,
             "parameters": {"limit.upper": {"from": "-1 V", "to": "4 V"}, "gain.gain": {"from": "1 um/V", "to": "3 um/V"}}},
  "features": {"top": {"take": "max", "of": "y"}, "twice": {"product": ["top", 2]}},
  "filters": [{"feature": "top", "above": "2 um"}, {"feature": "gain.gain", "at_most": 2.5}])" +
         more + "}";
}

constexpr char plots[] = R"(,
  "plots": [{"title": "Tops", "x": {"feature": "top", "from": "0 um", "to": "12 um"}, "samples": "all", "bins": 6},
            {"x": "top", "bins": 7}, {"x": "limit.upper", "y": "top", "where": [{"feature": "top", "above": "4 um"}]}])";

class StudyVerb : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("stage.json", studied_stage);
    folder_.write("limits.json", job(R"("draws": 400, "shards": 5)", plots));
  }
  json result(const std::string& folder) const { return json::parse(folder_.read(folder + "/result.json")); }
  /// Everything that a study leaves, but for its shards.
  std::string bytes(const std::string& folder) const {
    return folder_.read(folder + "/study.h5") + folder_.read(folder + "/result.json") +
           folder_.read(folder + "/report.html");
  }
  Outcome done(const std::vector<std::string>& words) const {
    const Outcome outcome = hysteron(folder_.path(), words);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome;
  }
  const Folder folder_;
};

TEST_F(StudyVerb, ComputesShardsMergesThemAndSaysWhatCameOut) {
  const Outcome outcome = done({"study", "limits.json", "--csv"});
  EXPECT_NE(outcome.out.find("Limits: 400 draws"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("report: limits.study/report.html"), std::string::npos) << outcome.out;
  for (int k = 1; k <= 5; ++k) EXPECT_TRUE(folder_.has("limits.study/shards/" + std::to_string(k) + "-of-5.h5"));
  const json facts = result("limits.study")["facts"];
  EXPECT_EQ(facts["draws"], 400);
  const int accepted = facts["accepted"];
  // upper > 0 fails for a fifth of the draws; top = gain * upper (or 4 V) above 2 um and gain at most 2.5 um/V.
  EXPECT_NEAR(facts["filters"][1]["share"], 0.75, 4 * std::sqrt(0.75 * 0.25 / 400));
  int failed = 0;
  for (const auto& [code, n] : facts["failed"].items()) failed += n.get<int>();
  EXPECT_NEAR(failed, 80, 4 * 8);
  EXPECT_EQ(facts["columns"]["top"]["unit"], "um");
  EXPECT_GE(facts["columns"]["top"]["smallest"], 2.0);
  EXPECT_NE(outcome.out.find("could not be simulated"), std::string::npos) << outcome.out;

  const std::string csv = folder_.read("limits.study/study.csv");
  EXPECT_TRUE(csv.starts_with("draw,limit.upper [V],gain.gain [um/V],top [um],twice [um]\n")) << csv.substr(0, 200);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), accepted + 1);
  double total = 0, shown = 0;
  const json page = result("limits.study");
  json figures = page["answer"];  // the first two are what the first screen shows
  for (const auto& further : page["sections"][2]["figures"]) figures.push_back(further);
  for (const auto& n : figures[0]["curves"][0]["y"]) total += n.get<double>();
  EXPECT_EQ(total, 400 - failed);  // every draw that can be simulated has a top of 0 ... 12 um
  for (const auto& n : figures[1]["curves"][0]["y"]) shown += n.get<double>();
  EXPECT_EQ(shown, accepted);
  for (const auto& y : figures[2]["curves"][0]["y"]) EXPECT_GT(y.get<double>(), 4);
  EXPECT_EQ(schema::refuses("result", folder_.read("limits.study/result.json")), "");
}

TEST_F(StudyVerb, ShardsOneByOneInAnyOrderGiveTheSameBytesAsTheWholeCommand) {
  done({"study", "limits.json", "-o", "whole", "--threads", "1"});
  for (const char* shard : {"4/5", "1/5", "5/5", "2/5"})
    done({"study", "limits.json", "-o", "parts", "--shard", shard});
  const Outcome early = hysteron(folder_.path(), {"study", "limits.json", "-o", "parts", "--merge"});
  EXPECT_EQ(early.code, 2);
  EXPECT_NE(early.err.find("missing: 3"), std::string::npos) << early.err;
  EXPECT_NE(early.err.find("hysteron study limits.json -o parts --shard 3/5"), std::string::npos) << early.err;
  EXPECT_FALSE(folder_.has("parts/study.h5"));
  done({"study", "limits.json", "-o", "parts", "--shard", "3/5"});
  done({"study", "limits.json", "-o", "parts", "--merge"});
  EXPECT_TRUE(bytes("parts") == bytes("whole"));
}

TEST_F(StudyVerb, WithAFixedNumberOfDrawsTheNumberOfShardsChangesNothing) {
  folder_.write("sobol.json", job(R"("draws": 60)", plots, "sobol"));
  done({"study", "sobol.json", "-o", "a", "--shards", "1"});
  done({"study", "sobol.json", "-o", "b", "--shards", "7"});
  EXPECT_TRUE(bytes("a") == bytes("b"));
}

TEST_F(StudyVerb, DrawsUntilEnoughAreAcceptedAndGivesUpWhereNothingPasses) {
  folder_.write("some.json", job(R"("accepted": 50, "shards": 3)"));
  done({"study", "some.json"});
  EXPECT_EQ(result("some.study")["facts"]["accepted"], 50);
  const Outcome other = hysteron(folder_.path(), {"study", "some.json", "-o", "x", "--shard", "1/4"});
  EXPECT_EQ(other.code, 2);
  EXPECT_NE(other.err.find("--shard 1/3"), std::string::npos) << other.err;
  folder_.write("none.json", job(R"("accepted": 50, "give_up_after": 90, "shards": 3)", R"(, "keep": "accepted")"));
  std::string nothing = folder_.read("none.json");
  nothing.replace(nothing.find("\"2 um\""), 6, "\"1 m\"");
  folder_.write("none.json", nothing);
  const Outcome outcome = done({"study", "none.json"});
  EXPECT_NE(outcome.out.find("after 90 draws only 0 were found"), std::string::npos) << outcome.out;
  EXPECT_EQ(result("none.study")["facts"]["gave_up"], true);
}

TEST_F(StudyVerb, StartedAgainItKeepsWhatIsThereAndComputesWhatIsNotOfThisJob) {
  done({"study", "limits.json"});
  const std::string right = bytes("limits.study");
  const std::string second = "limits.study/shards/2-of-5.h5";
  const auto time = std::filesystem::last_write_time(folder_.path() + "/limits.study/shards/1-of-5.h5");
  std::filesystem::remove(folder_.path() + "/" + second);
  folder_.write("limits.study/shards/3-of-5.h5", "damaged");
  Outcome again = done({"study", "limits.json"});
  EXPECT_NE(again.out.find("3 of 5 shards were there already"), std::string::npos) << again.out;
  EXPECT_NE(again.out.find("1 shard was damaged"), std::string::npos) << again.out;
  EXPECT_EQ(std::filesystem::last_write_time(folder_.path() + "/limits.study/shards/1-of-5.h5"), time);
  EXPECT_TRUE(bytes("limits.study") == right);

  // Another diagram is another study, whatever the job says; its title is none.
  std::string changed = studied_stage;
  changed.replace(changed.find("\"Stage\""), 7, "\"Other\"");
  folder_.write("stage.json", changed);
  EXPECT_NE(done({"study", "limits.json"}).out.find("5 of 5 shards were there already"), std::string::npos);
  changed.replace(changed.find("\"5 Hz\""), 6, "\"6 Hz\"");
  folder_.write("stage.json", changed);
  const Outcome foreign = hysteron(folder_.path(), {"study", "limits.json", "--merge"});
  EXPECT_EQ(foreign.code, 2);
  EXPECT_NE(foreign.err.find("another study"), std::string::npos) << foreign.err;
  again = done({"study", "limits.json"});
  EXPECT_NE(again.out.find("was changed since"), std::string::npos) << again.out;
  EXPECT_FALSE(bytes("limits.study") == right);
  folder_.write("stage.json", studied_stage);
  done({"study", "limits.json"});
  EXPECT_TRUE(bytes("limits.study") == right);
}

TEST_F(StudyVerb, AFolderOfAStudyThatWasKilledAtItsVeryBeginningIsItsOwn) {
  std::filesystem::create_directories(folder_.path() + "/limits.study/shards");
  folder_.write("limits.study/shards/study.txt.aB3x9Z", "");
  done({"study", "limits.json"});
  EXPECT_FALSE(folder_.has("limits.study/shards/study.txt.aB3x9Z"));
}

TEST_F(StudyVerb, ARemarkChangesNothing) {
  done({"study", "limits.json", "-o", "out"});
  std::string text = folder_.read("limits.json");
  text.replace(text.find("\"take\": \"max\""), 13, "\"take\": \"max\", \"remark\": \"the highest\"");
  folder_.write("limits.json", text);
  const Outcome again = done({"study", "limits.json", "-o", "out"});
  EXPECT_NE(again.out.find("5 of 5 shards were there already"), std::string::npos) << again.out;
  EXPECT_NE(folder_.read("out/report.html").find("the highest"), std::string::npos);
}

TEST_F(StudyVerb, WhatAnotherProcessIsWritingIsNoLeftover) {
  done({"study", "limits.json", "-o", "out"});
  const std::string partial = "out/shards/1-of-5.h5.partial-abcdef";
  folder_.write(partial, "half");
  const int other = ::open((folder_.path() + "/" + partial).c_str(), O_RDWR | O_CLOEXEC);
  ASSERT_EQ(::flock(other, LOCK_EX | LOCK_NB), 0);
  done({"study", "limits.json", "-o", "out"});
  EXPECT_TRUE(folder_.has(partial));
  ::close(other);  // as when that process ends or is killed
  done({"study", "limits.json", "-o", "out"});
  EXPECT_FALSE(folder_.has(partial));
}

/// The file with one bit turned over inside the number that its shard's first accepted sample has.
void turn_a_bit(const Folder& folder, const std::string& file, double number) {
  std::string bytes = folder.read(file);
  const auto at = bytes.find(std::string(reinterpret_cast<const char*>(&number), sizeof number));
  ASSERT_NE(at, std::string::npos);
  bytes[at + 6] = static_cast<char>(bytes[at + 6] ^ 0x10);
  folder.write(file, bytes);
}

TEST_F(StudyVerb, AShardOfWhichABitWasTurnedOverIsNotMergedButComputedAnew) {
  done({"study", "limits.json", "--csv"});
  const std::string right = bytes("limits.study"), csv = folder_.read("limits.study/study.csv");
  const std::string row = csv.substr(csv.find('\n') + 1);
  turn_a_bit(folder_, "limits.study/shards/1-of-5.h5", std::stod(row.substr(row.find(',') + 1)));
  const Outcome merge = hysteron(folder_.path(), {"study", "limits.json", "--csv", "--merge"});
  EXPECT_EQ(merge.code, 2) << merge.out;
  EXPECT_NE(merge.err.find("these are damaged: 1"), std::string::npos) << merge.err;
  EXPECT_TRUE(bytes("limits.study") == right) << "the results are those of before";
  EXPECT_NE(done({"study", "limits.json", "--csv"}).out.find("1 shard was damaged"), std::string::npos);
  EXPECT_TRUE(bytes("limits.study") == right);
  EXPECT_EQ(folder_.read("limits.study/study.csv"), csv);
  done({"study", "limits.json"});
  EXPECT_FALSE(folder_.has("limits.study/study.csv")) << "of an earlier command that wanted it";
}

TEST_F(StudyVerb, AShardOfAnEarlierVersionIsMergedAndSaysSo) {
  done({"study", "limits.json"});
  const std::string right = bytes("limits.study");
  const std::string shard = folder_.read("limits.study/shards/2-of-5.h5");
  folder_.write("limits.study/shards/2-of-5.h5", shard.substr(0, shard.rfind("\nhysteron digest ")));
  const Outcome again = done({"study", "limits.json"});
  EXPECT_NE(again.out.find("5 of 5 shards were there already"), std::string::npos) << again.out;
  EXPECT_NE(again.out.find("1 shard was written by an earlier version"), std::string::npos) << again.out;
  EXPECT_TRUE(bytes("limits.study") == right);
}

TEST_F(StudyVerb, FilesOfTheUserInItsFolderAreNotTouched) {
  done({"study", "limits.json"});
  for (const char* name : {"notes.txt", "mine.h5.partial-old", "shards/mine.h5.partial-old", "shards/1-of-5.h5.bak"})
    folder_.write(std::string("limits.study/") + name, "mine");
  done({"study", "limits.json"});
  for (const char* name : {"notes.txt", "mine.h5.partial-old", "shards/mine.h5.partial-old", "shards/1-of-5.h5.bak"})
    EXPECT_EQ(folder_.read(std::string("limits.study/") + name), "mine");
}

TEST_F(StudyVerb, AFolderThatIsNotItsOwnIsLeftAlone) {
  folder_.write("mine/notes.txt", "keep");
  const Outcome outcome = hysteron(folder_.path(), {"study", "limits.json", "-o", "mine"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("choose another folder with -o"), std::string::npos) << outcome.err;
  EXPECT_FALSE(folder_.has("mine/shards"));
  const Outcome file = hysteron(folder_.path(), {"study", "limits.json", "-o", "stage.json"});
  EXPECT_EQ(file.code, 2);
  EXPECT_EQ(folder_.read("stage.json"), studied_stage);
}

TEST_F(StudyVerb, AllDrawsAreKeptWhereThatIsAskedFor) {
  folder_.write("all.json", job(R"("draws": 50)",
                                R"(, "keep": "all", "plots": [{"x": "limit.upper", "y": "top", "samples": "all"}])"));
  done({"study", "all.json", "--csv"});
  const std::string csv = folder_.read("all.study/study.csv");
  EXPECT_TRUE(csv.starts_with("draw,accepted,limit.upper [V],")) << csv.substr(0, 100);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 51);
}

TEST_F(StudyVerb, ValuesThatABlockRefusesAreSimulatedWhereAskedFor) {
  folder_.write("all.json", job(R"("draws": 400, "shards": 5)", R"(, "refused": "simulated")"));
  done({"study", "all.json"});
  // an upper limit below the lower one holds the output there: top = gain * upper below 0, which a filter rejects
  EXPECT_TRUE(result("all.study")["facts"]["failed"].empty());
}

TEST_F(StudyVerb, SaysWhetherSamplesGoSideBySideOrWhatKeepsThemApart) {
  const auto how = [&](const std::string& folder) { return result(folder)["sections"][0]["text"].dump(); };
  done({"study", "limits.json"});
  EXPECT_NE(how("limits.study").find("side by side"), std::string::npos) << how("limits.study");
  std::string late = studied_stage, text = job(R"("draws": 20)");
  late.replace(late.find("\"in\": \"drive\""), 13, "\"in\": \"wait\"");
  late.replace(late.find("\"limit\":"), 8,
               "\"wait\": {\"type\": \"dead_time\", \"delay\": \"3 ms\", \"in\": \"drive\"}, \"limit\":");
  folder_.write("late.json", late);
  text.replace(text.find("stage.json"), 10, "late.json");
  folder_.write("apart.json", text);
  done({"study", "apart.json"});
  EXPECT_NE(how("apart.study").find("one after the other: dead_time"), std::string::npos) << how("apart.study");
}

TEST_F(StudyVerb, WrongInputIsToldWithFileAndLine) {
  const auto problem = [&](const std::string& text) {
    folder_.write("wrong.json", text);
    const Outcome outcome = hysteron(folder_.path(), {"study", "wrong.json", "--errors", "json"});
    EXPECT_EQ(outcome.code, 2);
    EXPECT_FALSE(folder_.has("wrong.study"));
    const json p = json::parse(outcome.err)["problems"][0];
    EXPECT_FALSE(p["cure"].get<std::string>().empty());
    return p["code"].get<std::string>() + " " + p["path"].get<std::string>() + " " + std::to_string(p.value("line", 0));
  };
  std::string text = job(R"("draws": 9)");
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string changed = text;
    return changed.replace(changed.find(from), from.size(), to);
  };
  EXPECT_EQ(problem(with("\"limit.upper\"", "\"limit.uper\"")), "unknown_parameter /sample/parameters/limit.uper 4");
  EXPECT_EQ(problem(with("\"4 V\"", "\"4 um\"")), "wrong_unit /sample/parameters/limit.upper/to 4");
  EXPECT_EQ(problem(with("\"of\": \"y\"", "\"of\": \"z\"")), "unknown_signal /features/top/of 5");
  EXPECT_EQ(problem(with("\"2 um\"", "\"2 V\"")), "wrong_unit /filters/0/above 6");
  EXPECT_EQ(problem(with("\"twice\"", "\"draw\"")), "bad_name /features/draw 5");
  EXPECT_EQ(problem(with("\"max\", \"of\": \"y\"", "\"at\", \"of\": \"y\", \"at\": \"7 s\"")),
            "bad_value /features/top/at 5");
  EXPECT_EQ(problem(with("\"max\", \"of\": \"y\"", "\"max\", \"of\": \"y\", \"between\": [\"0.1 s\", \"9 s\"]")),
            "bad_value /features/top/between/1 5");
  EXPECT_EQ(problem(with("\"title\"", "\"set\": {\"gain.gian\": 3}, \"titel\"")), "unknown_key /titel 2");
  EXPECT_EQ(problem(with("\"do\": \"study\"", "\"do\": \"fit\"")), "other_job /do 2");
  EXPECT_EQ(problem(with("\"title\"", "\"set\": {\"limiter.upper\": 3}, \"title\"")),
            "unknown_block /set/limiter.upper 2");
  for (const char* shard : {"0/5", "6/5", "3", "a/b", "1/5x"}) {
    const Outcome outcome = hysteron(folder_.path(), {"study", "limits.json", "--shard", shard});
    EXPECT_EQ(outcome.code, 2) << shard;
    EXPECT_NE(outcome.err.find("--shard 3/16"), std::string::npos) << outcome.err;
  }
  EXPECT_EQ(hysteron(folder_.path(), {"study", "limits.json", "--shard", "1/5", "--merge"}).code, 2);
  EXPECT_EQ(hysteron(folder_.path(), {"study", "limits.json", "--threads", "0"}).code, 2);
  const Outcome fit = hysteron(folder_.path(), {"fit", "limits.json"});
  EXPECT_NE(fit.err.find("hysteron study"), std::string::npos) << fit.err;
}

std::string text_of(const std::string& file) {
  std::ifstream in(std::string(HYSTERON_SOURCE_DIR) + "/" + file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

TEST_F(StudyVerb, TheExampleOfTheDocumentationRuns) {
  folder_.write("stage.json", text_of("diagrams/study/stage.json"));
  folder_.write("tolerance.json", text_of("diagrams/study/tolerance.json"));
  const std::string page = text_of("docs/study.md");
  const auto begin = page.find("```json\n") + 8;
  folder_.write("shown.json", page.substr(begin, page.find("```", begin) - begin));
  for (const char* name : {"tolerance", "shown"}) {
    const Outcome outcome = done({"study", std::string(name) + ".json"});
    EXPECT_NE(outcome.out.find("2000 draws"), std::string::npos) << outcome.out;
    const json facts = result(std::string(name) + ".study")["facts"];
    EXPECT_GT(facts["accepted"], 100) << name;
    EXPECT_LT(facts["accepted"], 1900) << name;
  }
}

/// A study whose shards take some tens of milliseconds each.
std::string slow_job() {
  std::string text = job(R"("draws": 20000, "shards": 12)", plots);
  return text.replace(text.find("\"do\""), 4, "\"until\": \"2 s\", \"do\"");
}

TEST_F(StudyVerb, CtrlCSaysWhatIsKeptAndTheSameCommandGoesOn) {
  folder_.write("slow.json", job(R"("draws": 10000000, "shards": 4000)"));
  // On a slow machine, or under a sanitizer, the study has not begun yet: then later.
  Outcome outcome;
  for (int milliseconds = 400; milliseconds < 20000; milliseconds *= 2) {
    outcome = hysteron(folder_.path(), {"study", "slow.json"}, "", milliseconds);
    ASSERT_EQ(outcome.code, 130) << outcome.err;
    if (outcome.err.find("what was not finished is not written") == std::string::npos) break;
  }
  EXPECT_NE(outcome.err.find("of 4000 shards are finished and kept in slow.study/shards"), std::string::npos)
      << outcome.err;
  EXPECT_FALSE(folder_.has("slow.study/study.h5"));
}

/// Computes slow.json, then kills it at random moments between its start and its end, so many times in all; every study
/// that comes to its end must be the same.
void kill_often(const Folder& folder, int times) {
  const auto all_of = [&](const std::string& out) {
    return folder.read(out + "/study.h5") + folder.read(out + "/result.json") + folder.read(out + "/report.html");
  };
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_EQ(hysteron(folder.path(), {"study", "slow.json", "-o", "right"}).code, 0);
  const auto took = std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::steady_clock::now() - begin);
  const std::string right = all_of("right");
  std::mt19937 random(20);
  int kills = 0, study = 0;
  bool finished = false;
  while (kills < times || !finished) {
    const std::string out = "killed" + std::to_string(study);
    const std::vector<std::string> words{"study", "slow.json", "-o", out};
    const Outcome outcome = kills < times
                                ? hysteron_killed(folder.path(), words,
                                                  1 + static_cast<int>(random() % static_cast<unsigned>(took.count())))
                                : hysteron(folder.path(), words);
    kills += outcome.code == 137 ? 1 : 0;
    finished = outcome.code != 137;
    if (!finished) continue;
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    ++study;
    EXPECT_TRUE(all_of(out) == right) << out;
    int files = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path() + "/" + out))
      files += entry.is_regular_file() ? 1 : 0;
    EXPECT_EQ(files,
              12 + 1 + 4);  // shards, whose they are, study.h5, report, result and its schema: nothing is left over
  }
}

TEST_F(StudyVerb, KilledAndStartedAgainItGivesTheSameBytes) {
  folder_.write("slow.json", slow_job());
  kill_often(folder_, 4);
}

class LongStudyVerb : public StudyVerb {};

TEST_F(LongStudyVerb, KilledFiftyTimesAtRandomMomentsItGivesTheSameBytes) {
  folder_.write("slow.json", slow_job());
  kill_often(folder_, 50);
}

}  // namespace
}  // namespace hysteron
