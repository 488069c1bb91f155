// The shipped demonstration, as scripts/demo runs it: named, fitted, told; interrupted; opened in a browser.
#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/app/hysteron_process.h"
#include "tests/app/schema_check.h"
#include "tests/report/browser.h"

namespace hysteron {
namespace {

using nlohmann::json;
using process::Folder;
using process::hysteron;
using process::Outcome;

const std::string demo = std::string(HYSTERON_SOURCE_DIR) + "/diagrams/discover/demo/";

std::vector<std::string> words(const std::string& verb, const std::string& out) {
  return {verb, demo + "stage.json", "--data", demo + "dataset.json", "-o", out};
}

void expect_the_answer(const json& all) {
  EXPECT_EQ(all["verdict"], "missing_effect");
  EXPECT_EQ(all["facts"]["effects"], json({"creep"}));
  // README of the demonstration: 61 nm without it, noise floor 0.23439 nm; at most 1.15 times the floor is asked for.
  EXPECT_NEAR(all["facts"]["as_given"]["rms_validate"].get<double>(), 0.06122, 0.0005);
  EXPECT_LE(all["facts"]["final"]["rms_validate"].get<double>(), 1.15 * 0.23439e-3);
  EXPECT_EQ(all["facts"]["final"]["unit"], "um");
}

void expect_it_is_printed(const std::string& out) {
  EXPECT_NE(out.find("creep"), std::string::npos) << out;
  EXPECT_NE(out.find("61.2 nm -> 0.23"), std::string::npos) << out;
  // The last words are the answer.
  EXPECT_NE(out.find("report: out/report.html\nMissing: creep. "), std::string::npos) << out;
}

void expect_steps_that_run_by_hand(const Folder& folder) {
  for (const char* file : {"out/base.json", "out/step1_creep.json", "out/final.json"})
    EXPECT_TRUE(folder.has(file)) << file;
  const Outcome after = hysteron(folder.path(), {"compare", "out/final.json", "--data", demo + "dataset.json", "-o",
                                                 "after", "--tolerance", "0.27 nm"});
  EXPECT_EQ(after.code, 0) << after.out << after.err;
}

void expect_a_page_that_a_browser_draws(const std::string& file) {
  const std::string page = browser::dump_dom(file);
  ASSERT_FALSE(page.empty());
  EXPECT_NE(page.find("data-errors=\"0\""), std::string::npos) << file;
  EXPECT_NE(page.find("data-drawn=\"true\""), std::string::npos) << file;
  EXPECT_EQ(page.find("data-drawn=\"false\""), std::string::npos) << file;
  EXPECT_NE(page.find("creep"), std::string::npos) << file;
}

const json& section(const json& all, const std::string& title) {
  static const json none = json::object();
  for (const auto& s : all["sections"])
    if (s["title"].get<std::string>().starts_with(title)) return s;
  ADD_FAILURE() << "no section " << title;
  return none;
}

/// The waterfall against its floor, and the residual of the one step, before and after, on the same axes.
void expect_the_error_is_seen_to_fall(const json& all) {
  const json& steps = section(all, "The error, step by step");
  const json& bars = steps["figures"][0]["bars"];
  EXPECT_EQ(steps["figures"][0]["kind"], "waterfall");
  EXPECT_EQ(steps["figures"][0]["y_label"], "RMS [nm]");
  EXPECT_EQ(bars.front()["label"], "as given");
  EXPECT_NEAR(bars.front()["value"].get<double>(), 61.22, 0.5);  // as in expect_the_answer
  for (const auto& bar : bars) {  // each is told in the unit of the axis, to three digits
    const auto text = bar["text"].get<std::string>();
    EXPECT_NEAR(std::stod(text), bar["value"].get<double>(), 0.005 * bar["value"].get<double>()) << text;
    EXPECT_EQ(text.substr(text.find(' '), 3), " nm") << text;
  }
  EXPECT_EQ(bars.back()["role"], "floor");
  const json& residual = steps["figures"].back();
  EXPECT_TRUE(residual["title"].get<std::string>().starts_with("Step 1, creep: residual of")) << residual["title"];
  ASSERT_EQ(residual["curves"].size(), 2U);
  EXPECT_EQ(residual["curves"][0]["role"], "before");
  EXPECT_EQ(residual["curves"][1]["role"], "after");
  const json& parameters = section(all, "Parameters")["tables"][0];
  EXPECT_EQ(parameters["columns"], json({"parameter", "value", "95 % interval", "start", "usual", "remark"}));
  EXPECT_EQ(parameters["rows"][0][4], "at most 0.05");  // half of the 0.1 per decade of soft ceramics
}

/// What compare says of the user's diagram stands among the first sentences, its shares in the facts.
void expect_where_it_failed_is_told(const json& all) {
  const auto sentences = all["sentences"].get<std::vector<std::string>>();
  ASSERT_GE(sentences.size(), 2U);
  EXPECT_TRUE(sentences[1].starts_with("Before: ")) << sentences[1];
  EXPECT_NE(sentences[1].find("of the squared error lies"), std::string::npos) << sentences[1];
  ASSERT_FALSE(all["facts"]["splits_before"].empty());
  for (const auto& split : all["facts"]["splits_before"]) {
    double sum = 0;
    for (const auto& part : split["parts"]) sum += part["share_of_squared_error"].get<double>();
    EXPECT_NEAR(sum, 1, 1e-9) << split;
  }
  EXPECT_EQ("Before: " + all["facts"]["splits_before"][0]["sentence"].get<std::string>() + ".", sentences[1]);
}

/// Every curve of every figure comes from a recording that is not a train recording.
void expect_no_figure_shows_what_was_fitted(const json& all) {
  std::set<std::string> fitted, drawn;
  for (const auto& r : all["facts"]["final"]["recordings"])
    if (r["role"] == "train") fitted.insert(r["recording"]);
  EXPECT_FALSE(fitted.empty());
  for (const auto& s : all["sections"])
    for (const auto& f : s.value("figures", json::array()))
      for (const auto& c : f.value("curves", json::array()))
        if (c.contains("trace")) drawn.insert(c["trace"]);
  EXPECT_FALSE(drawn.empty());
  for (const auto& name : drawn) EXPECT_FALSE(fitted.contains(name)) << name;
}

/// The new block is set off in the picture after, and there is none before.
void expect_pictures_before_and_after(const Folder& folder, const json& all) {
  if (!folder.has("out/final.svg")) GTEST_SKIP() << "no Graphviz on this machine";
  const json& change = section(all, "The diagram, before and after");
  EXPECT_EQ(change["figures"][0]["picture"], "base.svg");
  EXPECT_EQ(change["figures"][1]["picture"], "final.svg");
  const std::string block = all["facts"]["steps"][0]["block"];
  EXPECT_EQ(folder.read("out/base.svg").find("\"block new\""), std::string::npos);
  EXPECT_NE(folder.read("out/final.svg").find("class=\"block new\" data-block=\"" + block + "\""), std::string::npos);
  EXPECT_NE(change["preformatted"]["text"].get<std::string>().find("+    \"" + block + "\""), std::string::npos);
}

// One test, because a discovery takes seconds and every test is a process of its own.
TEST(Demo, NamesCreepReachesTheNoiseOnOtherRecordingsAndTellsIt) {
  const Folder folder;
  const Outcome outcome = hysteron(folder.path(), words("discover", "out"));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  expect_the_answer(json::parse(folder.read("out/result.json")));
  EXPECT_EQ(schema::refuses("result", folder.read("out/result.json")), "");
  EXPECT_EQ(schema::refuses("diagram", folder.read("out/final.json")), "");
  expect_it_is_printed(outcome.out);
  expect_steps_that_run_by_hand(folder);
  const json all = json::parse(folder.read("out/result.json"));
  expect_the_error_is_seen_to_fall(all);
  expect_where_it_failed_is_told(all);
  expect_no_figure_shows_what_was_fitted(all);
  expect_pictures_before_and_after(folder, all);
  if (browser::find().empty()) GTEST_SKIP() << "no Chromium on this machine (scripts/test installs one)";
  expect_a_page_that_a_browser_draws(folder.path() + "/out/report.html");
}

TEST(DemoInterrupted, EndsWith130AndSaysWhatWasKept) {
  for (const int after : {1500, 700, 300}) {  // [ms]; a fast machine is done before the first
    const Folder folder;
    const Outcome outcome = hysteron(folder.path(), words("discover", "out"), "", after);
    if (outcome.code == 0) continue;
    EXPECT_EQ(outcome.code, 130) << outcome.err;
    EXPECT_NE(outcome.err.find("interrupted"), std::string::npos) << outcome.err;
    // Whole or absent: either nothing but the working folder, or a folder with everything in it.
    for (const auto& entry : folder.entries()) EXPECT_EQ(entry, "out/");
    if (folder.has("out")) {
      EXPECT_TRUE(folder.has("out/report.html"));
      EXPECT_NE(folder.read("out/result.json").find("Interrupted"), std::string::npos);
    }
    return;
  }
  FAIL() << "the discovery is done within 0.3 s: interrupt it earlier";
}

}  // namespace
}  // namespace hysteron
