// What `hysteron inspect data` and the first page of a diagnosis say of recordings.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/app/hysteron_process.h"
#include "tests/app/lab.h"
#include "tests/app/lab_test.h"
#include "tests/app/schema_check.h"

namespace hysteron {
namespace {

using nlohmann::json;
using process::hysteron;
using process::Outcome;

class InspectVerb : public LabTest {};

TEST_F(InspectVerb, InspectSaysWhatTheRecordingsCanAndCannotShow) {
  const Outcome outcome = hysteron(folder_.path(), {"inspect", "dataset.json", "--diagram", "diagram.json"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(outcome.out.starts_with("No problem found in the data.")) << outcome.out;
  EXPECT_NE(outcome.out.find("report: dataset.inspect/report.html"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("They cannot show thermal_expansion: no column of the recordings is a temperature"),
            std::string::npos)
      << outcome.out;
  // The first screen: what was driven, what was measured.
  const json answer = result("dataset.inspect")["answer"];
  ASSERT_GE(answer.size(), 2U);
  EXPECT_EQ(answer[0]["y_label"], "u [V]");
  EXPECT_EQ(answer[1]["y_label"], "y [um]");
  const json inspection = result("dataset.inspect")["facts"]["inspection"];
  EXPECT_EQ(inspection["recordings"].size(), 2U);
  EXPECT_EQ(inspection["columns"][0]["is"], "input");
  EXPECT_EQ(inspection["columns"][0]["unit"], "V");
  EXPECT_TRUE(inspection["faults"].empty());
  EXPECT_FALSE(inspection["cannot_show"].empty());
  EXPECT_EQ(schema::refuses("result", folder_.read("dataset.inspect/result.json")), "");
}

TEST_F(InspectVerb, InspectPrintsTheSameFactsAsJsonAndWritesNothing) {
  const auto before = folder_.entries();
  const Outcome outcome = hysteron(folder_.path(), {"inspect", "dataset.json", "--diagram", "diagram.json", "--json"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(folder_.entries(), before);
  const json facts = json::parse(outcome.out);
  hysteron(folder_.path(), {"inspect", "dataset.json", "--diagram", "diagram.json", "-o", "out"});
  for (const auto& [name, fact] : result("out")["facts"].items()) EXPECT_EQ(facts[name], fact) << name;
}

TEST_F(InspectVerb, RowsThatTheDataSetLeavesOutAreNoFaultOfIt) {
  // One reading of 1000 um among readings below 5 um, one second after the start.
  std::string spoilt = lab::noisy_recording(1);
  const auto row = spoilt.find("\n1.000,");
  ASSERT_NE(row, spoilt.npos) << spoilt.substr(0, 200);
  const auto end = spoilt.find('\n', row + 1), comma = spoilt.rfind(',', end);
  spoilt.replace(comma + 1, end - comma - 1, "1000");
  folder_.write("spoilt.csv", spoilt);
  const auto inspected = [&](const std::string& more) {
    folder_.write("set.json", R"({"format": 1, "title": "t", "recordings": [{"file": "spoilt.csv", "role": "train")" +
                                  more + R"(}, {"file": "b.csv", "role": "validate"}]})");
    const Outcome outcome = hysteron(folder_.path(), {"inspect", "set.json", "--diagram", "diagram.json", "-o", "out"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return result("out")["facts"]["inspection"];
  };
  const json whole = inspected(""), without = inspected(R"(, "exclude": [["0.99 s", "1.01 s"]])");
  EXPECT_NE(whole["faults"].dump().find("far from all others"), std::string::npos) << whole["faults"];
  EXPECT_TRUE(without["faults"].empty()) << without["faults"];
  EXPECT_LT(without["columns"][1]["highest"].get<double>(), 10) << without["columns"];
}

TEST_F(InspectVerb, InspectNeedsNoDiagramAndSaysWhatItAssumed) {
  const Outcome outcome = hysteron(folder_.path(), {"inspect", "a.csv", "-o", "out"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("No diagram was named"), std::string::npos) << outcome.out;
  const std::string assumed = result("out")["facts"]["assumed"].dump();
  EXPECT_NE(assumed.find("whether an output is a sample late or early"), std::string::npos) << assumed;
  const auto cure = assumed.find("--diagram");
  EXPECT_NE(cure, std::string::npos);
  EXPECT_EQ(assumed.find("--diagram", cure + 1), std::string::npos) << "the cure is said once";
  const json inspection = result("out")["facts"]["inspection"];
  ASSERT_EQ(inspection["recordings"].size(), 1U);  // cut for fitting, looked at as one
  EXPECT_EQ(inspection["recordings"][0]["rows"], 200);
}

TEST_F(InspectVerb, InspectSaysTheSameOfTheLevelsOfAColumnAndOfTheEffectThatTheyShow) {
  const std::string demo = std::string(HYSTERON_SOURCE_DIR) + "/diagrams/discover/demo/";
  const Outcome outcome =
      hysteron(folder_.path(), {"inspect", demo + "dataset.json", "--diagram", demo + "stage.json", "-o", "out"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const json inspection = result("out")["facts"]["inspection"];
  // README of the demonstration: 16 bits over 16 um, written with 0.01 nm.
  double step = 0;
  for (const auto& c : inspection["columns"])
    if (c["column"] == "y") step = c["finest_step"];
  EXPECT_NEAR(step, 0.000244141, 1e-7);
  bool quantization = false;
  for (const auto& e : inspection["can_show"]) quantization = quantization || e["effect"] == "quantization";
  EXPECT_TRUE(quantization);
  // At the stack, which carries a motion, and not at u, which no friction could enter.
  std::string why;
  for (const auto& e : inspection["cannot_show"])
    if (e["effect"] == "friction") why = e["reason"];
  EXPECT_NE(why.find("has memory already (stack)"), std::string::npos) << why;
}

TEST_F(InspectVerb, InspectTellsAGapOfTheClock) {
  std::string text = lab::recording();
  for (int k = 0; k < 2; ++k) {  // two rows in the middle
    const auto begin = text.find('\n', text.size() / 2) + 1;
    text.erase(begin, text.find('\n', begin) + 1 - begin);
  }
  folder_.write("a.csv", text);
  const Outcome outcome = hysteron(folder_.path(), {"inspect", "a.csv", "-o", "out"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("a.csv: 2 rows missing, in 1 gap of its clock"), std::string::npos) << outcome.out;
}

TEST_F(InspectVerb, InspectTellsColumnsThatNeverMove) {
  std::string still_output = "t [s],u [V],y [um]\n", still_input = still_output;
  for (int i = 0; i < 60; ++i) {
    still_output += std::to_string(0.01 * i) + "," + std::to_string(i % 7) + ",0.5\n";
    still_input += std::to_string(0.01 * i) + ",2," + std::to_string(i % 7) + "\n";
  }
  folder_.write("a.csv", still_output);
  const Outcome output = hysteron(folder_.path(), {"inspect", "a.csv", "-o", "output"});
  EXPECT_EQ(output.code, 0) << output.err;
  EXPECT_FALSE(output.out.starts_with("No problem found in the data.")) << output.out;
  EXPECT_NE(output.out.find("y never moves: it is 0.5 um in every row"), std::string::npos) << output.out;
  folder_.write("a.csv", still_input);
  const Outcome input = hysteron(folder_.path(), {"inspect", "a.csv", "-o", "input"});
  EXPECT_EQ(input.code, 0) << input.err;
  EXPECT_TRUE(input.out.starts_with("No problem found in the data.")) << input.out;
  EXPECT_NE(folder_.read("input/result.json").find("u never moves: it is 2 V in every row"), std::string::npos);
}

TEST_F(InspectVerb, DiagnoseTellsTheDataBehindTheError) {
  const Outcome outcome = hysteron(
      folder_.path(), {"diagnose", "diagram.json", "--data", "dataset.json", "-o", "out", "--only", "amplifier_lag"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const json told = result("out");
  EXPECT_EQ(told["sections"][0]["title"], "The error");
  EXPECT_TRUE(std::any_of(told["sections"].begin(), told["sections"].end(),
                          [](const json& section) { return section["title"] == "The data"; }));
  EXPECT_EQ(told["facts"]["inspection"]["recordings"].size(), 2U);
}

TEST_F(InspectVerb, ARecordingThatTrainsAndJudgesIsToldByEveryVerbThatJudges) {
  folder_.write("same.json", R"({"format": 1, "recordings": [{"file": "a.csv", "role": "train"},
                                                           {"file": "a.csv", "role": "validate"}]})");
  for (const auto& words : {std::vector<std::string>{"compare", "diagram.json", "--data", "same.json"},
                            {"inspect", "same.json", "--diagram", "diagram.json"},
                            {"diagnose", "diagram.json", "--data", "same.json", "--only", "amplifier_lag"}}) {
    auto all = words;
    all.insert(all.end(), {"-o", words.front()});
    ASSERT_EQ(hysteron(folder_.path(), all).code, 0) << words.front();
    const json warnings = result(words.front())["warnings"];
    EXPECT_NE(warnings.dump().find("has the same rows as a.csv, which trains"), std::string::npos) << warnings;
  }
}

}  // namespace
}  // namespace hysteron
