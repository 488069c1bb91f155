#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "fit/estimate/fit.h"
#include "io/diagram/diagram_file.h"
#include "tests/fit/lab.h"
#include "tests/io/temporary_folder.h"

namespace hysteron {
namespace {

std::vector<ParameterValue> values(const Program& program, const std::vector<std::pair<std::string, double>>& list) {
  std::vector<ParameterValue> v;
  for (const auto& [path, value] : list) v.push_back({parameter_index(program, path), value});
  return v;
}

Diagram inner() {
  Diagram d;
  d.inputs["drive"].unit = "V";
  d.parameters["sensitivity"] = {Value("2 um/V"), {}, {}, {}, ""};
  auto& g = d.blocks["g"];
  g.type = "gain";
  g.in = {{"", "drive"}};
  g.parameters["gain"] = Reference{"sensitivity"};
  auto& lag = d.blocks["late"];
  lag.type = "lag";
  lag.in = {{"", "g"}};
  lag.parameters["times"] = NumberList{{3, "ms"}};
  d.outputs["displacement"] = "late";
  d.file = "stages/stage.json";
  return d;
}

Diagram outer() {
  Diagram d = lab::diagram("choice");
  d.parameters["kp"] = {Value("1.5 V/V"), {}, {}, {}, ""};
  d.parameters["plain"] = {Value(2.0), {}, {}, {}, ""};
  lab::add(d, "amplifier", "gain", "u").parameters["gain"] = Reference{"kp"};
  lab::add(d, "second", "gain", "amplifier").parameters["gain"] = Reference{"plain"};
  auto& stage = lab::add(d, "stage", "diagram", "second");
  stage.file = "stages/stage.json";
  stage.nested = std::make_shared<Diagram>(inner());
  auto& choice = d.blocks["choice"];
  choice.choose = "on";
  choice.in = {{"", "stage"}};
  choice.from["off"].type = "pass";
  auto& on = choice.from["on"];
  on.type = "creep";
  on.parameters["amounts"] = NumberList{{0.01, {}}, {0.02, {}}};
  on.parameters["times"] = NumberList{{0.1, "s"}, {1, "s"}};
  return d;
}

TEST(WriteBack, ValuesComeBackFromTheWrittenDiagramWhereverTheyStand) {
  const Diagram d = outer();
  const auto program = compile(d, lab::registry());
  const std::vector<std::pair<std::string, double>> wanted{{"kp", 1.25},
                                                           {"plain", 3.0},
                                                           {"stage/sensitivity", 4e-6},
                                                           {"stage/late.times[0]", 0.0125},
                                                           {"choice.amounts[1]", 0.375},
                                                           {"choice.times[0]", 0.25}};
  const Diagram written = with_parameters(d, *program, values(*program, wanted));
  const auto again = compile(written, lab::registry());
  for (const auto& [path, value] : wanted)
    EXPECT_NEAR(again->find_parameter(path)->value, value, 1e-12 * value) << path;
  EXPECT_EQ(again->find_parameter("choice.amounts[0]")->value, 0.01);
}

TEST(WriteBack, TheUnitOfTheFileStaysAndTheDigitsAreSensible) {
  const Diagram d = outer();
  const auto program = compile(d, lab::registry());
  const auto written =
      with_parameters(d, *program, values(*program, {{"choice.times[0]", 1.0 / 3}, {"stage/sensitivity", 1e-6 / 7}}));
  const auto& times =
      std::get<NumberList>(written.blocks.find("choice")->from.find("on")->parameters.find("times")->content);
  EXPECT_EQ(times[0], (Number{0.33333333, "s"}));
  const auto& sensitivity = std::get<Number>(written.blocks.find("stage")->parameters.find("sensitivity")->content);
  EXPECT_EQ(sensitivity, (Number{0.14285714, "um/V"}));
}

TEST(WriteBack, TheGivenDiagramAndItsNestedFileStayAsTheyWere) {
  const Diagram d = outer();
  const auto program = compile(d, lab::registry());
  std::vector<std::pair<std::string, Diagram>> nested;
  const auto written = with_parameters(d, *program, values(*program, {{"stage/late.times[0]", 0.0125}}), 8, &nested);
  EXPECT_EQ(compile(d, lab::registry())->find_parameter("stage/late.times[0]")->value, 0.003);
  ASSERT_EQ(nested.size(), 1U);
  EXPECT_EQ(nested[0].first, "stages/stage_fitted.json");
  EXPECT_EQ(written.blocks.find("stage")->file, "stages/stage_fitted.json");
}

TEST(WriteBack, AParameterThatStoodAtItsDefaultIsWrittenOut) {
  Diagram d = lab::diagram("s");
  lab::add(d, "c", "calibration", "u").parameters["gain"] = "1 um/V";
  lab::add(d, "s", "pass", "c");
  const auto program = compile(d, lab::registry());
  const auto written = with_parameters(d, *program, values(*program, {{"c.offset", 2e-6}}));
  EXPECT_NEAR(compile(written, lab::registry())->find_parameter("c.offset")->value, 2e-6, 1e-15);
}

TEST(ParameterFile, HoldsValueUnitAndIntervalOfWhatIsDeterminedAndNothingElse) {
  DataSet data;
  data.notes["y"].noise.white = 1e-9;
  data.file = "lab.json";
  data.recordings = {lab::recording("a", Role::train, 0.01, 300, [](double t) { return std::sin(7 * t); })};
  Diagram d = lab::diagram("b");
  lab::add(d, "a", "gain", "u").parameters["gain"] = "1 um/V";
  auto& b = lab::add(d, "b", "calibration", "a");
  b.parameters["gain"] = 2.0;
  b.parameters["offset"] = "0 um";
  const auto program = compile(d, lab::registry());
  lab::measure(data, program, 1e-9, 1);
  DataModel model(program, lab::shared(data));
  const auto r = fit(model, noise_before_fit(model), free_parameters(*program, {"a.gain", "b.gain", "b.offset"}));
  ASSERT_TRUE(r.ok);
  const auto json = nlohmann::json::parse(parameter_file_text(r, *program, data));
  EXPECT_FALSE(json.contains("a.gain"));
  EXPECT_FALSE(json.contains("b.gain"));
  ASSERT_TRUE(json.contains("b.offset"));
  const auto& offset = json["b.offset"];
  EXPECT_EQ(offset["unit"], "um");
  EXPECT_NEAR(offset["value"].get<double>(), 0, 1e-3);
  EXPECT_GT(offset["std"].get<double>(), 0);
  EXPECT_NE(offset["remark"].get<std::string>().find("95 % within"), std::string::npos);
  EXPECT_NE(json["remark"].get<std::string>().find("a.gain"), std::string::npos);
  EXPECT_NE(json["source"].get<std::string>().find("lab.json"), std::string::npos);
}

TEST(ParameterFile, OfOneBlockIsASetThatTheBlockCanName) {
  DataSet data;
  data.notes["y"].noise.white = 1e-9;
  data.recordings = {lab::recording("a", Role::train, 0.01, 300, [](double t) { return 3 + 3 * std::sin(7 * t); })};
  Diagram d = lab::diagram("core");
  auto& core = lab::add(d, "core", "prandtl_ishlinskii", "u");
  core.parameters["thresholds"] = NumberList{{0, "V"}, {1, "V"}};
  core.parameters["weights"] = NumberList{{1, "um/V"}, {0.25, "um/V"}};
  const auto program = compile(d, lab::registry());
  lab::measure(data, program, 0, 1);
  DataModel model(program, lab::shared(data));
  const auto r = fit(model, noise_before_fit(model), free_parameters(*program, {"core.weights"}));

  const TemporaryFolder folder;
  folder.write("set.json", parameter_file_text(r, *program, data));
  folder.write("diagram.json", R"({"format": 1, "inputs": {"u": {"unit": "V"}}, "outputs": {"y": "core"},
    "blocks": {"core": {"type": "prandtl_ishlinskii", "thresholds": ["0 V", "1 V"], "parameters": "set.json", "in": "u"}}})");
  const auto again = compile(read_diagram(folder.path("diagram.json")), lab::registry());
  EXPECT_NEAR(again->find_parameter("core.weights[0]")->value, 1e-6, 1e-13);
  EXPECT_NEAR(again->find_parameter("core.weights[1]")->value, 0.25e-6, 1e-13);
}

TEST(WriteBack, PlainBoundsMeanTheSameInTheWrittenDiagramAfterASettingInAnotherUnit) {
  Diagram d = lab::diagram("late");
  lab::add(d, "late", "lag", "u").parameters["times"] = Reference{"tau"};
  d.parameters["tau"] = {Value(2.0), Number{1, {}}, Number{5, {}}, true, ""};
  apply_settings(d, {{"tau", "3000 ms"}}, {});
  const auto program = compile(d, lab::registry());
  Diagram written = with_parameters(d, *program, values(*program, {{"tau[0]", 2.5}}));
  written.parameters["tau"].value.origin = "d.json#/parameters/tau";  // as it is read again
  const auto again = compile(written, lab::registry());
  const ParameterInfo& tau = *again->find_parameter("tau[0]");
  EXPECT_DOUBLE_EQ(tau.value, 2.5);
  EXPECT_DOUBLE_EQ(tau.lower, 1);
  EXPECT_DOUBLE_EQ(tau.upper, 5);
}

}  // namespace
}  // namespace hysteron
