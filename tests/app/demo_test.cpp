// The shipped demonstration, as scripts/demo runs it: named, fitted, told; interrupted; opened in a browser.
#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

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
  EXPECT_NE(out.find("0.0612"), std::string::npos) << out;
  EXPECT_TRUE(out.ends_with("missing_effect: out/report.html\n")) << out;
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
  if (browser::find().empty()) GTEST_SKIP() << "no Chromium on this machine (scripts/test installs one)";
  expect_a_page_that_a_browser_draws(folder.path() + "/out/report.html");
}

TEST(DemoInterrupted, EndsWith130AndSaysWhatWasKept) {
  const Folder folder;
  const Outcome outcome = hysteron(folder.path(), words("discover", "out"), "", 1500);
  if (outcome.code == 0) GTEST_SKIP() << "the discovery was done before it could be interrupted";
  EXPECT_EQ(outcome.code, 130) << outcome.err;
  EXPECT_NE(outcome.err.find("interrupted"), std::string::npos) << outcome.err;
  // Whole or absent: either nothing but the working folder, or a folder with everything in it.
  for (const auto& entry : folder.entries()) EXPECT_EQ(entry, "out/");
  if (folder.has("out")) {
    EXPECT_TRUE(folder.has("out/report.html"));
    EXPECT_NE(folder.read("out/result.json").find("Interrupted"), std::string::npos);
  }
}

}  // namespace
}  // namespace hysteron
