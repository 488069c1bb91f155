// Bad input never crashes and never passes silently: for each kind, the code, the place, the cure and the exit code of
// the program, and nothing left behind.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/app/hysteron_process.h"
#include "tests/app/lab.h"

namespace hysteron {
namespace {

using process::Folder;
using process::Outcome;

struct Case {
  const char* name;
  std::vector<std::string> words;  ///< the command line
  const char* file;                ///< the file that is spoiled ("" = none)
  std::string content;             ///< what it holds then
  const char* code;                ///< expected
  const char* place;               ///< part of path or file of the problem
  const char* cure;                ///< part of the cure
  int exit_code = 2;
  int line = 0;  ///< expected line, 0 = not asked
};

std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }

/// The working diagram with one text replaced; the test fails loudly if the text is not there.
std::string diagram_with(const std::string& old_text, const std::string& new_text) {
  std::string text = lab::diagram();
  const auto at = text.find(old_text);
  if (at == std::string::npos) return "the laboratory has no " + old_text;
  return text.replace(at, old_text.size(), new_text);
}
std::string dataset_with(const std::string& old_text, const std::string& new_text) {
  std::string text = lab::dataset();
  const auto at = text.find(old_text);
  if (at == std::string::npos) return "the laboratory has no " + old_text;
  return text.replace(at, old_text.size(), new_text);
}
std::string csv_with_row(const std::string& row) {
  return "t [s],u [V],y [um]\n0,0,0\n1,1,1\n" + row + "\n3,1,1\n4,2,2\n";
}

/// A recording whose y stays while u moves.
std::string still_csv() {
  std::string text = "t [s],u [V],y [um]\n";
  for (int i = 0; i < 40; ++i) text += std::to_string(0.01 * i) + "," + std::to_string(i % 7) + ",0.5\n";
  return text;
}

std::string closed_loop(const std::string& loop) {
  return R"({"format": 1, "title": "loop", "blocks": {
    "drive": {"type": "step", "before": 0, "after": 1, "time": "0.1 s"},
    )" + loop +
         R"(},
    "record": ["error"], "simulate": {"until": "1 s", "loops": "error"}})";
}

const std::vector<std::string> check{"check", "diagram.json"};
const std::vector<std::string> check_data{"check", "diagram.json", "--data", "dataset.json"};
const std::vector<std::string> compare{"compare", "diagram.json", "--data", "dataset.json", "-o", "out"};
const std::vector<std::string> compare_csv{"compare", "diagram.json", "--data", "a.csv", "-o", "out"};
const std::vector<std::string> run{"run", "diagram.json", "-o", "out"};

std::vector<Case> cases() {
  return {
      // The diagram as a file
      {"BrokenJson", check, "diagram.json", "{\"format\": 1,\n \"blocks\": {,}}", "bad_json", "diagram.json", "", 2, 2},
      {"EmptyDiagramFile", check, "diagram.json", "", "empty_file", "diagram.json", ""},
      {"NoSuchDiagram", {"check", "digram.json"}, "", "", "no_file", "digram.json", ""},
      {"AFolderAsDiagram", {"check", "."}, "", "", "is_directory", ".", ""},
      {"ADeviceAsDiagram", {"check", "/dev/full"}, "", "", "not_a_file", "/dev/full", ""},
      {"ANewerFormat", check, "diagram.json", diagram_with("\"format\": 1", "\"format\": 2"), "newer_format", "/format",
       ""},
      {"UnknownKey", check, "diagram.json", diagram_with("\"outputs\"", "\"outptus\""), "unknown_key", "outptus",
       "outputs"},
      {"DuplicateKey", check, "diagram.json", diagram_with("\"sensor\": ", "\"actuator\": "), "duplicate_key",
       "actuator", ""},
      {"PathOutsideTheProject", check, "diagram.json",
       diagram_with("{\"type\": \"calibration\", \"gain\": 1, \"offset\": \"0.2 um\"",
                    "{\"type\": \"diagram\", \"file\": \"../../etc/passwd\""),
       "outside_project", "sensor", "--allow"},

      // Names and values
      {"UnknownBlock", check, "diagram.json", diagram_with("\"type\": \"gain\"", "\"type\": \"gian\""), "unknown_block",
       "/blocks/actuator", "gain", 2, 7},
      {"UnknownParameter", check, "diagram.json",
       diagram_with("\"gain\": \"$gain\"", "\"gain\": \"$gain\", \"gani\": 2"), "unknown_parameter",
       "/blocks/actuator/gani", "gain", 2, 7},
      {"MissingParameter", check, "diagram.json", diagram_with("\"gain\": \"$gain\", ", ""), "missing_parameter",
       "/blocks/actuator", "gain", 2, 7},
      {"UnknownReference", check, "diagram.json", diagram_with("\"$gain\"", "\"$gian\""), "unknown_reference",
       "/blocks/actuator/gain", "gain", 2, 7},
      {"TextForANumber", check, "diagram.json", diagram_with("\"$gain\"", "\"big\""), "wrong_type",
       "/blocks/actuator/gain", ""},
      {"UnitThatDoesNotExist", check, "diagram.json", diagram_with("0.2 um", "0.2 umm"), "bad_unit",
       "/blocks/sensor/offset", ""},
      {"WrongUnit", check, "diagram.json", diagram_with("0.2 um", "0.2 V"), "wrong_unit", "/blocks/sensor", "", 2, 8},
      {"GainInAForeignUnit", check, "diagram.json", diagram_with("\"unit\": \"um/V\"", "\"unit\": \"s\""), "wrong_unit",
       "", ""},

      // Wires
      {"UnknownSignal", check, "diagram.json", diagram_with("\"in\": \"actuator\"", "\"in\": \"actuatr\""),
       "unknown_signal", "/blocks/sensor", "actuator", 2, 8},
      {"MissingConnection", check, "diagram.json", diagram_with(", \"in\": \"actuator\"", ""), "missing_connection",
       "/blocks/sensor", "", 2, 8},
      {"DoubleConnection", check, "diagram.json", diagram_with("\"in\": \"actuator\"", "\"in\": [\"actuator\", \"u\"]"),
       "unknown_input", "/blocks/sensor", "", 2, 8},
      {"UnusedBlock", check, "diagram.json",
       diagram_with("\"actuator\": {",
                    "\"spare\": {\"type\": \"gain\", \"gain\": 2, \"in\": \"u\"},\n    \"actuator\": {"),
       "unused_block", "/blocks/spare", "", 2, 7},
      {"UnknownSignalInRecord", check, "diagram.json", diagram_with("[\"actuator\", \"sensor\"]", "[\"sensr\"]"),
       "unknown_signal", "/record", "sensor"},
      {"AlgebraicLoop", check, "diagram.json",
       closed_loop(
           R"("error": {"type": "sum", "signs": "+-", "in": ["drive", "back"]}, "back": {"type": "gain", "gain": 2, "in": "error"})"),
       "algebraic_loop", "/blocks/", "lag"},
      {"RateOfNoiseAtALaw", check, "diagram.json",
       R"({"format": 1, "title": "noise", "blocks": {
         "drive": {"type": "sine", "amplitude": "1 V", "frequency": "1 Hz"},
         "noisy": {"type": "sensor_noise", "rms": "0.1 V", "period": "1 ms", "seed": 1, "in": "drive"},
         "core": {"type": "bouc_wen", "alpha": "0.6187 um/V", "beta": "0.2418 1/V", "gamma": "0.0237 1/V", "d_p": "1.6126 um/V", "in": "noisy"}},
         "record": ["core"], "simulate": {"until": "1 s"}})",
       "rate_of_nondifferentiable", "core", "lag"},

      // Choices and settings from the command line
      {"UnknownSetting", {"check", "diagram.json", "--set", "gian=2"}, "", "", "unknown_parameter", "gian", "gain"},
      {"SettingWithoutValue", {"check", "diagram.json", "--set", "gain"}, "", "", "bad_command_line", "--set", "="},
      {"UnknownChoice",
       {"check", "diagram.json", "--choose", "actuator=on"},
       "",
       "",
       "bad_choice",
       "actuator",
       "choose"},
      {"UnknownVerb", {"comapre", "diagram.json"}, "", "", "unknown_verb", "comapre", "compare"},
      {"UnknownOption", {"check", "diagram.json", "--dta", "a.csv"}, "", "", "bad_command_line", "check", "--data"},
      {"MissingOption", {"compare", "diagram.json"}, "", "", "bad_command_line", "compare", "--help"},
      {"PictureThatIsNoSvg", {"draw", "diagram.json", "-o", "a.png"}, "", "", "bad_command_line", "-o", ".svg"},
      {"DepthThatIsNone",
       {"draw", "diagram.json", "--depth", "1.5"},
       "",
       "",
       "bad_command_line",
       "--depth",
       "--depth 1"},
      {"NoDiagramGiven", {"check"}, "", "", "bad_command_line", "check", "--help"},
      {"TimeThatIsNone",
       {"run", "diagram.json", "--until", "2 V"},
       "diagram.json",
       R"({"format": 1, "blocks": {"drive": {"type": "sine", "amplitude": 1, "frequency": 1}}, "record": ["drive"]})",
       "bad_command_line",
       "--until",
       "ms"},
      {"ToleranceThatIsNone",
       {"compare", "diagram.json", "--data", "a.csv", "--tolerance", "small"},
       "",
       "",
       "bad_command_line",
       "--tolerance",
       "5%"},
      {"ToleranceInAForeignUnit",
       {"compare", "diagram.json", "--data", "dataset.json", "--tolerance", "2 kg"},
       "",
       "",
       "wrong_unit",
       "--tolerance",
       "um"},
      {"UnknownBlockTypeAsked", {"blocks", "bouc_wenn"}, "", "", "unknown_block", "bouc_wenn", "bouc_wen"},
      {"UnknownEffectAsked", {"effects", "crep"}, "", "", "unknown_effect", "crep", "creep"},

      // Recordings
      {"TextInAColumn", compare_csv, "a.csv", csv_with_row("2,two,1"), "bad_number", "u", "", 2, 4},
      {"NanInAColumn", compare_csv, "a.csv", csv_with_row("2,1,nan"), "bad_number", "y", "", 2, 4},
      {"ShortRow", compare_csv, "a.csv", csv_with_row("2,1"), "row_length", "a.csv", "", 2, 4},
      {"DecreasingTime", compare_csv, "a.csv", csv_with_row("0.5,1,1"), "decreasing_time", "t", "", 2, 4},
      {"RepeatedTime", compare_csv, "a.csv", csv_with_row("1,1,1"), "decreasing_time", "t", "", 2, 4},
      {"MissingColumn", compare_csv, "a.csv", "t [s],y [um]\n0,0\n1,1\n2,0\n3,1\n4,1\n5,1\n6,1\n7,1\n",
       "missing_column", "u", ""},
      {"NoMeasuredColumn", compare_csv, "a.csv", "t [s],u [V]\n0,0\n1,1\n2,0\n3,1\n4,1\n5,1\n6,1\n7,1\n",
       "missing_column", "y", ""},
      {"NoTimeColumn", compare_csv, "a.csv", "u [V],y [um]\n0,0\n1,1\n2,0\n3,1\n", "missing_column", "t", ""},
      {"ColumnInAForeignUnit", compare_csv, "a.csv",
       "t [s],u [V],y [kg]\n0,0,0\n1,1,1\n2,0,0\n3,1,1\n4,1,1\n5,1,1\n6,1,1\n", "wrong_unit", "y", ""},
      {"EmptyRecording", compare_csv, "a.csv", "", "empty_file", "a.csv", ""},
      {"TooFewRows", compare_csv, "a.csv", "t [s],u [V],y [um]\n0,0,0\n1,1,1\n", "too_few_rows", "a.csv", ""},
      {"AFolderAsData", {"compare", "diagram.json", "--data", "."}, "", "", "is_directory", ".", ""},
      {"NoSuchData", {"compare", "diagram.json", "--data", "b1.csv"}, "", "", "no_file", "b1.csv", ""},
      {"RoleMisspelt", check_data, "dataset.json", dataset_with("\"validate\"", "\"valdate\""), "unknown_role",
       "/recordings/1/role", "validate", 2, 6},
      {"RecordingThatIsNotThere", check_data, "dataset.json", dataset_with("b.csv", "c.csv"), "no_file",
       "/recordings/1/file", "path"},
      {"BrokenDataSet", check_data, "dataset.json", "{\"format\": 1,", "bad_json", "dataset.json", ""},
      {"NewWithoutATimeColumn",
       {"new", "--from", "a.csv", "-o", "made"},
       "a.csv",
       "u [V],y [um]\n0,0\n1,1\n2,0\n3,1\n",
       "missing_column",
       "t",
       "t [s]"},
      {"NewWithUnclearColumns",
       {"new", "--from", "a.csv", "-o", "made"},
       "a.csv",
       "t [s],foo,bar\n0,0,0\n1,1,1\n2,0,0\n3,1,1\n",
       "unclear_columns",
       "a.csv",
       "--input"},

      // Running
      {"NothingSaysUntilWhen", run, "diagram.json",
       R"({"format": 1, "title": "no end", "blocks": {"drive": {"type": "sine", "amplitude": "1 V", "frequency": "5 Hz"}}, "record": ["drive"]})",
       "no_end_time", "/simulate/until", "--until"},
      {"NobodyDrivesTheInput", run, "", "", "unbound_input", "u", "--data"},
      {"ADivergingSimulation", run, "diagram.json",
       R"({"format": 1, "title": "runaway", "blocks": {
         "kick": {"type": "constant", "value": 1},
         "error": {"type": "sum", "in": ["kick", "square"]},
         "level": {"type": "integrator", "in": "error"},
         "square": {"type": "product", "in": {"a": "rate", "b": "rate"}},
         "rate": {"type": "gain", "gain": "1 1/s", "in": "level"}},
         "record": ["level"], "simulate": {"until": "10 s"}})",
       "diverged", "", "", 3},
      {"AnImpossibleFolder",
       {"compare", "diagram.json", "--data", "dataset.json", "-o", "/dev/full"},
       "",
       "",
       "",
       "/dev/full",
       ""},
      {"AFolderWhereNothingCanBeMade",
       {"run", "diagram.json", "--data", "dataset.json", "-o", "/proc/x"},
       "",
       "",
       "cannot_write",
       "/proc/x",
       "-o"},
      {"AFolderOfSomebodyElse",
       {"compare", "diagram.json", "--data", "dataset.json", "-o", "."},
       "",
       "",
       "folder_in_use",
       ".",
       "-o"},
      {"AFullDiskForADiagram",
       {"add", "creep", "diagram.json", "-o", "/dev/full"},
       "",
       "",
       "cannot_write",
       "/dev/full",
       ""},
      {"DiscoverOnAnOutputThatNeverMoves",
       {"discover", "diagram.json", "--data", "a.csv"},
       "a.csv",
       still_csv(),
       "never_moves",
       "a.csv",
       "sensor"},
      {"DiagnoseOnAnOutputThatNeverMoves",
       {"diagnose", "diagram.json", "--data", "a.csv"},
       "a.csv",
       still_csv(),
       "never_moves",
       "a.csv",
       "sensor"},
      {"CheckOnAnOutputThatNeverMoves",
       {"discover", "diagram.json", "--data", "a.csv", "--check"},
       "a.csv",
       still_csv(),
       "never_moves",
       "a.csv",
       "sensor"},
      {"FitToAnOutputThatNeverMoves",
       {"fit", "diagram.json", "--data", "a.csv"},
       "a.csv",
       still_csv(),
       "never_moves",
       "a.csv",
       "sensor"},
      {"ANumberThatNoInstrumentGives", compare_csv, "a.csv", csv_with_row("2,-1e200,1"), "bad_number", "u", "row", 2,
       4},
      {"AStarterOfNumbersThatNoInstrumentGives",
       {"new", "--from", "a.csv", "-o", "stage"},
       "a.csv",
       csv_with_row("2,1,1e101"),
       "bad_number",
       "y",
       "row",
       2,
       4},
      {"AFileWhereAFolderIsMeant",
       {"compare", "diagram.json", "--data", "dataset.json", "-o", "a.csv"},
       "",
       "",
       "cannot_write",
       "a.csv",
       "name a folder"},
      {"AFileWithoutAName", {"check", ""}, "", "", "no_file", "", "name of a file"},
      {"ASeedThatIsNoNumber",
       {"fit", "diagram.json", "--data", "dataset.json", "--seed", "x"},
       "",
       "",
       "bad_command_line",
       "--seed",
       "--seed=4"},
      {"NoEffectAlone",
       {"discover", "diagram.json", "--data", "dataset.json", "--only", ""},
       "",
       "",
       "bad_command_line",
       "--only",
       "hysteron effects"},
      {"TheTimeAsDrive",
       {"new", "--from", "a.csv", "--input", "t", "--output", "y", "-o", "stage"},
       "",
       "",
       "bad_command_line",
       "--input",
       "drives"},
      {"AColumnInAnotherCase",
       {"new", "--from", "a.csv", "--input", "i", "-o", "stage"},
       "a.csv",
       "t [s],T [degC],I [A],X [um]\n0,1,1,1\n1,2,2,3\n2,3,3,4\n",
       "missing_column",
       "a.csv",
       "Did you mean \"I\"?"},
      {"DecimalComma", check, "diagram.json", diagram_with("0.2 um", "0,2 um"), "bad_unit", "/blocks/sensor/offset",
       "point"},
      {"ADiagramOverARecording",
       {"add", "creep", "diagram.json", "-o", "a.csv"},
       "",
       "",
       "file_in_use",
       "-o",
       "next.json"},
      {"ADiagramThatIsNotCalledJson",
       {"remove", "creep", "diagram.json", "-o", "next.txt"},
       "",
       "",
       "bad_command_line",
       "-o",
       "next.json"},
      {"AnEffectWithoutSuchAPlace",
       {"add", "creep", "diagram.json", "--at", "actuatr"},
       "",
       "",
       "unknown_place",
       "actuatr",
       "actuator"},
      {"AToleranceOfFiveTimesTheSignal",
       {"compare", "diagram.json", "--data", "dataset.json", "--tolerance", "5"},
       "",
       "",
       "bad_command_line",
       "--tolerance",
       "5%"},
      {"NoTimeAtAll",
       {"discover", "diagram.json", "--data", "dataset.json", "--within", "0 s"},
       "",
       "",
       "bad_command_line",
       "--within",
       "2 min"},
      {"AllowingAFolderThatIsNotThere",
       {"compare", "diagram.json", "--data", "dataset.json", "--allow", "nowhere"},
       "",
       "",
       "bad_command_line",
       "--allow",
       "exists"},
      {"RemovingWhatIsNotThere", {"remove", "creep", "diagram.json"}, "", "", "unknown_effect", "creep", ""},
  };
}

class BadInput : public testing::TestWithParam<Case> {};

TEST_P(BadInput, IsToldWithCodePlaceAndCureAndLeavesNothingBehind) {
  const Case& c = GetParam();
  const Folder folder;
  lab::furnish(folder);
  if (*c.file != '\0') folder.write(c.file, c.content);
  const auto before = folder.entries();

  auto words = c.words;
  words.insert(words.end(), {"--errors", "json"});
  const Outcome outcome = process::hysteron(folder.path(), words);
  ASSERT_EQ(outcome.code, c.exit_code) << outcome.out << outcome.err;
  const auto told = nlohmann::json::parse(outcome.err, nullptr, false);
  ASSERT_FALSE(told.is_discarded()) << outcome.err;
  EXPECT_EQ(told["exit_code"], c.exit_code);
  bool found = false;
  for (const auto& problem : told["problems"]) {
    EXPECT_FALSE(problem["cure"].get<std::string>().empty()) << problem;
    EXPECT_FALSE(problem["what"].get<std::string>().empty()) << problem;
    const std::string place = problem["path"].get<std::string>() + " " + problem.value("file", "");
    found = found || ((*c.code == '\0' || problem["code"] == c.code) && place.find(c.place) != std::string::npos &&
                      problem["cure"].get<std::string>().find(c.cure) != std::string::npos &&
                      (c.line == 0 || problem.value("line", 0) == c.line));
  }
  EXPECT_TRUE(found) << "expected " << c.code << " at " << c.place << " line " << c.line << ", cure " << c.cure
                     << "; told\n"
                     << outcome.err;
  EXPECT_EQ(folder.entries(), before) << "something was left behind";
}

INSTANTIATE_TEST_SUITE_P(Table, BadInput, testing::ValuesIn(cases()),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST(BadInputAsText, NamesFileLinePlaceWhatAndCure) {
  const Folder folder;
  lab::furnish(folder);
  folder.write("diagram.json", diagram_with("\"type\": \"gain\"", "\"type\": \"gian\""));
  const Outcome outcome = process::hysteron(folder.path(), {"check", "diagram.json"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("diagram.json:7: /blocks/actuator"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("Did you mean \"gain\""), std::string::npos) << outcome.err;
  EXPECT_TRUE(outcome.out.empty()) << outcome.out;
}

TEST(BadInputAsText, TellsAllProblemsOfAStageTogether) {
  const Folder folder;
  lab::furnish(folder);
  std::string text = diagram_with("\"type\": \"gain\"", "\"type\": \"gian\"");
  text.replace(text.find("\"calibration\""), 13, "\"calibratoin\"");
  folder.write("diagram.json", text);
  const Outcome outcome = process::hysteron(folder.path(), {"check", "diagram.json"});
  EXPECT_NE(outcome.err.find("/blocks/actuator"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("/blocks/sensor"), std::string::npos) << outcome.err;
}

TEST(DivergingSimulation, NamesBlockTimeAndState) {
  // dx/dt = 1 + x^2 from 0 is tan t: it leaves every bound at t = pi/2.
  const Folder folder;
  for (const auto& c : cases())
    if (std::string(c.name) == "ADivergingSimulation") folder.write("diagram.json", c.content);
  const Outcome outcome = process::hysteron(folder.path(), run);
  EXPECT_EQ(outcome.code, 3);
  EXPECT_NE(outcome.err.find("level"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("1.57"), std::string::npos) << outcome.err;
  EXPECT_FALSE(folder.has("out"));
}

TEST(FullDisk, OfTheTerminalIsToldWithExitCodeTwo) {
  const Folder folder;
  const Outcome outcome = process::hysteron(folder.path(), {"blocks"}, "/dev/full");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("standard output"), std::string::npos) << outcome.err;
}

TEST(FullDisk, LeavesTheResultsOfBeforeWhole) {
  const Folder folder;
  lab::furnish(folder);
  ASSERT_EQ(process::hysteron(folder.path(), compare).code, 0);
  const std::string before = folder.read("out/result.json");
  folder.write("a.csv", csv_with_row("2,two,1"));
  EXPECT_EQ(process::hysteron(folder.path(), compare).code, 2);
  EXPECT_EQ(folder.read("out/result.json"), before);
}

}  // namespace
}  // namespace hysteron
