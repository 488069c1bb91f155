// `hysteron discover`: the test for machines, and what its errors are held against.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "tests/app/hysteron_process.h"
#include "tests/app/lab.h"
#include "tests/app/lab_test.h"

namespace hysteron {
namespace {

using nlohmann::json;
using process::hysteron;
using process::Outcome;

class DiscoverVerb : public LabTest {};

/// What the lines of the waterfalls are.
std::set<std::string> floor_labels(const json& all) {
  std::set<std::string> labels;
  for (const auto& s : all["sections"])
    for (const auto& f : s.value("figures", json::array()))
      for (const auto& b : f.value("bars", json::array()))
        if (b["role"] == "floor") labels.insert(b["label"]);
  return labels;
}

TEST_F(DiscoverVerb, DiscoverCheckAnswersYesForAModelThatLacksNothingAndNoForOneThatDoes) {
  std::string data = lab::dataset();
  data.replace(data.find("1 nm"), 4, "5 nm");
  folder_.write("dataset.json", data);
  const std::vector<std::string> words{"discover", "diagram.json", "--data", "dataset.json", "--check", "-o", "out"};
  folder_.write("a.csv", lab::noisy_recording(1));
  folder_.write("b.csv", lab::noisy_recording(2));
  const Outcome adequate = hysteron(folder_.path(), words);
  EXPECT_EQ(adequate.code, 0) << adequate.out << adequate.err;
  EXPECT_TRUE(adequate.out.ends_with("adequate: out/report.html\n")) << adequate.out;

  folder_.write("a.csv", lab::noisy_recording(3, 0.02));  // 20 ms at a period of 0.5 s: a hundred times the noise
  folder_.write("b.csv", lab::noisy_recording(4, 0.02));
  const Outcome missing = hysteron(folder_.path(), words);
  EXPECT_EQ(missing.code, 1) << missing.out << missing.err;
  EXPECT_NE(missing.out.find("lag"), std::string::npos) << missing.out;
  EXPECT_NE(folder_.read("out/result.json").find("\"explained\": false"), std::string::npos);
}

TEST_F(DiscoverVerb, DiscoverCheckHoldsWhatIsFreeAndSaysItToPrograms) {
  std::string data = lab::dataset();
  data.replace(data.find("1 nm"), 4, "5 nm");
  folder_.write("dataset.json", data);
  folder_.write("a.csv", lab::noisy_recording(1));
  folder_.write("b.csv", lab::noisy_recording(2));
  // 5 % less than the recordings have, though free: a plain discovery fits it, a check does not.
  const std::vector<std::string> words{"discover", "diagram.json", "--data",          "dataset.json", "--check",
                                       "--json",   "--set",        "gain=1.425 um/V", "-o",           "out"};
  const Outcome moved = hysteron(folder_.path(), words);
  EXPECT_EQ(moved.code, 1) << moved.out << moved.err;
  EXPECT_TRUE(moved.out.starts_with("{")) << moved.out;
  for (const char* said : {"\"explained\": false", "\"parameters_moved\": true", "\"parameters\"", "(was 1.425)"})
    EXPECT_NE(moved.out.find(said), std::string::npos) << said << " in " << moved.out;
  EXPECT_TRUE(folder_.has("out/result.json"));
}

TEST_F(DiscoverVerb, DiscoverHoldsTheErrorAgainstWhatTheDeviceRepeatsTo) {
  std::string data = lab::dataset();
  data.replace(data.find("1 nm"), 4, "5 nm");
  folder_.write("dataset.json", data);
  folder_.write("a.csv", lab::noisy_recording(5, 0.02));
  folder_.write("b.csv", lab::noisy_recording(6, 0.02));
  ASSERT_EQ(hysteron(folder_.path(),
                     {"discover", "diagram.json", "--data", "dataset.json", "--only", "amplifier_lag", "-o", "out"})
                .code,
            0);
  const json all = result("out");
  const json& floor = all["facts"]["floor"][0];
  // Six periods of a law that repeats exactly: what differs is the noise of 5 nm. The least of two recordings with some
  // 400 rows each: a standard deviation is good to 1/sqrt(2 * 400) = 3.5 %, three of these.
  EXPECT_NEAR(floor["repeatability_rms"].get<double>(), 0.005, 0.1 * 0.005) << floor;
  EXPECT_NE(floor["repeats"].get<std::string>().find("periods in"), std::string::npos);
  EXPECT_TRUE(floor_labels(all).contains("repeatability"));
}

TEST_F(DiscoverVerb, DiscoverHoldsTheErrorAgainstTheNoiseWhereNothingWasRecordedTwice) {
  std::string data = lab::dataset();
  data.replace(data.find("1 nm"), 4, "5 nm");
  data.replace(data.find("\"train\""), 7, R"("train", "until": "0.48 s")");  // a period lasts 0.5 s
  data.replace(data.find("\"validate\""), 10, R"("validate", "until": "0.4 s")");
  folder_.write("dataset.json", data);
  folder_.write("a.csv", lab::noisy_recording(5, 0.02));
  folder_.write("b.csv", lab::noisy_recording(6, 0.02));
  ASSERT_EQ(hysteron(folder_.path(),
                     {"discover", "diagram.json", "--data", "dataset.json", "--only", "amplifier_lag", "-o", "out"})
                .code,
            0);
  const json all = result("out");
  EXPECT_EQ(floor_labels(all), std::set<std::string>{"noise of the sensor"});
  EXPECT_FALSE(all["facts"]["floor"][0].contains("repeatability_rms"));
  EXPECT_NE(folder_.read("out/report.html").find("Nothing was recorded twice"), std::string::npos);
}

}  // namespace
}  // namespace hysteron
