// The verbs on a small laboratory: what each prints, writes and returns.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/diagram/units.h"
#include "io/results/result.h"
#include "tests/app/hysteron_process.h"
#include "tests/app/lab.h"
#include "tests/app/lab_test.h"
#include "tests/app/schema_check.h"

namespace hysteron {
namespace {

using nlohmann::json;
using process::hysteron;
using process::Outcome;

class Verbs : public LabTest {};

const char sine[] = R"({
  "format": 1, "title": "Sine",
  "blocks": {
    "drive": {"type": "sine", "amplitude": "3 V", "frequency": "5 Hz"},
    "double": {"type": "gain", "gain": 2, "in": "drive"}
  },
  "record": ["drive", "double"],
  "simulate": {"until": "0.2 s", "every": "10 ms"}
}
)";

TEST_F(Verbs, CheckPrintsOneLineWithCountsAndWritesNothing) {
  const auto before = folder_.entries();
  const Outcome outcome = hysteron(folder_.path(), {"check", "diagram.json", "--data", "dataset.json"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("diagram.json: ok: 3 blocks, 1 input, 1 output"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("dataset.json: ok: 2 recordings, 350 rows judged"), std::string::npos) << outcome.out;
  EXPECT_EQ(folder_.entries(), before);
}

TEST_F(Verbs, CheckTellsTheProblemsOfAllStages) {
  folder_.write("draft.json", R"({
    "format": 1, "title": "Draft", "inputs": {"u": {"unit": "V"}},
    "blocks": {
      "stage": {"type": "gian", "gain": 2, "in": "u"},
      "stop": {"type": "saturation", "lower": "-5 um", "upper": "5 um", "in": "stage"},
      "sum": {"type": "sum", "in": ["stop", "u"]},
      "open": {"type": "lag", "times": "1 ms"}
    },
    "outputs": {"y": "sum", "z": "open"}})");
  const Outcome outcome = hysteron(folder_.path(), {"check", "draft.json", "--json"});
  EXPECT_EQ(outcome.code, 2);
  std::vector<std::string> told;
  const json failure = json::parse(outcome.err);
  for (const auto& p : failure.at("problems"))
    told.push_back(p.at("code").get<std::string>() + " in line " + std::to_string(p.at("line").get<int>()));
  EXPECT_EQ(told, (std::vector<std::string>{"unknown_block in line 4", "wrong_unit in line 6",
                                            "missing_connection in line 7"}));
}

TEST_F(Verbs, LinearizeWritesTheUnitOfAGainSoThatItCanBeReadBack) {
  // From V/um to um: um/(V/um) = um^2/V; without brackets it would read as 1/V.
  folder_.write("gain.json", R"({
    "format": 1, "title": "Gain", "inputs": {"k": {"unit": "V/um"}},
    "blocks": {"y": {"type": "gain", "gain": "2 um^2/V", "in": "k"}},
    "outputs": {"y": "y"}, "record": ["y"]})");
  const Outcome outcome = hysteron(folder_.path(), {"linearize", "gain.json", "-o", "out"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const json facts = result("out").at("facts");
  const Unit unit = parse_unit(facts.at("unit").get<std::string>());
  EXPECT_EQ(unit.dimension, parse_unit("um^2/V").dimension) << facts.at("unit");
  EXPECT_NEAR(unit.to_si(facts.at("gain_at_low_frequencies").get<double>()), parse_unit("um^2/V").to_si(2), 1e-24);
}

TEST_F(Verbs, RunTellsTheEventsOfEachBlock) {
  // The sine of amplitude 1 passes +-0.5 three times in a second and a half behind the start in the lower mode.
  folder_.write("relay.json", R"({
    "format": 1, "title": "Relay",
    "blocks": {
      "drive": {"type": "sine", "amplitude": "1 V", "frequency": "1 Hz"},
      "switch": {"type": "relay", "on_at": "0.5 V", "off_at": "-0.5 V", "on_value": "5 V", "off_value": "0 V", "in": "drive"},
      "held": {"type": "sample_hold", "period": "0.1 s", "in": "switch"}
    },
    "record": ["held"], "simulate": {"until": "1.45 s", "every": "10 ms"}})");
  const Outcome outcome = hysteron(folder_.path(), {"run", "relay.json", "-o", "out"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("time: load and compile "), std::string::npos) << outcome.out;
  const std::string written = folder_.read("out/result.json");
  ASSERT_EQ(hysteron(folder_.path(), {"run", "relay.json", "-o", "again"}).code, 0);
  EXPECT_EQ(folder_.read("again/result.json"), written) << "a result may not depend on the clock";
  const json statistics = result("out").at("facts").at("statistics").at("signals.csv");
  EXPECT_EQ(statistics.at("samples"), 15);
  EXPECT_EQ(statistics.at("mode_changes").at("switch"), 3);
}

TEST_F(Verbs, LinearizeTellsPolesBandwidthAndMarginsOfALoop) {
  // L = 100/s /(1 + s/100): |L| = 1 at w = 78.615 rad/s, where the phase margin is 51.83 deg; closed: w0 = 100 rad/s.
  folder_.write("servo.json", R"({
    "format": 1, "title": "Servo", "inputs": {"r": {"unit": "V"}},
    "blocks": {
      "error": {"type": "sum", "signs": "+-", "in": ["r", "stage"]},
      "controller": {"type": "integrator", "in": "error"},
      "drive": {"type": "gain", "gain": "100 1/s", "in": "controller"},
      "stage": {"type": "lag", "times": ["10 ms"], "in": "drive"}
    },
    "outputs": {"y": "stage"}})");
  const Outcome open =
      hysteron(folder_.path(), {"linearize", "servo.json", "--from", "error", "--open", "error", "-o", "open"});
  ASSERT_EQ(open.code, 0) << open.err;
  EXPECT_NE(open.out.find("error to stage, loop open: integrating (infinite gain at low frequencies)"),
            std::string::npos)
      << open.out;
  EXPECT_NE(open.out.find("Phase margin 51.83 deg at 12.51 Hz"), std::string::npos) << open.out;
  EXPECT_NE(open.out.find("The loop's gain is -3 dB at 15.92 Hz"), std::string::npos) << open.out;  // 100 rad/s
  EXPECT_NEAR(result("open").at("facts").at("closed_loop").at("closed_peak").get<double>(), 2 / std::sqrt(3.0), 1e-9);
  const Outcome closed = hysteron(folder_.path(), {"linearize", "servo.json", "-o", "closed"});
  ASSERT_EQ(closed.code, 0) << closed.err;
  EXPECT_NE(closed.out.find("r to stage: gain 1 at low frequencies"), std::string::npos) << closed.out;
  const json facts = result("closed").at("facts");
  // w0 = 100 rad/s, damping 0.5: -3 dB where (1 - v^2)^2 + v^2 = 2, v = w/w0
  EXPECT_NEAR(facts.at("bandwidth_hz").get<double>(), 100 * std::sqrt((1 + std::sqrt(5.0)) / 2) / (2 * M_PI), 1e-3);
  ASSERT_EQ(facts.at("poles_rad_per_s").size(), 2U);
  EXPECT_NEAR(facts.at("poles_rad_per_s")[0][0].get<double>(), -50, 1e-9);
  EXPECT_NEAR(std::abs(facts.at("poles_rad_per_s")[0][1].get<double>()), 50 * std::sqrt(3.0), 1e-9);
  const Outcome unknown = hysteron(folder_.path(), {"linearize", "servo.json", "--from", "eror"});
  EXPECT_EQ(unknown.code, 2);
  EXPECT_NE(unknown.err.find("error"), std::string::npos) << unknown.err;
}

TEST_F(Verbs, DrawWritesOneSvgFileWithTheBlocksOfTheDiagram) {
  folder_.write("sine.json", sine);
  const Outcome outcome = hysteron(folder_.path(), {"draw", "sine.json", "--set", "drive.amplitude=1.5 V"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "wrote sine.svg\n");
  const std::string svg = folder_.read("sine.svg");
  EXPECT_TRUE(svg.starts_with("<svg "));
  for (const char* part : {"data-block=\"drive\"", "data-block=\"double\"", "amplitude 1.5 V", "frequency 5 Hz"})
    EXPECT_NE(svg.find(part), std::string::npos) << part;
  ASSERT_EQ(hysteron(folder_.path(), {"draw", "sine.json", "-o", "again.svg", "--set", "drive.amplitude=1.5 V"}).code,
            0);
  EXPECT_EQ(folder_.read("again.svg"), svg);
}

TEST_F(Verbs, DrawWithoutGraphvizWritesNothingAndSaysHowToGetIt) {
  folder_.write("sine.json", sine);
  const Outcome outcome =
      process::shell(folder_.path(), "program=$(command -v hysteron); PATH=/nowhere; \"$program\" draw sine.json");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("apt install graphviz"), std::string::npos) << outcome.err;
  EXPECT_FALSE(folder_.has("sine.svg"));
}

TEST_F(Verbs, RunRecordsSignalsInTheirUnitsAtExactlyTheInstantsAskedFor) {
  folder_.write("sine.json", sine);
  const Outcome outcome = hysteron(folder_.path(), {"run", "sine.json", "--set", "drive.amplitude=1 V"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(outcome.out.ends_with("report: sine.run/report.html\n")) << outcome.out;
  const std::string trace = folder_.read("sine.run/traces/signals.csv");
  EXPECT_EQ(trace.substr(0, trace.find('\n')), "t [s],drive [V],double [V]");
  EXPECT_EQ(std::count(trace.begin(), trace.end(), '\n'), 22);  // header and 0, 10, ... 200 ms
  // sin(2 pi 5 Hz 0.05 s) = 1: the largest of the 21 values, and twice that behind the gain.
  const json signals = result("sine.run")["facts"]["traces"]["signals.csv"];
  EXPECT_NEAR(signals["drive"]["largest"].get<double>(), 1, 1e-12);
  EXPECT_NEAR(signals["double"]["largest"].get<double>(), 2, 1e-12);
  EXPECT_EQ(signals["double"]["unit"], "V");
}

TEST_F(Verbs, RunRecordsTheSignalsThatTheCommandNames) {
  folder_.write("sine.json", sine);
  const auto head_of = [&](const std::string& file) {
    const std::string trace = folder_.read(file);
    return trace.substr(0, trace.find('\n'));
  };
  ASSERT_EQ(hysteron(folder_.path(), {"run", "sine.json", "--record", "double", "-o", "one"}).code, 0);
  EXPECT_EQ(head_of("one/traces/signals.csv"), "t [s],double [V]");
  // Nothing reads "double" then, which is no fault of the file.
  const Outcome alone = hysteron(folder_.path(), {"run", "sine.json", "--record", "drive", "-o", "alone"});
  ASSERT_EQ(alone.code, 0) << alone.err;
  EXPECT_EQ(head_of("alone/traces/signals.csv"), "t [s],drive [V]");
  ASSERT_EQ(
      hysteron(folder_.path(), {"run", "diagram.json", "--data", "dataset.json", "--record", "all", "-o", "all"}).code,
      0);
  EXPECT_NE(head_of("all/traces/a.csv").find(",u [V]"), std::string::npos) << head_of("all/traces/a.csv");
  const Outcome outcome = hysteron(folder_.path(), {"run", "sine.json", "--record", "doubel"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("--record"), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find("sine.json"), std::string::npos) << "the file has no such signal: " << outcome.err;
  EXPECT_NE(outcome.err.find("Did you mean \"double\"?"), std::string::npos) << outcome.err;
}

TEST_F(Verbs, TheTitleOfAFigureNamesAVectorOnce) {
  folder_.write("three.json", R"({"format": 1, "title": "Three", "blocks": {
    "drive": {"type": "sine", "amplitude": "1 V", "frequency": "1 Hz"},
    "all": {"type": "mux", "in": ["drive", "drive", "drive"]},
    "twice": {"type": "gain", "gain": 2, "in": "all"}},
    "record": ["all", "twice"], "simulate": {"until": "1 s", "every": "0.5 s"}})");
  const Outcome outcome = hysteron(folder_.path(), {"run", "three.json", "-o", "out"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::string page = folder_.read("out/report.html");
  EXPECT_NE(page.find(">all, twice<"), std::string::npos);
  EXPECT_NE(page.find("twice[2]"), std::string::npos) << "the legend tells them apart";
}

TEST_F(Verbs, RunWritesTracesAsNumbersThatAreThoseOfTheText) {
  folder_.write("sine.json", sine);
  for (const char* form : {"csv", "f64"}) {
    const Outcome outcome = hysteron(folder_.path(), {"run", "sine.json", "--traces", form, "-o", form});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(schema::refuses("result", folder_.read(std::string(form) + "/result.json")), "");
  }
  const CsvTable text = read_result(folder_.path() + "/csv").traces.at(0);
  const CsvTable numbers = read_result(folder_.path() + "/f64").traces.at(0);
  EXPECT_EQ(numbers.file, "signals.f64");
  EXPECT_FALSE(folder_.has("f64/traces/signals.csv"));
  ASSERT_EQ(numbers.columns.size(), text.columns.size());
  ASSERT_EQ(numbers.rows(), 21U);
  for (std::size_t c = 0; c < text.columns.size(); ++c) {
    EXPECT_EQ(numbers.columns[c].name, text.columns[c].name);
    EXPECT_EQ(numbers.columns[c].unit.text, text.columns[c].unit.text);
    EXPECT_EQ(numbers.columns[c].values, text.columns[c].values) << "the text holds every bit, too";
  }
}

TEST_F(Verbs, TracesAsNumbersAreReadWhereverTextIs) {
  folder_.write("source.json", R"({
    "format": 1, "title": "Source",
    "blocks": {"u": {"type": "sine", "amplitude": "3 V", "frequency": "5 Hz"},
               "y": {"type": "gain", "gain": "2 um/V", "in": "u"}},
    "record": ["u", "y"], "simulate": {"until": "0.2 s", "every": "1 ms"}})");
  ASSERT_EQ(hysteron(folder_.path(), {"run", "source.json", "-o", "text"}).code, 0);
  ASSERT_EQ(hysteron(folder_.path(), {"run", "source.json", "--traces", "f64", "-o", "out"}).code, 0);
  const std::vector<std::vector<std::string>> commands{
      {"compare", "text/traces/signals.csv", "out/traces/signals.f64", "--tolerance", "1e-300 um"},
      {"check", "diagram.json", "--data", "out/traces/signals.f64"},
      {"run", "diagram.json", "--data", "out/traces/signals.f64"},
      {"new", "--from", "out/traces/signals.f64", "-o", "started"},
      {"compare", "started/diagram.json", "--data", "started/dataset.json"}};
  for (const auto& words : commands) {
    const Outcome outcome = hysteron(folder_.path(), words);
    EXPECT_EQ(outcome.code, 0) << words[0] << ": " << outcome.out << outcome.err;
  }
}

TEST_F(Verbs, CompareWritesTracesAsNumbersThatAreThoseOfTheText) {
  for (const char* form : {"csv", "f64"})
    ASSERT_EQ(
        hysteron(folder_.path(), {"compare", "diagram.json", "--data", "dataset.json", "--traces", form, "-o", form})
            .code,
        0);
  const auto text = read_result(folder_.path() + "/csv").traces, numbers = read_result(folder_.path() + "/f64").traces;
  ASSERT_EQ(text.size(), numbers.size());
  ASSERT_FALSE(text.empty());
  EXPECT_EQ(numbers[0].file, "a.f64");
  for (std::size_t k = 0; k < text.size(); ++k)
    for (std::size_t c = 0; c < text[k].columns.size(); ++c)
      EXPECT_EQ(numbers[k].columns[c].values, text[k].columns[c].values) << text[k].columns[c].name;
}

TEST_F(Verbs, RunRefusesAFormOfTracesThatThereIsNot) {
  const Outcome outcome = hysteron(folder_.path(), {"run", "diagram.json", "--data", "a.csv", "--traces", "float"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("write csv (text), or f64"), std::string::npos) << outcome.err;
}

TEST_F(Verbs, RunSaysNothingOfPartsThatTrain) {
  const Outcome run = hysteron(folder_.path(), {"run", "diagram.json", "--data", "a.csv", "-o", "ran"});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ((run.out + run.err).find("60 %"), std::string::npos) << run.out << run.err;
  const Outcome compared = hysteron(folder_.path(), {"compare", "diagram.json", "--data", "a.csv", "-o", "compared"});
  ASSERT_EQ(compared.code, 0) << compared.err;
  EXPECT_NE((compared.out + compared.err).find("60 %"), std::string::npos) << compared.out << compared.err;
}

TEST_F(Verbs, RunDrivesADiagramWithTheInputsOfRecordings) {
  const Outcome outcome = hysteron(folder_.path(), {"run", "diagram.json", "--data", "dataset.json", "-o", "out"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(folder_.has("out/traces/a.csv"));
  EXPECT_TRUE(folder_.has("out/traces/b.csv"));
  EXPECT_NEAR(result("out")["facts"]["traces"]["b.csv"]["sensor"]["largest"].get<double>(), 3.2,
              1e-9);  // 1.5 * 2 + 0.2 um
}

TEST_F(Verbs, CompareOfAPerfectModelIsWithinItsToleranceAndOfAWrongOneIsNot) {
  const std::vector<std::string> words{"compare", "diagram.json", "--data",      "dataset.json",
                                       "-o",      "out",          "--tolerance", "1 nm"};
  const Outcome good = hysteron(folder_.path(), words);
  EXPECT_EQ(good.code, 0) << good.err << good.out;
  auto wrong = words;
  wrong.insert(wrong.end(), {"--set", "gain=1.4 um/V"});
  const Outcome bad = hysteron(folder_.path(), wrong);
  EXPECT_EQ(bad.code, 1) << bad.err;
  EXPECT_NE(bad.out.find("OUTSIDE"), std::string::npos) << bad.out;
  EXPECT_EQ(result("out")["facts"]["within_tolerance"], false);
}

TEST_F(Verbs, CompareGivesTheFiguresOfAKnownError) {
  // The gain is too small by 0.1 um/V, so the residual is 0.1 um/V * u; u is a triangle 0..2 V whose rows repeat after
  // 0.5 s.
  const Outcome outcome = hysteron(
      folder_.path(), {"compare", "diagram.json", "--data", "dataset.json", "-o", "out", "--set", "gain=1.4 um/V"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  double sum = 0, sum_u = 0, sum_uu = 0;
  for (int i = 0; i < 150; ++i) {
    const double phase = 0.02 * i - std::floor(0.02 * i);
    const double u = phase < 0.5 ? 4 * phase : 4 - 4 * phase;
    sum += 0.01 * u * u;
    sum_u += u;
    sum_uu += u * u;
  }
  const double rms = std::sqrt(sum / 150);
  const double deviation = 1.5 * std::sqrt(sum_uu / 150 - (sum_u / 150) * (sum_u / 150));
  bool seen = false;
  const json metrics = result("out")["facts"]["metrics"];
  for (const auto& m : metrics) {
    if (m["recording"] != "b.csv") continue;
    seen = true;
    EXPECT_NEAR(m["rms"].get<double>(), rms, 1e-6);  // the CSV has six digits
    EXPECT_NEAR(m["peak"].get<double>(), 0.2, 1e-6);
    EXPECT_NEAR(m["nrmse"].get<double>(), rms / deviation, 1e-5);
    EXPECT_NEAR(m["fit_percent"].get<double>(), 100 * (1 - rms / deviation), 1e-3);
    EXPECT_EQ(m["unit"], "um");
    EXPECT_EQ(m["rows"], 150);
  }
  EXPECT_TRUE(seen);
}

TEST_F(Verbs, SharesOfEverySplitAddUpToAHundredPercent) {
  ASSERT_EQ(hysteron(folder_.path(),
                     {"compare", "diagram.json", "--data", "dataset.json", "-o", "out", "--set", "gain=1.4 um/V"})
                .code,
            0);
  const json splits = result("out")["facts"]["splits"];
  std::vector<std::string> by;
  for (const auto& split : splits) {
    double error = 0, rows = 0;
    for (const auto& part : split["parts"]) {
      error += part["share_of_squared_error"].get<double>();
      rows += part["share_of_rows"].get<double>();
      EXPECT_EQ(part["spans"].empty(), split["by"] == "frequency" || part["share_of_rows"] == 0) << part;
    }
    EXPECT_NEAR(error, 1, 1e-9) << split;
    EXPECT_NEAR(rows, 1, 1e-9) << split;
    by.push_back(split["by"]);
  }
  for (const char* variable : {"time", "level", "branch", "rate", "cycle"})
    EXPECT_NE(std::find(by.begin(), by.end(), variable), by.end()) << variable;
}

TEST_F(Verbs, AddPrintsTheChangeAndRemoveUndoesItToTheLetter) {
  const Outcome shown = hysteron(folder_.path(), {"add", "creep", "diagram.json", "--at", "actuator"});
  ASSERT_EQ(shown.code, 0) << shown.err;
  EXPECT_NE(shown.out.find("+    \"actuator_creep\""), std::string::npos) << shown.out;
  EXPECT_FALSE(folder_.has("next.json"));

  ASSERT_EQ(hysteron(folder_.path(), {"add", "creep", "diagram.json", "--at", "actuator", "-o", "next.json"}).code, 0);
  EXPECT_EQ(hysteron(folder_.path(), {"check", "next.json"}).code, 0);
  ASSERT_EQ(hysteron(folder_.path(), {"remove", "creep", "next.json", "-o", "back.json"}).code, 0);
  // Written by the same writer from the same value: compare with the original after one pass through the writer.
  ASSERT_EQ(hysteron(folder_.path(), {"add", "dead_time", "diagram.json", "-o", "a.json"}).code, 0);
  ASSERT_EQ(hysteron(folder_.path(), {"remove", "dead_time", "a.json", "-o", "once.json"}).code, 0);
  EXPECT_EQ(folder_.read("back.json"), folder_.read("once.json"));
}

TEST_F(Verbs, AnEffectSwitchedOffGivesTheModelWithoutIt) {
  ASSERT_EQ(hysteron(folder_.path(), {"add", "creep", "diagram.json", "--at", "actuator", "-o", "next.json"}).code, 0);
  const Outcome off = hysteron(folder_.path(), {"compare", "next.json", "--data", "dataset.json", "--choose",
                                                "actuator_creep=off", "--tolerance", "1 nm", "-o", "off"});
  EXPECT_EQ(off.code, 0) << off.err << off.out;
  const Outcome on =
      hysteron(folder_.path(), {"compare", "next.json", "--data", "dataset.json", "--tolerance", "1 nm", "-o", "on"});
  EXPECT_EQ(on.code, 1) << on.err << on.out;
}

TEST_F(Verbs, NewWritesAStarterThatFitsAStraightLineAndSaysWhatItAssumed) {
  const Outcome outcome = hysteron(folder_.path(), {"new", "--from", "a.csv", "-o", "stage"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  for (const char* file : {"stage/diagram.json", "stage/dataset.json", "stage/hysteron.project", "stage/a.csv"})
    EXPECT_TRUE(folder_.has(file)) << file;
  for (const char* said : {"inputs, by their names: u", "measured outputs, by their names: y", "60 %"})
    EXPECT_NE(outcome.out.find(said), std::string::npos) << said << "\n" << outcome.out;
  EXPECT_EQ(hysteron(folder_.path(), {"check", "stage/diagram.json", "--data", "stage/dataset.json"}).code, 0);
  // The recording is a straight line: the starter describes it, to the five digits that it writes.
  const Outcome compared = hysteron(folder_.path(), {"compare", "stage/diagram.json", "--data", "stage/dataset.json",
                                                     "-o", "out", "--tolerance", "0.1 nm"});
  EXPECT_EQ(compared.code, 0) << compared.out << compared.err;
  // A second time it would overwrite.
  EXPECT_EQ(hysteron(folder_.path(), {"new", "--from", "a.csv", "-o", "stage"}).code, 2);
}

TEST_F(Verbs, NewKeepsATemperatureATemperature) {
  // T = 20 degC + 0.5 K/% u: in kelvin 293.15 K, which the starter must not lose.
  std::string text = "t [s],u1 [%],T1 [degC]\n";
  for (int i = 0; i < 50; ++i) text += std::to_string(i) + "," + (i < 20 ? "0,20\n" : i < 40 ? "50,45\n" : "10,25\n");
  folder_.write("heater.csv", text);
  const Outcome made = hysteron(folder_.path(), {"new", "--from", "heater.csv", "-o", "heater"});
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_NE(made.out.find("held between samples"), std::string::npos) << made.out;
  const Outcome compared = hysteron(folder_.path(), {"compare", "heater/diagram.json", "--data", "heater/dataset.json",
                                                     "-o", "out", "--tolerance", "0.001 K"});
  EXPECT_EQ(compared.code, 0) << compared.out << compared.err;
}

TEST_F(Verbs, TheSameInputGivesTheSameResult) {
  for (const char* out : {"one", "two"})
    ASSERT_EQ(hysteron(folder_.path(),
                       {"compare", "diagram.json", "--data", "dataset.json", "--set", "gain=1.4 um/V", "-o", out})
                  .code,
              0);
  EXPECT_EQ(folder_.read("one/result.json"), folder_.read("two/result.json"));
  EXPECT_EQ(folder_.read("one/traces/a.csv"), folder_.read("two/traces/a.csv"));
}

TEST_F(Verbs, WhatIsWrittenSatisfiesTheShippedSchemas) {
  folder_.write("sine.json", sine);
  ASSERT_EQ(hysteron(folder_.path(), {"run", "sine.json", "-o", "ran"}).code, 0);
  ASSERT_EQ(hysteron(folder_.path(), {"compare", "diagram.json", "--data", "dataset.json", "-o", "compared"}).code, 0);
  ASSERT_EQ(hysteron(folder_.path(), {"fit", "diagram.json", "--data", "dataset.json", "-o", "fitted"}).code, 0);
  ASSERT_EQ(hysteron(folder_.path(), {"new", "--from", "a.csv", "-o", "stage"}).code, 0);
  ASSERT_EQ(hysteron(folder_.path(), {"add", "creep", "diagram.json", "-o", "next.json"}).code, 0);
  for (const char* file : {"ran/result.json", "compared/result.json", "fitted/result.json"})
    EXPECT_EQ(schema::refuses("result", folder_.read(file)), "") << file;
  for (const char* file : {"stage/diagram.json", "fitted/fitted.json", "next.json"})
    EXPECT_EQ(schema::refuses("diagram", folder_.read(file)), "") << file;
  EXPECT_EQ(schema::refuses("dataset", folder_.read("stage/dataset.json")), "");
  EXPECT_NE(schema::refuses("result", "{\"format\": 1}"), "") << "the schema takes anything";
}

TEST_F(Verbs, ATestRecordingIsNotLookedAtByCompare) {
  std::string text = lab::dataset();
  text.replace(text.find("\"validate\"}"), 11, "\"validate\"},\n    {\"file\": \"c.csv\", \"role\": \"test\"}");
  folder_.write("dataset.json", text);
  folder_.write("c.csv", lab::recording(100, 50));  // 50 um off: it would be seen
  ASSERT_EQ(hysteron(folder_.path(),
                     {"compare", "diagram.json", "--data", "dataset.json", "--tolerance", "1 nm", "-o", "out"})
                .code,
            0);
  EXPECT_FALSE(folder_.has("out/traces/c.csv"));
}

TEST_F(Verbs, CompareSaysWhereTheDataLeaveNothingToJudge) {
  folder_.write("tests.json", R"({"format": 1, "recordings": [{"file": "a.csv", "role": "test"},
                                                            {"file": "b.csv", "role": "test"}]})");
  for (const auto& words : {std::vector<std::string>{"--tolerance", "1 nm"}, std::vector<std::string>{}}) {
    std::vector<std::string> all{"compare", "diagram.json", "--data", "tests.json", "-o", "out"};
    all.insert(all.end(), words.begin(), words.end());
    const Outcome outcome = hysteron(folder_.path(), all);
    EXPECT_EQ(outcome.code, 2) << outcome.out;
    EXPECT_NE(outcome.err.find("2 recordings of the role \"test\""), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("the role \"validate\""), std::string::npos) << outcome.err;
    EXPECT_FALSE(folder_.has("out"));
  }
  folder_.write("train.json", R"({"format": 1, "recordings": [{"file": "a.csv", "role": "train"},
                                                            {"file": "b.csv", "role": "train"}]})");
  const Outcome train = hysteron(folder_.path(), {"compare", "diagram.json", "--data", "train.json", "-o", "out"});
  EXPECT_EQ(train.code, 0) << train.err;
  EXPECT_NE(train.out.find("On the train recordings"), std::string::npos) << train.out;
}

TEST_F(Verbs, ADiagramIsWrittenOverDiagramsOnly) {
  folder_.write("inner.json", lab::diagram());
  folder_.write("outer.json", R"({"format": 1, "inputs": {"u": {"unit": "V"}},
    "blocks": {"stage": {"type": "diagram", "file": "inner.json", "in": "u"}}, "outputs": {"y": "stage"}})");
  const auto refuses = [&](std::vector<std::string> words, const std::string& file) {
    const std::string before = folder_.read(file);
    words.push_back(file);
    const Outcome outcome = hysteron(folder_.path(), words);
    EXPECT_EQ(outcome.code, 2) << file << outcome.out;
    EXPECT_NE(outcome.err.find(file), std::string::npos) << outcome.err;
    EXPECT_EQ(folder_.read(file), before);
  };
  refuses({"add", "creep", "diagram.json", "-o"}, "a.csv");
  refuses({"add", "creep", "diagram.json", "-o"}, "dataset.json");
  refuses({"add", "creep", "outer.json", "-o"}, "inner.json");
  ASSERT_EQ(hysteron(folder_.path(), {"add", "creep", "diagram.json", "-o", "next.json"}).code, 0);
  refuses({"remove", "creep", "next.json", "-o"}, "a.csv");
  refuses({"fit", "diagram.json", "--data", "a.csv", "-o", "out", "--write"}, "a.csv");
  refuses({"fit", "diagram.json", "--data", "dataset.json", "-o", "out", "--write"}, "dataset.json");
  EXPECT_FALSE(folder_.has("out"));
  EXPECT_EQ(hysteron(folder_.path(), {"remove", "creep", "next.json", "-o", "next.json"}).code, 0);  // its own
}

TEST_F(Verbs, NamesOfNestedDiagramsAndOfNumbersBehindOthersAreTakenEverywhere) {
  folder_.write("axis.json",
                R"({"format": 1, "title": "axis", "parameters": {"k": {"value": 2}}, "inputs": {"u": {"unit": "V"}},
    "blocks": {"g": {"type": "gain", "gain": "$k", "in": "u"}, "l": {"type": "lag", "times": ["1 ms"], "in": "g"}},
    "outputs": {"pos": "l", "raw": "g"}})");
  folder_.write(
      "two.json",
      R"({"format": 1, "title": "two", "blocks": {"r": {"type": "sine", "amplitude": "1 V", "frequency": "5 Hz"},
    "x": {"type": "diagram", "file": "axis.json", "in": "r"}},
    "record": ["r", "x.pos", "x.raw"], "simulate": {"until": "0.2 s", "every": "1 ms"}})");
  for (const char* name : {"x.k", "x/k", "x/g.gain"}) {
    const Outcome set = hysteron(folder_.path(), {"run", "two.json", "--set", std::string(name) + "=3", "-o", "out"});
    ASSERT_EQ(set.code, 0) << name << set.err;
    EXPECT_NEAR(result("out")["facts"]["traces"]["signals.csv"]["x/g"]["largest"].get<double>(), 3, 1e-6) << name;
  }
  const Outcome lin = hysteron(folder_.path(), {"linearize", "two.json", "--from", "r", "--to", "x.pos", "-o", "lin"});
  ASSERT_EQ(lin.code, 0) << lin.err;
  EXPECT_NEAR(result("lin")["facts"]["gain_at_low_frequencies"].get<double>(), 2, 1e-9);
  const Outcome alone = hysteron(folder_.path(), {"check", "axis.json", "--set", "g.gain=3"});
  EXPECT_EQ(alone.code, 0) << alone.err;  // nobody says that k is not read
}

TEST_F(Verbs, ABlockTypeThatIsCalledOtherwiseElsewhereIsToldWithWhatToWrite) {
  folder_.write("half.json", R"({"format": 1, "title": "half", "blocks": {"b": {"type": "constant", "value": 1},
    "a": {"type": "half_wave", "in": "b"}}, "record": ["a"]})");
  const Outcome outcome = hysteron(folder_.path(), {"check", "half.json"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("\"rectifier\""), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find("half_sine"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("hysteron blocks"), std::string::npos) << outcome.err;
  EXPECT_LT(outcome.err.size(), 400U) << "no list of ninety types";
}

}  // namespace
}  // namespace hysteron
