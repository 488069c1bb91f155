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

class DiscoverVerb : public LabTest {
 protected:
  json looked_for_a_lag() const {
    const Outcome out = hysteron(
        folder_.path(), {"discover", "diagram.json", "--data", "dataset.json", "--only", "amplifier_lag", "-o", "out"});
    EXPECT_EQ(out.code, 0) << out.err;
    return result("out");
  }
};

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
  const std::vector<std::string> words{"discover", "diagram.json", "--data", "dataset.json", "--check", "-o", "out"};
  record(1);
  const Outcome adequate = hysteron(folder_.path(), words);
  EXPECT_EQ(adequate.code, 0) << adequate.out << adequate.err;
  EXPECT_TRUE(adequate.out.ends_with("adequate: out/report.html\n")) << adequate.out;

  record(3, 0.02);  // 20 ms at a period of 0.5 s: a hundred times the noise
  const Outcome missing = hysteron(folder_.path(), words);
  EXPECT_EQ(missing.code, 1) << missing.out << missing.err;
  EXPECT_NE(missing.out.find("lag"), std::string::npos) << missing.out;
  EXPECT_NE(folder_.read("out/result.json").find("\"explained\": false"), std::string::npos);
}

TEST_F(DiscoverVerb, DiscoverEndsWithinTheTimeThatItIsGivenAndSaysSo) {
  record(3, 0.02);
  const auto discovered = [&](const std::string& within) {
    return hysteron(folder_.path(),
                    {"discover", "diagram.json", "--data", "dataset.json", "--within", within, "-o", "out"});
  };
  const Outcome cut = discovered("1 us");
  EXPECT_EQ(cut.code, 0) << cut.err;
  EXPECT_NE(cut.out.find("Ended by --within 1 us"), std::string::npos) << cut.out;
  const std::string headline = result("out").at("headline");
  EXPECT_NE(headline.find("until the search was broken off"), std::string::npos) << headline;
  EXPECT_TRUE(result("out").at("facts").at("effects").empty());
  const auto find_lag = discovered("10 min");
  EXPECT_EQ(find_lag.code, 0) << find_lag.err;
  EXPECT_FALSE(result("out").at("facts").at("effects").empty()) << "there is something to be found";
  EXPECT_EQ(find_lag.out.find("Ended by"), std::string::npos) << find_lag.out;
  EXPECT_EQ(find_lag.out.find("broken off"), std::string::npos) << find_lag.out;
  const Outcome wrong = discovered("3 V");
  EXPECT_EQ(wrong.code, 2);
  EXPECT_NE(wrong.err.find("is no time"), std::string::npos) << wrong.err;
  const Outcome check = hysteron(folder_.path(), {"discover", "diagram.json", "--data", "dataset.json", "--check",
                                                  "--within", "1 min", "-o", "out"});
  EXPECT_EQ(check.code, 2);
  EXPECT_NE(check.err.find("leave out --within"), std::string::npos) << check.err;
}

TEST_F(DiscoverVerb, DiscoverCheckHoldsWhatIsFreeAndSaysItToPrograms) {
  record(1);
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
  record(5, 0.02);
  const json all = looked_for_a_lag();
  const json& floor = all["facts"]["floor"][0];
  // Six periods of a law that repeats exactly: what differs is the noise of 5 nm. The least of two recordings with some
  // 400 rows each: a standard deviation is good to 1/sqrt(2 * 400) = 3.5 %, three of these.
  EXPECT_NEAR(floor["repeatability_rms"].get<double>(), 0.005, 0.1 * 0.005) << floor;
  EXPECT_NE(floor["repeats"].get<std::string>().find("periods in"), std::string::npos);
  EXPECT_TRUE(floor_labels(all).contains("repeatability"));
}

TEST_F(DiscoverVerb, DiscoverHoldsTheErrorAgainstTheNoiseWhereNothingWasRecordedTwice) {
  record(5, 0.02);
  std::string data = folder_.read("dataset.json");
  data.replace(data.find("\"train\""), 7, R"("train", "until": "0.48 s")");  // a period lasts 0.5 s
  data.replace(data.find("\"validate\""), 10, R"("validate", "until": "0.4 s")");
  folder_.write("dataset.json", data);
  const json all = looked_for_a_lag();
  EXPECT_EQ(floor_labels(all), std::set<std::string>{"noise of the sensor"});
  EXPECT_FALSE(all["facts"]["floor"][0].contains("repeatability_rms"));
  EXPECT_NE(folder_.read("out/report.html").find("Nothing was recorded twice"), std::string::npos);
}

}  // namespace
}  // namespace hysteron
