#include <gtest/gtest.h>

#include <functional>

#include "engine/program/program.h"
#include "tests/engine/compile/problems_of.h"
#include "tests/engine/diagrams_in_code.h"
#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using test::node;
using test::numbers;
using test::series;
using tools::problems_of;
using tools::registry;

Diagram valid() {
  Diagram d;
  d.inputs["u"] = {"V", ""};
  d.blocks["stage"] = node("gain", {"u"}, {{"gain", "2 um/V"}});
  d.outputs["y"] = "stage";
  return d;
}

TEST(Compile, ADiagramIsBuiltAndEvaluatedFromCodeWithoutAFile) {
  const auto program = compile(valid(), registry());
  hysteron::Run run = start(*program);
  bind_input(*program, run, "u", series({0, 1}, {0, 3}));
  Work work(*program);
  run.branch = 0.5;
  evaluate_values(*program, run, work, 0.5, run.x.data());
  EXPECT_DOUBLE_EQ(work.y[static_cast<std::size_t>(program->signal("stage"))], 2e-6 * 1.5);
  EXPECT_EQ(program->signals[static_cast<std::size_t>(program->signal("stage"))].unit.text, "um");
}

TEST(Compile, EveryProblemHasItsCodeItsPlaceAndACure) {
  struct Case {
    const char* name;
    std::function<void(Diagram&)> spoil;
    const char* code;
    const char* path;
    const char* says;  ///< must stand in what or cure
  };
  const std::vector<Case> cases{
      {"unknown block type", [](Diagram& d) { d.blocks["stage"].type = "gian"; }, "unknown_block", "/blocks/stage/type",
       "\"gain\""},
      {"unknown parameter", [](Diagram& d) { d.blocks["stage"].parameters["gane"] = 1.0; }, "unknown_parameter",
       "/blocks/stage/gane", "\"gain\""},
      {"missing parameter", [](Diagram& d) { d.blocks["stage"].parameters.erase("gain"); }, "missing_parameter",
       "/blocks/stage/gain", "gain"},
      {"text for a number", [](Diagram& d) { d.blocks["stage"].parameters["gain"] = "much"; }, "wrong_type",
       "/blocks/stage/gain", "much"},
      {"list for a number",
       [](Diagram& d) {
         d.blocks["stage"].parameters["gain"] = numbers({1, 2});
       },
       "wrong_type", "/blocks/stage/gain", "a number"},
      {"no such unit", [](Diagram& d) { d.blocks["stage"].parameters["gain"] = "2 furlongs per fortnightish"; },
       "bad_unit", "/blocks/stage/gain", "not a unit"},
      {"a wrong unit on the way",
       [](Diagram& d) {
         d.blocks["sum"] = node("sum", {"stage", "u"});
         d.outputs["y"] = "sum";
       },
       "wrong_unit", "/blocks/sum", "V"},
      {"a wrong unit at a parameter",
       [](Diagram& d) {
         d.blocks["lag"] = node("lag", {"stage"}, {{"times", NumberList{{1, "V"}}}});
         d.outputs["y"] = "lag";
       },
       "wrong_unit", "/blocks/lag/times", "in s"},
      {"unknown signal", [](Diagram& d) { d.blocks["stage"].in[0].from = "v"; }, "unknown_signal", "/blocks/stage/in",
       "\"v\""},
      {"unknown port", [](Diagram& d) { d.outputs["y"] = "stage.z"; }, "unknown_signal", "/outputs/y", "\"z\""},
      {"missing connection",
       [](Diagram& d) {
         d.blocks["stage"].in.clear();
         d.inputs.erase("u");
       },
       "missing_connection", "/blocks/stage/in", "not connected"},
      {"double connection",
       [](Diagram& d) {
         d.blocks["stage"].in = {{"u", "u"}, {"u", "u"}};
       },
       "double_connection", "/blocks/stage/in", "twice"},
      {"too many wires",
       [](Diagram& d) {
         d.blocks["stage"].in = {{"", "u"}, {"", "u"}};
       },
       "unknown_input", "/blocks/stage/in", "1 input"},
      {"unused block", [](Diagram& d) { d.blocks["other"] = node("pass", {"u"}); }, "unused_block", "/blocks/other",
       "is not used"},
      {"unused input",
       [](Diagram& d) {
         d.inputs["w"] = {"V", ""};
       },
       "unused_input", "/inputs/w", "is not used"},
      {"unused parameter", [](Diagram& d) { d.parameters["k"].value = 1.0; }, "unused_parameter", "/parameters/k",
       "$k"},
      {"unknown reference", [](Diagram& d) { d.blocks["stage"].parameters["gain"] = "$k"; }, "unknown_reference",
       "/blocks/stage/gain", "\"k\""},
      {"bad choice",
       [](Diagram& d) {
         Node choice;
         choice.choose = "c";
         choice.in = {{"", "u"}};
         choice.from["a"] = node("gain", {}, {{"gain", "1 um/V"}});
         d.blocks["stage"] = choice;
       },
       "bad_choice", "/blocks/stage/choose", "\"c\""},
      {"value out of range",
       [](Diagram& d) {
         d.blocks["lag"] = node("lag", {"stage"}, {{"times", numbers({-1})}});
         d.outputs["y"] = "lag";
       },
       "bad_value", "/blocks/lag/times", "greater than 0"},
      {"algebraic loop",
       [](Diagram& d) {
         d.blocks["sum"] = node("sum", {"stage", "back"});
         d.blocks["back"] = node("gain", {"sum"}, {{"gain", 0.5}});
         d.outputs["y"] = "sum";
         d.simulate.loops = "error";
       },
       "algebraic_loop", "/blocks/", "sum -> back"},
      {"no such way with loops", [](Diagram& d) { d.simulate.loops = "sovle"; }, "bad_value", "/simulate/loops",
       "\"solve\""},
  };
  for (const auto& c : cases) {
    Diagram d = valid();
    c.spoil(d);
    const auto problems = problems_of(d);
    ASSERT_FALSE(problems.empty()) << c.name << " was accepted";
    const auto& p = problems.front();
    EXPECT_EQ(p.code, c.code) << c.name << ": " << p.what;
    EXPECT_EQ(p.path.rfind(c.path, 0), 0U) << c.name << ": " << p.path;
    EXPECT_NE((p.what + p.cure).find(c.says), std::string::npos) << c.name << ": " << p.what << " | " << p.cure;
    EXPECT_FALSE(p.cure.empty()) << c.name;
  }
}

TEST(Compile, AListInAWrongUnitIsOneProblemAndNothingThatFollowsFromIt) {
  Diagram d = valid();
  d.blocks["lag"] = node("lag", {"stage"}, {{"times", NumberList{{3, "V"}, {2, "V"}, {-1, "V"}}}});
  d.outputs["y"] = "lag";
  const auto problems = problems_of(d);
  ASSERT_EQ(problems.size(), 1U) << to_text(problems);
  EXPECT_EQ(problems.front().code, "wrong_unit");
  d.blocks["lag"].parameters["times"] = NumberList{{3, "V"}, {2, "mm"}, {1, "s"}};
  EXPECT_EQ(problems_of(d).size(), 2U) << "two units are two mistakes";
}

TEST(Compile, AllProblemsOfAStageAreReportedTogether) {
  Diagram d = valid();
  d.blocks["a"] = node("nonsense");
  d.blocks["b"] = node("gain", {"u"}, {{"gain", 1.0}, {"gaim", 2.0}});
  EXPECT_EQ(problems_of(d).size(), 2U);
}

TEST(Compile, AFeedbackLoopThroughAStateIsNoLoopEvenWhereAnotherBlockWantsItsRate) {
  // The hysteresis is driven by the stage's position, whose rate is known from the stage's states.
  Diagram d;
  d.blocks["drive"] = node("sine", {}, {{"amplitude", "1 V"}, {"frequency", "5 Hz"}});
  d.blocks["error"] = node("sum", {"drive", "sensor"}, {{"signs", "+-"}});
  d.blocks["stage"] = node("lag", {"error"}, {{"times", numbers({1e-3})}});
  d.blocks["hysteresis"] = node(
      "bouc_wen", {"stage"}, {{"alpha", "0.6 um/V"}, {"beta", "0.2 1/V"}, {"gamma", "0.02 1/V"}, {"d_p", "1.6 um/V"}});
  d.blocks["sensor"] = node("gain", {"hysteresis"}, {{"gain", "0.1 V/um"}});
  d.record = {"hysteresis"};
  EXPECT_TRUE(problems_of(d).empty());
}

TEST(Compile, NestedDiagramsAreInlinedAndTheirParametersOverridden) {
  auto inner = std::make_shared<Diagram>();
  inner->parameters["k"].value = "1 um/V";
  inner->inputs["u"] = {"V", ""};
  inner->blocks["amplifier"] = node("gain", {"u"}, {{"gain", 10.0}});
  inner->blocks["piezo"] = node("gain", {"amplifier"}, {{"gain", "$k"}});
  inner->outputs["displacement"] = "piezo";
  Diagram d;
  d.inputs["u"] = {"V", ""};
  Node stage;
  stage.type = "diagram";
  stage.nested = inner;
  stage.in = {{"", "u"}};
  stage.parameters["k"] = "3 um/V";
  d.blocks["stage"] = stage;
  d.outputs["y"] = "stage.displacement";
  const auto program = compile(d, registry());
  EXPECT_GE(program->block_index("stage/amplifier"), 0);
  hysteron::Run run = start(*program);
  bind_input(*program, run, "u", series({0}, {2}));
  Work work(*program);
  evaluate_values(*program, run, work, 0, run.x.data());
  EXPECT_DOUBLE_EQ(work.y[static_cast<std::size_t>(program->output_signals[0])], 60e-6);
}

TEST(Compile, AParameterOfTheDiagramReachesEveryPlaceThatNamesIt) {
  Diagram d = valid();
  d.parameters["k"].value = "2 um/V";
  d.blocks["stage"].parameters["gain"] = "$k";
  d.blocks["second"] = node("gain", {"u"}, {{"gain", "$k"}});
  d.blocks["sum"] = node("sum", {"stage", "second"});
  d.outputs["y"] = "sum";
  const auto program = compile(d, registry());
  hysteron::Run run = start(*program);
  set_parameter(*program, run, "k", 5e-6);
  bind_input(*program, run, "u", series({0}, {1}));
  Work work(*program);
  evaluate_values(*program, run, work, 0, run.x.data());
  EXPECT_DOUBLE_EQ(work.y[static_cast<std::size_t>(program->signal("sum"))], 10e-6);
  EXPECT_EQ(program->find_parameter("second.gain"), program->find_parameter("k"));
  EXPECT_FALSE(program->find_parameter("k")->linear) << "in two places the output need not be affine in it";
}

TEST(Compile, SettingsFromOutsideChangeValuesAndChoices) {
  Diagram d = valid();
  apply_settings(d, {{"stage.gain", "7 um/V"}}, {});
  EXPECT_DOUBLE_EQ(compile(d, registry())->find_parameter("stage.gain")->value, 7e-6);
  try {
    apply_settings(d, {{"stag.gain", "7 um/V"}}, {});
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(e.problems[0].cure.find("\"stage\""), std::string::npos);
  }
}

TEST(Compile, PlainBoundsAreInTheUnitOfTheFileWhateverUnitASettingIsIn) {
  Diagram d = valid();
  d.blocks["spring"] = node("gain", {"stage"}, {{"gain", "$k"}});
  d.outputs["f"] = "spring";
  d.parameters["k"].value = Number{18000, "N/m"};
  d.parameters["k"].lower = Number{1000, {}};
  d.parameters["k"].upper = Number{100000, {}};
  apply_settings(d, {{"k", "50 N/mm"}}, {});
  apply_settings(d, {{"k", "20 N/mm"}}, {});  // a job's settings, then those of the command line
  const auto program = compile(d, registry());
  const ParameterInfo& k = *program->find_parameter("k");
  EXPECT_DOUBLE_EQ(k.value, 20000);
  EXPECT_DOUBLE_EQ(k.lower, 1000);
  EXPECT_DOUBLE_EQ(k.upper, 100000);
}

TEST(Compile, PlainBoundsOfAPlainValueAreInTheDeclaredUnitWhateverUnitASettingIsIn) {
  Diagram d = valid();
  d.blocks["lag"] = node("lag", {"stage"}, {{"times", "$tau"}});
  d.outputs["z"] = "lag";
  d.parameters["tau"].value = Number{2, {}};
  d.parameters["tau"].lower = Number{1, {}};
  d.parameters["tau"].upper = Number{5, {}};
  apply_settings(d, {{"tau", "3000 ms"}}, {});
  const auto program = compile(d, registry());
  EXPECT_DOUBLE_EQ(program->find_parameter("tau[0]")->lower, 1);
  EXPECT_DOUBLE_EQ(program->find_parameter("tau[0]")->upper, 5);
}

TEST(Compile, PlainBoundsOfANestedDiagramAreInTheUnitOfItsOwnFile) {
  Diagram inner = valid();
  inner.blocks["stage"].parameters["gain"] = "$k";
  inner.parameters["k"].value = Number{2, "um/V"};
  inner.parameters["k"].lower = Number{1, {}};
  inner.parameters["k"].upper = Number{5, {}};
  Diagram d = valid();
  d.blocks["stage"] = node("diagram", {"u"}, {{"k", "3000 nm/V"}});
  d.blocks["stage"].nested = std::make_shared<const Diagram>(inner);
  const auto program = compile(d, registry());
  EXPECT_DOUBLE_EQ(program->find_parameter("stage/k")->lower, 1e-6);
  EXPECT_DOUBLE_EQ(program->find_parameter("stage/k")->upper, 5e-6);
}

TEST(Compile, WhatWasSetFromOutsideIsToBlameForItsUnitAndNotWhatTheFileSays) {
  const auto told = [](Diagram d, const char* path, const char* value) {
    apply_settings(d, {{path, value}}, {});
    std::vector<std::string> places;
    for (const auto& problem : problems_of(d)) places.push_back(problem.code + " at " + problem.path);
    return places;
  };
  using Places = std::vector<std::string>;
  Diagram d = valid();
  d.blocks["lag"] = node("lag", {"stage"}, {{"times", NumberList{{1, "s"}}}});
  d.parameters["k"].value = "2 s";
  d.blocks["control"] = node("pi_controller", {"lag"}, {{"kp", "2 V/um"}, {"ki", "3 V/(um s)"}});
  d.blocks["slow"] = node("lag", {"stage"}, {{"times", "$k"}});
  for (const char* output : {"lag", "control", "slow"}) d.outputs[output] = output;
  ASSERT_EQ(told(d, "k", "3 s"), Places{});
  EXPECT_EQ(told(d, "lag.times", "3 V"), Places{"wrong_unit at --set lag.times=3 V"});
  EXPECT_EQ(told(d, "lag.times", "3 sek"), Places{"bad_unit at --set lag.times=3 sek"});
  EXPECT_EQ(told(d, "lag.times", "-3 s"), Places{"bad_value at --set lag.times=-3 s"});
  EXPECT_EQ(told(d, "k", "3 V"), Places{"wrong_unit at --set k=3 V"});
  EXPECT_EQ(told(d, "lag.time", "3 s"), Places{"unknown_parameter at --set lag.time=3 s"});
  // Of the two gains the one that was set is wrong, though it is read first.
  EXPECT_EQ(told(d, "control.kp", "3 K"), Places{"wrong_unit at --set control.kp=3 K"});
}

TEST(Compile, ALongChainIsOrderedWithoutRecursion) {
  Diagram d;
  d.inputs["u"] = {"V", ""};
  std::string before = "u";
  for (int i = 0; i < 20000; ++i) {
    std::string name = "b" + std::to_string(i);
    d.blocks.insert_after("", name, node("pass", {before}));
    before = std::move(name);
    if (i == 400) break;  // Ordered looks names up one by one: enough to see recursion at the order of a stack's size
  }
  d.outputs["y"] = before;
  EXPECT_EQ(compile(d, registry())->all_values.size(), 402U);
}

}  // namespace
}  // namespace hysteron
