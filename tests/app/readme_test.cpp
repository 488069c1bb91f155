// The README is true: its diagrams run, and its commands do what stands below them.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>
#include <utility>

#include "tests/app/hysteron_process.h"
#include "tests/app/schema_check.h"
#include "tests/app/shown.h"
#include "tests/app/source_files.h"

namespace hysteron {
namespace {

using process::Folder;
using process::Outcome;
using shown::do_as_shown;
using shown::fences_of;
using sources::text_of;

TEST(Readme, ItsDiagramRunsAndItsCommandsPrintWhatItShows) {
  const std::string root = HYSTERON_SOURCE_DIR;
  const Folder folder;
  std::filesystem::create_directory_symlink(root + "/diagrams", folder.path() + "/diagrams");
  EXPECT_GE(shown::do_as_shown("README.md", folder, "first.json"), 5);
  EXPECT_TRUE(folder.has("first.json") && folder.has("axis.json")) << "a piezo and a motor";
}

TEST(Docs, TheDiagramThatTheyExplainRunsAndTheDataSetIsValid) {
  const std::string docs = std::string(HYSTERON_SOURCE_DIR) + "/docs/";
  const Folder folder;
  const auto first_json = [](const std::string& file) {
    for (const auto& fence : fences_of(file))
      if (fence.language == "json") return fence.text;
    return std::string();
  };
  folder.write("diagram.json", first_json(docs + "diagrams.md"));
  const Outcome outcome = process::hysteron(folder.path(), {"run", "diagram.json", "-o", "out"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(schema::refuses("diagram", folder.read("diagram.json")), "");
  EXPECT_EQ(schema::refuses("dataset", first_json(docs + "datasets.md")), "");
}

TEST(Docs, ACompensatorOfOnesOwnStageLowersTheTrackingErrorAsTheySay) {
  const Folder folder;
  do_as_shown("docs/compensate.md", folder);
  const auto error = [&](const std::string& run) {
    const auto result = nlohmann::json::parse(folder.read("error_" + run + "/result.json"));
    const auto& pair = result.at("facts").at("signals").at(0);
    return std::pair{pair.at("largest").get<double>(), pair.at("rms").get<double>()};
  };
  // The table of the page, to its last digit; the noise of 2 nm is the same each time.
  const auto expect = [&](const std::string& run, double largest, double rms, double digit) {
    EXPECT_NEAR(error(run).first, largest, digit) << run;
    EXPECT_NEAR(error(run).second, rms, digit) << run;
  };
  expect("open_none", 1.56, 0.93, 0.006);
  expect("open_pi", 0.40, 0.20, 0.006);
  expect("open_bw", 0.53, 0.39, 0.006);
  expect("closed_none", 0.125, 0.090, 0.0006);
  expect("closed_pi", 0.018, 0.006, 0.0006);
  expect("closed_bw", 0.018, 0.006, 0.0006);
}

TEST(Docs, TheControllerInCHasTheBitsThatThePageShows) {
  const Folder folder;
  do_as_shown("docs/export-c.md", folder);
  EXPECT_TRUE(folder.has("out/comp.json"));
}

TEST(Docs, TheExampleOfAFitRunsAndFindsWhatIsHidden) {
  const Folder folder;
  do_as_shown("docs/fit.md", folder);
  EXPECT_EQ(schema::refuses("job", folder.read("job.json")), "");
  EXPECT_EQ(schema::refuses("result", folder.read("job.fit/result.json")), "");
  const auto facts = nlohmann::json::parse(folder.read("job.fit/result.json"))["facts"];
  // What device.json hides; the scale of all is that of the prior, 12 N/V give or take 4 %, so ratios are judged.
  double gain = 0, empty = 0, loaded = 0, stiffness = 0, damping = 0;
  for (const auto& p : facts["parameters"]) {
    const double value = p["value"].get<double>();
    if (p["parameter"] == "motor.gain") gain = value;
    if (p["parameter"] == "stage.mass") (p["recording"] == "empty/traces/signals.csv" ? empty : loaded) = value;
    if (p["parameter"] == "stage.stiffness") stiffness = value;
    if (p["parameter"] == "stage.damping") damping = value;
    EXPECT_TRUE(p["determined"].get<bool>()) << p;
  }
  EXPECT_NEAR(gain, 12, 1);
  EXPECT_NEAR(empty / gain, 0.5 / 12, 0.002 * 0.5 / 12);  // 10 000 rows of 5 um noise against 1 mm: far below 0.2 %
  EXPECT_NEAR(loaded / gain, 0.7 / 12, 0.002 * 0.7 / 12);
  EXPECT_NEAR(stiffness / gain, 80.0 / 12, 0.002 * 80 / 12);
  EXPECT_NEAR(damping / gain, 60.0 / 12, 0.005 * 60 / 12);
  EXPECT_NEAR(facts["noise"][0]["white"].get<double>(), 5e-3, 2e-4);  // [mm] 20 000 rows: 1 %
  ASSERT_EQ(facts["profiles"].size(), 1U);
  EXPECT_LT(facts["profiles"][0]["low95"].get<double>(), damping);
  EXPECT_GT(facts["profiles"][0]["high95"].get<double>(), damping);
  const auto parameters = nlohmann::json::parse(folder.read("job.fit/parameters.json"));
  for (const char* key : {"diagram", "data", "method", "date", "seed", "recordings"})
    EXPECT_TRUE(parameters["fit"].contains(key)) << key;
}

TEST(Docs, TheirPictureIsOneOfTheirDiagram) {
  const std::string docs = std::string(HYSTERON_SOURCE_DIR) + "/docs/";
  const Folder folder;
  folder.write("loop.json", text_of(docs + "loop.json"));
  ASSERT_EQ(process::hysteron(folder.path(), {"draw", "loop.json"}).code, 0);
  // Another version of Graphviz may place blocks differently: what is shown counts.
  const auto shown = [](const std::string& svg) {
    std::multiset<std::string> parts;
    static const std::regex part("data-[a-z]+=\"[^\"]*\"|>[^<>]+</text>");
    for (std::sregex_iterator i(svg.begin(), svg.end(), part), end; i != end; ++i) parts.insert(i->str());
    return parts;
  };
  EXPECT_EQ(shown(folder.read("loop.svg")), shown(text_of(docs + "loop.svg")));
}

}  // namespace
}  // namespace hysteron
