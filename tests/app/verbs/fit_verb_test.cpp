// `hysteron fit`: what it finds, writes and says, by hand and by a job.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "tests/app/hysteron_process.h"
#include "tests/app/lab.h"
#include "tests/app/lab_test.h"

namespace hysteron {
namespace {

using nlohmann::json;
using process::hysteron;
using process::Outcome;

class FitVerb : public LabTest {};

TEST_F(FitVerb, FitFindsTheGainAndWritesADiagramThatRuns) {
  std::string text = lab::diagram();
  text.replace(text.find("\"value\": 1.5"), 12, "\"value\": 1.2");
  folder_.write("poor.json", text);
  const Outcome outcome =
      hysteron(folder_.path(), {"fit", "poor.json", "--data", "dataset.json", "--write", "good.json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const json parameter = result("poor.fit")["facts"]["parameters"][0];
  EXPECT_EQ(parameter["parameter"], "gain");
  EXPECT_EQ(parameter["unit"], "um/V");
  EXPECT_NEAR(parameter["value"].get<double>(), 1.5, 1e-6);  // six digits in the CSV
  EXPECT_LE(parameter["low95"].get<double>(), 1.5 + 1e-6);
  EXPECT_GE(parameter["high95"].get<double>(), 1.5 - 1e-6);
  for (const char* file : {"good.json", "poor.fit/fitted.json"})
    EXPECT_EQ(
        hysteron(folder_.path(), {"compare", file, "--data", "dataset.json", "--tolerance", "1 nm", "-o", "after"})
            .code,
        0)
        << file;
}

TEST_F(FitVerb, FitWithNothingFreeSaysHowToFreeSomething) {
  std::string text = lab::diagram();
  text.replace(text.find(", \"free\": true"), 14, "");
  folder_.write("fixed.json", text);
  const Outcome outcome = hysteron(folder_.path(), {"fit", "fixed.json", "--data", "dataset.json"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("--free"), std::string::npos) << outcome.err;
  EXPECT_EQ(hysteron(folder_.path(), {"fit", "fixed.json", "--data", "dataset.json", "--free", "gain"}).code, 0);
}

TEST_F(FitVerb, AJobComparesMethodsAndKeepsTheBest) {
  folder_.write("job.json", R"({"format": 1, "do": "fit", "diagram": "diagram.json", "data": "dataset.json",
    "free": [{"parameter": "gain", "lower": "0.1 um/V", "upper": "10 um/V", "start": "0.3 um/V"}],
    "method": ["search", {"name": "pso", "runs": 50, "then": "nothing"}], "seed": 3, "write": "good.json"})");
  const Outcome outcome = hysteron(folder_.path(), {"fit", "job.json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const json facts = result("job.fit")["facts"];
  EXPECT_NEAR(facts["parameters"][0]["value"].get<double>(), 1.5, 1e-6);  // six digits in the CSV
  EXPECT_NEAR(facts["parameters"][0]["start"].get<double>(), 0.3, 1e-12);
  EXPECT_EQ(facts["seed"], 3);
  EXPECT_NE(outcome.out.find("seconds"), std::string::npos) << outcome.out;  // the table of methods
  EXPECT_EQ(hysteron(folder_.path(), {"compare", "good.json", "--data", "dataset.json", "--tolerance", "1 nm"}).code,
            0);
  // The table says seconds to the terminal only: the same input gives the same file.
  const std::string first = folder_.read("job.fit/result.json");
  ASSERT_EQ(hysteron(folder_.path(), {"fit", "job.json"}).code, 0);
  EXPECT_EQ(folder_.read("job.fit/result.json"), first);
}

TEST_F(FitVerb, FitReadsWeightsOffTheSlopesAsTheThesisDoes) {
  folder_.write("plays.json", R"({"format": 1, "title": "plays", "inputs": {"u": {"unit": "V"}},
    "blocks": {"core": {"type": "prandtl_ishlinskii", "thresholds": ["0 V", "1 V"], "weights": ["1 um/V", "0.1 um/V"], "in": "u"}},
    "outputs": {"y": "core"}})");
  // From rest to 2 V and back: slopes 1.5 and 1.75 um/V, so weights 1.5 and 0.25.
  folder_.write("loop.csv", "t [s],u [V],y [um]\n0,0,0\n1,0.5,0.75\n2,1,1.5\n3,1.5,2.375\n4,2,3.25\n5,1,1.75\n6,0,0\n");
  folder_.write("loop.json", R"({"format": 1, "recordings": [{"file": "loop.csv", "role": "train"},
    {"file": "loop.csv", "role": "validate"}]})");
  const Outcome outcome = hysteron(folder_.path(), {"fit", "plays.json", "--data", "loop.json", "--method", "slopes"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const json parameters = result("plays.fit")["facts"]["parameters"];
  ASSERT_EQ(parameters.size(), 2U);
  EXPECT_NEAR(parameters[0]["value"].get<double>(), 1.5, 1e-12);
  EXPECT_NEAR(parameters[1]["value"].get<double>(), 0.25, 1e-12);
  EXPECT_TRUE(parameters[1]["low95"].is_null());
  const Outcome wrong =
      hysteron(folder_.path(), {"fit", "diagram.json", "--data", "dataset.json", "--method", "slopes"});
  EXPECT_EQ(wrong.code, 2);  // its model has no such block
  EXPECT_NE(wrong.err.find("prandtl_ishlinskii"), std::string::npos) << wrong.err;
}

TEST_F(FitVerb, AFitThatEndsWithALargerRmsSaysSoAndWhy) {
  // The gain is 1 um/V for slow motion and 1.5 um/V for fast one. Slow motion is three times as large, so that 1 is
  // best for the rms; noise stated to be 1/f makes slow errors count little, so that the fit goes to 1.5.
  std::string rows = "t [s],u [V],y [um]\n";
  for (int k = 0; k <= 1000; ++k) {
    const double t = 0.01 * k, slow = 3 * std::sin(0.2 * std::numbers::pi * t),
                 fast = std::sin(20 * std::numbers::pi * t + 0.3);
    rows += fmt::format("{:.2f},{:.9f},{:.9f}\n", t, slow + fast, slow + 1.5 * fast);
  }
  folder_.write("two.csv", rows);
  const auto fit = [&](const std::string& noise) {
    folder_.write("two.json", R"({"format": 1, "columns": {"y": {"noise": )" + noise +
                                  R"(}}, "recordings": [{"file": "two.csv", "role": "train"}]})");
    std::string text = lab::diagram();
    text.replace(text.find("\"value\": 1.5"), 12, "\"value\": 1");
    folder_.write("one.json", text);
    const Outcome outcome = hysteron(folder_.path(), {"fit", "one.json", "--data", "two.json", "-o", "out"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome.out;
  };
  const std::string risen = fit(R"({"white": "1 nm", "one_over_f": 100})");
  EXPECT_NE(risen.find("has risen"), std::string::npos) << risen;
  EXPECT_NE(risen.find("one_over_f"), std::string::npos) << risen;
  EXPECT_EQ(fit(R"({"white": "1 nm", "one_over_f": 0})").find("has risen"), std::string::npos);
}

TEST_F(FitVerb, AWrongJobIsToldWithItsLineAndCure) {
  const auto told = [&](const std::string& members, const char* code, int line) {
    folder_.write("job.json",
                  "{\"format\": 1, \"do\": \"fit\",\n\"diagram\": \"diagram.json\", \"data\": \"dataset.json\",\n" +
                      members + "}");
    const Outcome outcome = hysteron(folder_.path(), {"fit", "job.json", "--errors", "json"});
    EXPECT_EQ(outcome.code, 2) << outcome.out;
    const json problem = json::parse(outcome.err)["problems"][0];
    EXPECT_EQ(problem["code"], code) << problem;
    EXPECT_EQ(problem["line"], line) << problem;
    EXPECT_EQ(problem["file"], "job.json") << problem;
    EXPECT_NE(problem["cure"], "") << problem;
  };
  told("\"free\": [\n{\"parameter\": \"gian\"}]", "unknown_parameter", 4);
  told("\"free\": [{\"parameter\": \"gain\",\n\"lower\": \"1 kg\"}]", "wrong_unit", 4);
  told("\"free\": [{\"parameter\": \"gain\",\n\"start\": \"5 um/V\", \"upper\": \"2 um/V\"}]", "start_outside", 4);
  told("\"method\": {\n\"name\": \"psso\"}", "unknown_method", 4);
  told("\"colour\": 1", "unknown_key", 3);
  told("\"write\":\n\"dataset.json\"", "file_in_use", 3);
  EXPECT_FALSE(folder_.has("job.fit"));
  const Outcome no_data = hysteron(folder_.path(), {"fit", "diagram.json"});
  EXPECT_EQ(no_data.code, 2);
  EXPECT_NE(no_data.err.find("--data"), std::string::npos) << no_data.err;
}

TEST_F(FitVerb, AJobPlacesThresholdsAndTheSlopesOfTheThesisAreAMethod) {
  folder_.write("truth.json", R"({"format": 1, "blocks": {
    "drive": {"type": "triangle", "amplitude": "4 V", "offset": "4 V", "phase": "-90 deg", "frequency": "1 Hz"},
    "core": {"type": "prandtl_ishlinskii", "thresholds": {"value": [0, 1.5, 4], "unit": "V"},
             "weights": {"value": [0.8, 0.3, 0.2], "unit": "um/V"}, "in": "drive"}},
    "record": ["drive", "core"], "simulate": {"until": "3 s", "every": "5 ms"}})");
  folder_.write("pi.json", R"({"format": 1, "inputs": {"drive": {"unit": "V"}}, "blocks": {
    "model": {"type": "prandtl_ishlinskii", "thresholds": {"value": [0, 1, 2], "unit": "V"},
              "weights": {"value": [1, 0.1, 0.1], "unit": "um/V"}, "in": "drive"}}, "outputs": {"core": "model"}})");
  ASSERT_EQ(hysteron(folder_.path(), {"run", "truth.json", "-o", "lab"}).code, 0);
  folder_.write("job.json", R"({"format": 1, "do": "fit", "diagram": "pi.json", "data": "lab/traces/signals.csv",
    "thresholds": {"block": "model", "count": 3}})");
  const Outcome outcome = hysteron(folder_.path(), {"fit", "job.json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto value = [&](const std::string& out, const std::string& path) {
    const json facts = result(out)["facts"];
    for (const auto& p : facts["parameters"])
      if (p["parameter"] == path) return p["value"].get<double>();
    return std::nan("");
  };
  EXPECT_NEAR(value("job.fit", "model.weights[0]"), 0.8, 1e-3);  // no noise; the search ends within 1e-9 of chi2
  EXPECT_NEAR(value("job.fit", "model.weights[1]"), 0.3, 1e-3);
  const Outcome slopes = hysteron(
      folder_.path(), {"fit", "pi.json", "--data", "lab/traces/signals.csv", "--method", "slopes", "-o", "slopes"});
  ASSERT_EQ(slopes.code, 0) << slopes.err;
  // Up to 1 V the branch that rises from zero has the slope 0.8 um/V, whatever comes behind.
  EXPECT_NEAR(value("slopes", "model.weights[0]"), 0.8, 1e-6);
}

TEST_F(FitVerb, AnInterruptedFitKeepsItsBestAndSaysSo) {
  // A budget that would take hours; however slow the machine, the fit is at work when the signal comes.
  folder_.write("lag.json", R"({"format": 1, "inputs": {"u": {"unit": "V"}}, "blocks": {
    "lag": {"type": "lag", "times": {"value": [5], "unit": "ms"}, "in": "u"},
    "sensor": {"type": "calibration", "gain": "1.5 um/V", "offset": "0.2 um", "in": "lag"}},
    "outputs": {"y": "sensor"}})");
  folder_.write("job.json", R"({"format": 1, "do": "fit", "diagram": "lag.json", "data": "dataset.json",
    "free": [{"parameter": "lag.times", "lower": "0.1 ms", "upper": "1 s"}],
    "method": {"name": "isres", "runs": 1000000000}})");
  const Outcome outcome = hysteron(folder_.path(), {"fit", "job.json"}, "", 4000);
  EXPECT_EQ(outcome.code, 130) << outcome.out << outcome.err;
  ASSERT_TRUE(folder_.has("job.fit/parameters.json")) << outcome.err;
  EXPECT_EQ(result("job.fit")["facts"]["interrupted"], true);
  EXPECT_NE(outcome.err.find("job.fit"), std::string::npos) << outcome.err;  // where the best so far lies
}

TEST_F(FitVerb, AFitDatesItsParametersAsItIsTold) {
  const Outcome outcome =
      process::shell(folder_.path(), "SOURCE_DATE_EPOCH=86400 hysteron fit diagram.json --data dataset.json -o out");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const json parameters = json::parse(folder_.read("out/parameters.json"));
  EXPECT_EQ(parameters["fit"]["date"], "1970-01-02T00:00:00Z");
  EXPECT_EQ(parameters["fit"]["data"], "dataset.json");
}

}  // namespace
}  // namespace hysteron
