// result.json: valid whatever the numbers and texts are, and read back as it was written.
#include "io/results/result.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "engine/diagram/error.h"
#include "io/files/atomic_file.h"
#include "tests/io/results/example.h"
#include "tests/io/temporary_folder.h"

namespace hysteron {
namespace {

namespace fs = std::filesystem;

class ResultFile : public testing::Test {
 protected:
  std::string code_of_reading(const std::string& text) {
    write_file((folder_ / "result.json").string(), text);
    try {
      read_result(folder_.string());
    } catch (const Error& e) {
      EXPECT_FALSE(e.problems.front().cure.empty());
      EXPECT_NE(e.problems.front().path.find("result.json"), std::string::npos);
      return e.problems.front().code;
    }
    return "";
  }
  TemporaryFolder temporary_;
  const fs::path folder_ = temporary_.path();
};

TEST_F(ResultFile, ComesBackAsItWasWritten) {
  const Document written = example::discovery();
  write_result((folder_ / "out").string(), written, "<!doctype html>");
  const Document read = read_result((folder_ / "out").string());
  // Everything but the numbers of the traces stands in result.json: the same text is the same document.
  EXPECT_EQ(result_text(read), result_text(written));
  ASSERT_EQ(read.traces.size(), 1U);
  EXPECT_EQ(read.traces[0].file, "02.csv");
  // CSV is written with as many digits as a double needs, so equality is exact.
  EXPECT_EQ(read.traces[0].columns[2].values, written.traces[0].columns[2].values);
  EXPECT_EQ(read.traces[0].columns[2].unit.text, "um");
  EXPECT_EQ(read.files, written.files);
}

TEST(ResultText, SaysWhatItIs) {
  const auto j = nlohmann::json::parse(result_text(example::discovery()));
  EXPECT_EQ(j["program"], "hysteron");
  EXPECT_EQ(j["format"], 1);
  EXPECT_EQ(j["verdict"], "missing_effect");
  EXPECT_FALSE(j["version"].get<std::string>().empty());
  EXPECT_EQ(j["facts"]["rms_after"], 0.031);
  EXPECT_EQ(j["sections"][1]["figures"][0]["curves"][0]["trace"], "02.csv");
  EXPECT_EQ(j["traces"], nlohmann::json({"02.csv"}));
}

TEST(ResultText, IsValidJsonAlsoWithNanAndBrokenText) {
  Document d;
  d.verb = "compare";
  d.headline = "a byte that is no UTF-8: \xff";
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
  d.facts = std::make_shared<nlohmann::json>(nlohmann::json{{"nrmse", nan}, {"peak", -infinite}});
  d.sections.resize(1);
  d.sections[0].figures.resize(1);
  d.sections[0].figures[0].curves = {{"gap", "line", "", "", "", "", {0, 1}, {nan, 2}}};
  d.sections[0].figures[0].bars = {{"none", nan, "", ""}};
  const auto j = nlohmann::json::parse(result_text(d));
  EXPECT_TRUE(j["facts"]["nrmse"].is_null());
  EXPECT_TRUE(j["facts"]["peak"].is_null());
  EXPECT_TRUE(j["sections"][0]["figures"][0]["curves"][0]["y"][0].is_null());
}

TEST(ResultText, OfNothingStillHasEveryKey) {
  const auto j = nlohmann::json::parse(result_text(Document{}));
  for (const char* key : {"$schema", "format", "program", "version", "verb", "title", "headline", "verdict",
                          "sentences", "warnings", "facts", "sections", "traces", "files"})
    EXPECT_TRUE(j.contains(key)) << key;
  EXPECT_TRUE(j["facts"].is_object());
}

TEST_F(ResultFile, GapsOfACurveComeBackAsNan) {
  Document d;
  d.sections.resize(1);
  d.sections[0].figures.resize(1);
  d.sections[0].figures[0].curves = {{"gap", "line", "", "", "", "", {0, 1}, {std::nan(""), 2}}};
  write_result((folder_ / "out").string(), d, "");
  const Document read = read_result((folder_ / "out").string());
  const auto& curve = read.sections.at(0).figures.at(0).curves.at(0);
  EXPECT_TRUE(std::isnan(curve.y.at(0)));
  EXPECT_EQ(curve.y.at(1), 2);
}

TEST_F(ResultFile, OfANewerFormatIsRefusedByName) {
  EXPECT_EQ(code_of_reading(R"({"program": "hysteron", "version": "9.0", "format": 2})"), "newer_format");
}
TEST_F(ResultFile, OfAnotherProgramIsRefused) {
  EXPECT_EQ(code_of_reading(R"({"program": "other", "format": 1})"), "not_a_result");
  EXPECT_EQ(code_of_reading("[1, 2]"), "not_a_result");
  EXPECT_EQ(code_of_reading(R"({"program": 5})"), "bad_result");
}
TEST_F(ResultFile, ThatIsDamagedIsRefused) {
  EXPECT_EQ(code_of_reading("{\"program\": \"hyst"), "bad_result");
  EXPECT_EQ(code_of_reading(R"({"program": "hysteron", "format": 1, "sections": [{"title": 5}]})"), "bad_result");
  EXPECT_EQ(code_of_reading(""), "bad_result");
}

}  // namespace
}  // namespace hysteron
