// What the program says to programs: one object per verb with --json, which its schema accepts; failures; progress.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <sstream>

#include "tests/app/cli/verb_lines.h"
#include "tests/app/lab_test.h"
#include "tests/app/schema_check.h"

namespace hysteron {
namespace {

using nlohmann::json;
using process::hysteron;
using process::Outcome;
using verb_lines::Words;

class AnswerJson : public LabTest {
 protected:
  void SetUp() override { verb_lines::furnish(folder_); }
};

/// The verbs that the program names when it is called without words.
Words verbs_of(const std::string& overview) {
  Words verbs;
  std::istringstream text(overview.substr(overview.find("Subcommands:")));
  std::string line;
  std::getline(text, line);
  while (std::getline(text, line) && line.starts_with("  ")) {
    std::istringstream words(line);
    std::string verb;
    words >> verb;
    if (line[2] != ' ') verbs.push_back(verb);
  }
  return verbs;
}

/// The studio says its object when it is ended by Ctrl-C, once it is open.
Outcome studio_ended(const std::string& folder) {
  return process::shell(folder,
                        "hysteron studio --no-browser --json > said & studio=$!\n"
                        "while [ ! -e .hysteron/studio.json ] && kill -0 $studio 2>/dev/null; do sleep 0.02; done\n"
                        "kill -INT $studio 2>/dev/null; wait $studio; code=$?; cat said; exit $code");
}

TEST_F(AnswerJson, TheStudioSaysWhereItWas) {
  const Outcome outcome = studio_ended(folder_.path());
  if (outcome.err.find("\"no_page\"") != std::string::npos) GTEST_SKIP() << "built without the page of the studio";
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(schema::refuses("studio.answer", outcome.out), "") << outcome.out;
  EXPECT_FALSE(folder_.has(".hysteron/studio.json")) << "the address goes with the studio";
}

TEST_F(AnswerJson, EveryVerbSaysOneObjectThatItsSchemaAccepts) {
  const Words verbs = verbs_of(hysteron(folder_.path(), {}).out);
  EXPECT_GE(verbs.size(), 18U);
  for (const auto& verb : verbs) {
    if (verb == "studio") continue;  // TheStudioSaysWhereItWas
    ASSERT_TRUE(verb_lines::all().contains(verb)) << "no command line is tried of the verb " << verb;
    for (const auto& line : verb_lines::all().at(verb)) {
      Words words{verb};
      words.insert(words.end(), line.begin(), line.end());
      words.emplace_back("--json");
      const Outcome outcome = hysteron(folder_.path(), words);
      SCOPED_TRACE(fmt::format("{}", fmt::join(words, " ")));
      EXPECT_LE(outcome.code, 1) << outcome.err;
      EXPECT_EQ(schema::refuses(verb + ".answer", outcome.out), "") << outcome.out;
      const json answer = json::parse(outcome.out, nullptr, false);
      ASSERT_TRUE(answer.is_object()) << outcome.out;
      EXPECT_EQ(answer["exit_code"], outcome.code);
      for (const auto& file : answer["files"]) {
        const std::filesystem::path path = file.get<std::string>();
        EXPECT_TRUE(std::filesystem::exists(path.is_absolute() ? path : folder_.path() / path)) << path;
      }
    }
  }
}

TEST_F(AnswerJson, WhatIsSaidIsWhatIsInTheFolder) {
  const Words words{"run", "diagram.json", "--data", "a.csv", "-o", "out/"};
  const Outcome people = hysteron(folder_.path(), words);
  EXPECT_EQ(people.out.find('{'), std::string::npos) << people.out;
  Words for_programs = words;
  for_programs.emplace_back("--json");
  const json answer = json::parse(hysteron(folder_.path(), for_programs).out);
  const json kept = result("out");
  EXPECT_EQ(answer["headline"], kept["headline"]);
  EXPECT_EQ(answer["warnings"], kept["warnings"]);
  EXPECT_EQ(answer["facts"]["traces"], kept["facts"]["traces"]);
  EXPECT_EQ(answer["result"], "out/result.json");
}

TEST_F(AnswerJson, AFailureIsOneObjectOnTheErrorStream) {
  for (const Words& words : {Words{"check", "nothing.json", "--json"}, Words{"check", "--jsn", "--json"},
                             Words{"explain", "diagram.json", "-o", "diagram.json", "--json"},
                             Words{"check", "diagram.json", "--data", "nothing.csv", "--json"}}) {
    const Outcome outcome = hysteron(folder_.path(), words);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(schema::refuses("failure", outcome.err), "") << outcome.err;
    EXPECT_EQ(json::parse(outcome.err)["exit_code"], 2);
  }
  const Outcome text = hysteron(folder_.path(), {"check", "nothing.json", "--json", "--errors", "text"});
  EXPECT_EQ(text.err.find('{'), std::string::npos) << text.err;
}

TEST_F(AnswerJson, WhatWasSaidBeforeAFailureIsSaidToPeopleOnly) {
  const Words words{"check", "diagram.json", "--data", "nothing.csv"};
  const Outcome outcome = hysteron(folder_.path(), words);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_TRUE(outcome.out.starts_with("diagram.json: ok")) << outcome.out;
}

TEST_F(AnswerJson, NotesOnTheWayAreAmongTheWarnings) {
  const Outcome outcome = hysteron(folder_.path(), {"check", "lag.json", "--set", "first.gain=3", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  ASSERT_TRUE(outcome.err.starts_with("note: ")) << outcome.err;
  const json warnings = json::parse(outcome.out)["warnings"];
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ("note: " + warnings[0].get<std::string>() + "\n", outcome.err);
}

/// The events of --progress json; every line is one.
std::vector<json> events_of(const std::string& err) {
  std::vector<json> events;
  std::istringstream lines(err);
  for (std::string line; std::getline(lines, line);) {
    EXPECT_EQ(schema::refuses("progress", line), "") << line;
    events.push_back(json::parse(line));
  }
  return events;
}

TEST_F(AnswerJson, ProgressIsALinePerEventAndEndsWithAll) {
  for (const Words& words :
       {Words{"run", "stage.json", "--until", "0.2 s", "--progress", "json"},
        Words{"run", "stage.json", "--until", "0.2 s", "--progress", "json", "--quiet", "--json", "-o", "out"}}) {
    const Outcome outcome = hysteron(folder_.path(), words);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const auto events = events_of(outcome.err);
    ASSERT_GE(events.size(), 2U) << "the first event comes at once, the last when all is done\n" << outcome.err;
    double before = 0;
    for (const auto& event : events) {
      EXPECT_GE(event["fraction"].get<double>(), before) << outcome.err;
      before = event["fraction"];
    }
    EXPECT_EQ(std::count_if(events.begin(), events.end(), [](const json& e) { return e["fraction"] == 1; }), 1);
    EXPECT_EQ(events.back(), json::parse(R"({"fraction": 1.0, "what": "done", "seconds_left": 0.0})"));
  }
  EXPECT_EQ(hysteron(folder_.path(), {"run", "stage.json", "--until", "0.2 s"}).err, "") << "no terminal is there";
}

TEST_F(AnswerJson, WordsThatAreNoFormAreRefused) {
  for (const char* option : {"--progress", "--errors"})
    EXPECT_EQ(hysteron(folder_.path(), {"check", "diagram.json", option, "xml"}).code, 2) << option;
}

}  // namespace
}  // namespace hysteron
