// What explain says of diagrams whose answers are known.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "tests/app/hysteron_process.h"

namespace hysteron {
namespace {

using process::Folder;
using process::hysteron;
using process::Outcome;

const char loop[] = R"json({
  "format": 1, "title": "Loop",
  "parameters": {"kp": {"value": 0.5, "unit": "V/um"}},
  "blocks": {
    "seen":       {"type": "gain", "gain": 2, "in": "stage"},
    "stage":      {"type": "lag", "times": ["1 ms"], "in": "hysteresis"},
    "hysteresis": {"type": "bouc_wen", "alpha": "0.6187 um/V", "beta": "0.2418 1/V", "gamma": "0.0237 1/V",
                   "d_p": "1.6126 um/V", "in": "drive"},
    "drive":      {"type": "sum", "in": ["controller", "feedforward"]},
    "feedforward": {"choose": "on", "in": "reference",
                    "from": {"off": {"type": "gain", "gain": "0 V/um"}, "on": {"type": "gain", "gain": "$kp"}}},
    "controller": {"type": "pi_controller", "kp": "$kp", "ki": "700 V/(um s)", "in": "error"},
    "error":      {"type": "sum", "signs": "+-", "in": ["reference", "stage"]},
    "reference":  {"type": "sine", "amplitude": "3 um", "frequency": "5 Hz"}
  },
  "record": ["stage", "seen"],
  "simulate": {"until": "2 s", "solver": {"relative_tolerance": 1e-7}}
}
)json";

/// Runs of blanks are one, and lines that continue a column (far from the left) belong to the line before.
std::string squeezed(const std::string& text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\n' && text.find_first_not_of(' ', i + 1) - i > 12)
      result += ' ';
    else
      result += text[i];
  }
  std::string tight;
  for (const char c : result)
    if (c != ' ' || (!tight.empty() && tight.back() != ' ' && tight.back() != '\n')) tight += c;
  return tight;
}

class Explain : public testing::Test {
 protected:
  std::string explain(const std::string& diagram, const std::vector<std::string>& further = {}) {
    folder_.write("diagram.json", diagram);
    std::vector<std::string> words{"explain", "diagram.json"};
    words.insert(words.end(), further.begin(), further.end());
    const Outcome outcome = hysteron(folder_.path(), words);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return squeezed(outcome.out);
  }
  const Folder folder_;
};

void expect_parts(const std::string& text, const std::vector<std::string>& parts) {
  for (const auto& part : parts) EXPECT_NE(text.find(part), std::string::npos) << part << "\nis not in\n" << text;
}

TEST_F(Explain, NamesTheFeedbackLoopAndWhatOpensIt) {
  const std::string text = explain(loop);
  expect_parts(text, {"algebraic: none", "feedback: ", "stage follows its input"});
  for (const char* wire :
       {"stage -> error", "error -> controller", "controller -> drive", "drive -> hysteresis", "hysteresis -> stage"})
    EXPECT_NE(text.find(wire), std::string::npos) << wire;
}

TEST_F(Explain, AnAlgebraicLoopIsNamedWithWhatItIsSolvedFor) {
  // error = reference - 0.5 error: no state, so the two need each other at once.
  const std::string text = explain(R"({"format": 1, "blocks": {
    "reference": {"type": "sine", "amplitude": "1 V", "frequency": "1 Hz"},
    "error": {"type": "sum", "signs": "+-", "in": ["reference", "half"]},
    "half": {"type": "gain", "gain": 0.5, "in": "error"},
    "seen": {"type": "lag", "times": ["1 ms"], "in": "half"}}, "record": ["seen"]})");
  EXPECT_EQ(text.find("algebraic: none"), std::string::npos);
  const bool from_error =
      text.find("error -> half -> error; solved at every evaluation for error") != std::string::npos;
  const bool from_half = text.find("half -> error -> half; solved at every evaluation for half") != std::string::npos;
  EXPECT_TRUE(from_error || from_half) << text;
  expect_parts(text, {"algebraic loop 1 of values: ", "solve loop 1", "in loop 1"});
}

TEST_F(Explain, EachValueComesBehindThoseThatItReads) {
  const std::string text = explain(loop);
  std::map<std::string, int> place;
  std::istringstream lines(text.substr(text.find("order of evaluation")));
  int at = 0;
  for (std::string line; std::getline(lines, line) && line != "loops";) {
    std::istringstream words(line);
    std::string number, what, block;
    words >> number >> what >> block;
    if (what == "value" || what == "value+rate") place[block] = ++at;
  }
  // The lag gives its value from its state, so it need not stand behind the hysteresis.
  for (const auto& [from, to] : {std::pair{"reference", "error"},
                                 {"stage", "error"},
                                 {"error", "controller"},
                                 {"controller", "drive"},
                                 {"feedforward", "drive"},
                                 {"drive", "hysteresis"},
                                 {"stage", "seen"}}) {
    ASSERT_TRUE(place.contains(from) && place.contains(to)) << from << " " << to << "\n" << text;
    EXPECT_LT(place[from], place[to]) << from << " " << to;
  }
}

TEST_F(Explain, TellsWhoseRateIsComputedAndForWhom) {
  const std::string text = explain(loop);
  // Bouc-Wen wants the rate of the drive; that needs the rates of its summands, and theirs that of the error ...
  expect_parts(text, {"d/dt drive for hysteresis (its law is driven by the rate)",
                      "d/dt controller for drive (for its own rate)", "d/dt error for controller (for its own rate)"});
  EXPECT_EQ(text.find("d/dt hysteresis"), std::string::npos) << "nobody asks for that";
}

TEST_F(Explain, TellsTheSolverAndWhichBlockForbidsTheExactAdvance) {
  expect_parts(explain(loop),
               {"method bdf", "exact row by row does not apply", "reference", "until 2 s as the diagram says",
                "relative tolerance 1e-07 as the diagram says", "longest step not limited", "Jacobian 3 x 3"});
}

TEST_F(Explain, TellsWhetherManyParameterSetsGoSideBySideOrWhichBlockForbidsIt) {
  expect_parts(explain(loop), {"in lanes applies"});
  expect_parts(explain(R"({"format": 1, "blocks": {
    "drive": {"type": "sine", "amplitude": "1 V", "frequency": "1 Hz"},
    "late": {"type": "dead_time", "delay": "1 ms", "in": "drive"}}, "record": ["late"]})"),
               {"in lanes does not apply", "dead_time \"late\" looks back into the past of its input"});
}

TEST_F(Explain, WritesWhatItPrintsForProgramsWhereAsked) {
  const std::string text = explain(loop, {"-o", "out"});
  EXPECT_NE(text.find("report: out/report.html"), std::string::npos) << text;
  const std::string result = folder_.read("out/result.json");
  for (const char* part : {"\"verb\": \"explain\"", "order of evaluation", "\"method\": \"bdf\"", "continuous states"})
    EXPECT_NE(result.find(part), std::string::npos) << part << "\n" << result;
}

TEST_F(Explain, TellsWhereEachValueComesFrom) {
  const std::string text = explain(loop, {"--set", "kp=0.7 V/um", "--choose", "feedforward=on"});
  expect_parts(text, {"kp 0.7 V/um --set; read as controller.kp, feedforward.gain",
                      "reference.frequency 5 Hz diagram /blocks/reference/frequency", "reference.phase 0",
                      "controller.ki 700 V/(um s) diagram /blocks/controller/ki", "feedforward on of off, on"});
  const auto phase = text.find("reference.phase");
  EXPECT_NE(text.substr(phase, text.find('\n', phase) - phase).find("default"), std::string::npos);
}

TEST_F(Explain, NamesTheParameterSetAndTheNestedDiagram) {
  folder_.write("hysteron.project", "");
  folder_.write("table.json", R"({"alpha": "0.6 um/V", "beta": "0.2 1/V", "gamma": "0.02 1/V", "d_p": "1.6 um/V"})");
  folder_.write("inner.json", R"({"format": 1, "inputs": {"u": {"unit": "V"}},
    "blocks": {"core": {"type": "bouc_wen", "parameters": "table.json", "in": "u"}, "end": {"type": "lag", "times": ["2 ms"], "in": "core"}},
    "outputs": {"y": "end"}})");
  const std::string text = explain(R"({"format": 1, "blocks": {
    "drive": {"type": "sine", "amplitude": "1 V", "frequency": "1 Hz"},
    "stage": {"type": "diagram", "file": "inner.json", "in": "drive"}}, "record": ["stage"]})");
  expect_parts(text, {"stage/core.alpha 0.6 um/V parameter set table.json",
                      "stage/end.times[0] 2 ms diagram inner.json /blocks/end/times"});
}

TEST_F(Explain, SaysThatARecordedDiagramAdvancesExactlyAndWhereReversalsAreLocated) {
  const std::string text = explain(R"({"format": 1, "inputs": {"u": {"unit": "V"}},
    "blocks": {"core": {"type": "play", "radius": "0.2 V", "in": "u"}, "end": {"type": "lag", "times": ["2 ms"], "in": "core"}},
    "outputs": {"y": "end"}})");
  expect_parts(
      text, {"method exact", "exact row by row applies", "reversals located core (u)", "until open", "feedback: none"});
}

TEST_F(Explain, TheLongestStepIsAQuarterOfThePeriodThatReachesMemory) {
  const std::string text = explain(R"({"format": 1, "blocks": {
    "drive": {"type": "sine", "amplitude": "1 V", "frequency": "5 Hz"},
    "core": {"type": "play", "radius": "0.2 V", "in": "drive"}, "end": {"type": "lag", "times": ["2 ms"], "in": "core"}},
    "record": ["end"], "simulate": {"until": "1 s"}})");
  expect_parts(text, {"longest step 50 ms a quarter of the shortest period of drive"});
}

TEST_F(Explain, TellsClocksModesAndWhatIsHeldBetweenInstants) {
  const std::string text = explain(R"({"format": 1, "blocks": {
    "drive":  {"type": "sine", "amplitude": "1 V", "frequency": "5 Hz"},
    "slow":   {"type": "sample_hold", "period": "1 ms", "offset": "0.5 ms", "in": "stage"},
    "fast":   {"type": "sample_hold", "period": "0.1 ms", "in": "drive"},
    "faster": {"type": "sample_hold", "period": "0.1 ms", "in": "slow"},
    "stage":  {"type": "lag", "times": ["2 ms"], "in": "fast"},
    "switch": {"type": "relay", "on_at": "0.5 V", "off_at": "-0.5 V", "on_value": "1 V", "off_value": "0 V", "in": "stage"},
    "core":   {"type": "play", "radius": "0.1 V", "in": "fast"}},
    "record": ["faster", "switch", "core"], "simulate": {"until": "1 s"}})");
  expect_parts(text,
               {"every 100 us from 0 s fast, faster", "every 1 ms from 500 us slow",
                "continuous signals read at instants: stage for slow, drive for fast",
                "held between instants: fast for stage, fast for core", "modes switch", "followed as paths core"});
}

TEST_F(Explain, AWrongDiagramIsToldAsEverywhere) {
  folder_.write("diagram.json", R"({"format": 1, "blocks": {"a": {"type": "gian", "gain": 1, "in": "a"}}})");
  const Outcome outcome = hysteron(folder_.path(), {"explain", "diagram.json"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("gain"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace hysteron
