// Recordings that are dropped on the page: kept aside, looked at, and then a diagram of their own or part of a data
// set. The verb new is a stand-in of the test; how it reads is tested where it lives.
#include "studio/import.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>

#include "engine/diagram/error.h"
#include "tests/io/temporary_folder.h"

namespace hysteron::studio {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const JobVerb verb_new{
    "new", {{"--from", false, true}, {"-o", false, false}, {"--time", false, false}, {"--unit", false, true}}};

class StudioImport : public testing::Test {
 protected:
  StudioImport() : open_(folder_.path()), import_(open_, verb_new, own()) {}

  OwnVerbs own() {
    return {[this](const std::vector<std::string>& words, const OwnVerbs::Stop&) {
              words_ = words;
              fs::create_directories(target());
              std::ofstream(target() + "/lab.csv") << "t [s],y [um]\n0,1\n";
              std::ofstream(target() + "/diagram.json") << "{}";
              std::ofstream(target() + "/dataset.json") << "{}";
              return VerbAnswer{R"({"diagram": "d", "assumed": ["a straight line"]})", "", {}};
            },
            [this](const std::vector<std::string>& words) {
              words_ = words;
              return preview_;
            }};
  }
  std::string target() const {
    const auto option = std::find(words_.begin(), words_.end(), "-o");
    return option == words_.end() ? "" : *(option + 1);
  }
  bool has_word(const std::string& word) const { return std::find(words_.begin(), words_.end(), word) != words_.end(); }
  static std::string code_of(const std::function<void()>& action) {
    try {
      action();
    } catch (const Error& error) {
      return error.problems.front().code;
    }
    return "";
  }

  TemporaryFolder folder_;
  OpenFolder open_;
  std::vector<std::string> words_;
  RecordingPreview preview_;
  Import import_;
};

TEST_F(StudioImport, KeepsWhatIsDroppedAsideUnderItsOwnName) {
  const std::string bytes("t [s]\0\xff\n", 8);
  EXPECT_EQ(import_.keep("lab.csv", bytes), ".hysteron/dropped/lab.csv");
  EXPECT_EQ(TemporaryFolder::read(folder_.path(".hysteron/dropped/lab.csv")), bytes);
  EXPECT_EQ(TemporaryFolder::read(folder_.path(".hysteron/.gitignore")), "*\n") << "git overlooks it";
  EXPECT_EQ(import_.keep("../../other/lab.csv", "x"), ".hysteron/dropped/lab.csv") << "a way in the name leads nowhere";
  for (const char* name : {"", ".", "..", "a/.hidden", "line\nbreak.csv"})
    EXPECT_EQ(code_of([&] { (void)import_.keep(name, "x"); }), "bad_name") << name;
}

TEST_F(StudioImport, LooksAtARecordingWithTheAnswersOfTheUser) {
  preview_.raw.columns = {{"Zeit", "s", {0, 1}}, {"Weg", "", {std::numeric_limits<double>::quiet_NaN(), 2}}};
  preview_.table.columns = {{"t", parse_unit("s"), {0, 1}}, {"Weg", parse_unit("um"), {5, 2}}};
  preview_.inputs = {};
  preview_.outputs = {"Weg"};
  preview_.assumed = {"Zeit is the time"};
  preview_.questions = {{"unclear_columns", "lab.csv", "nothing drives", "say which column drives", "", 0}};
  const auto told = import_.preview({{"file", "lab.csv"}, {"options", {{"--time", "Zeit"}, {"--unit", {"Weg=um"}}}}});
  EXPECT_TRUE(has_word("--from=" + open_.path() + "/lab.csv"));
  EXPECT_TRUE(has_word("--time=Zeit"));
  EXPECT_TRUE(has_word("--unit=Weg=um"));
  EXPECT_EQ(told["raw"][1]["values"], json::array({nullptr, 2.0})) << "what the file does not have is null";
  EXPECT_EQ(told["columns"][1]["smallest"], 2.0);
  EXPECT_EQ(told["columns"][1]["largest"], 5.0);
  EXPECT_EQ(told["rows"], 2);
  EXPECT_EQ(told["to"], 1.0);
  EXPECT_EQ(told["outputs"], json::array({"Weg"}));
  EXPECT_EQ(told["questions"][0]["what"], "nothing drives");
}

TEST_F(StudioImport, TakesNoOptionThatTheStudioGivesItself) {
  for (const char* option : {"-o", "--from", "--nothing"})
    EXPECT_EQ(code_of([&] {
                (void)import_.preview({{"file", "lab.csv"}, {"options", {{option, "x"}}}});
              }),
              "bad_command_line")
        << option;
  EXPECT_EQ(code_of([&] { (void)import_.preview({{"file", "../lab.csv"}}); }), "outside_folder");
  EXPECT_EQ(code_of([&] { (void)import_.start({{"files", {"lab.csv"}}, {"folder", "../x"}}); }), "outside_folder");
}

TEST_F(StudioImport, StartsADiagramInAFolder) {
  const auto told = import_.start({{"files", {"a.csv", "b.csv"}}, {"folder", "stage"}});
  EXPECT_EQ(words_.front(), "new");
  EXPECT_TRUE(has_word("--from=" + open_.path() + "/b.csv"));
  EXPECT_EQ(target(), open_.path() + "/stage");
  EXPECT_EQ(told["diagram"], "stage/diagram.json");
  EXPECT_EQ(told["dataset"], "stage/dataset.json");
  EXPECT_EQ(told["assumed"][0], "a straight line");
  EXPECT_EQ(import_.start({{"files", {"a.csv"}}, {"folder", ""}})["diagram"], "diagram.json");
}

TEST_F(StudioImport, JoinsADataSetByOneLineMore) {
  (void)folder_.write("set/dataset.json", "{\n  \"recordings\": [\n    {\"file\": \"01.csv\"}\n  ]\n}\n");
  const json asked{{"file", ".hysteron/dropped/lab.csv"}, {"dataset", "set/dataset.json"}, {"role", "validate"}};
  EXPECT_EQ(import_.join(asked)["recording"], "set/lab.csv");
  EXPECT_EQ(
      TemporaryFolder::read(folder_.path("set/dataset.json")),
      "{\n  \"recordings\": [\n    {\"file\": \"01.csv\"},\n    {\"file\": \"lab.csv\", \"role\": \"validate\"}\n  ]\n}\n");
  EXPECT_TRUE(fs::exists(folder_.path("set/lab.csv")));
  EXPECT_FALSE(fs::exists(folder_.path(".hysteron/dropped/.made"))) << "nothing else is left";
}

TEST_F(StudioImport, OverwritesNoOtherRecordingAndLeavesTheDataSetThen) {
  const std::string before = "{\"recordings\": []}";
  (void)folder_.write("dataset.json", before);
  (void)folder_.write("lab.csv", "something else");
  const json asked{{"file", ".hysteron/dropped/lab.csv"}, {"dataset", "dataset.json"}, {"role", "train"}};
  EXPECT_EQ(code_of([&] { (void)import_.join(asked); }), "file_exists");
  EXPECT_EQ(TemporaryFolder::read(folder_.path("dataset.json")), before);
  EXPECT_EQ(TemporaryFolder::read(folder_.path("lab.csv")), "something else");
  json wrong = asked;
  wrong["role"] = "watch";
  EXPECT_EQ(code_of([&] { (void)import_.join(wrong); }), "bad_request");
}

}  // namespace
}  // namespace hysteron::studio
