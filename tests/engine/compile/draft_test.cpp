#include "engine/compile/draft.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "engine/diagram/error.h"
#include "engine/simulate/simulate.h"
#include "tests/engine/diagrams_in_code.h"
#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using test::node;
using test::numbers;
using test::series;
using tools::registry;

/// "code path" of each, sorted.
std::vector<std::string> told(const std::vector<Problem>& problems) {
  std::vector<std::string> list;
  for (const auto& p : problems) {
    EXPECT_FALSE(p.what.empty() || p.cure.empty());
    list.push_back(p.code + " " + p.path);
  }
  std::sort(list.begin(), list.end());
  return list;
}

using Texts = std::vector<std::string>;

/// A stage behind an amplifier: u [V] -> stage [um].
Diagram healthy() {
  Diagram d;
  d.parameters["k"].value = "2 um/V";
  d.inputs["u"] = {"V", ""};
  d.blocks["amplifier"] = node("lag", {"u"}, {{"times", "1 ms"}});
  d.blocks["stage"] = node("gain", {"amplifier"}, {{"gain", Reference{"k"}}});
  d.outputs["y"] = "stage";
  return d;
}

/// A mechanical stop at 5 um; `in` may be "".
Node stop(const std::string& in) {
  Node n = node("saturation", {}, {{"lower", "-5 um"}, {"upper", "5 um"}});
  if (!in.empty()) n.in = {{"", in}};
  return n;
}

TEST(Draft, OfAFinishedDiagramIsWhatCompileGives) {
  Diagram inner = healthy(), outer;
  outer.inputs["u"] = {"V", ""};
  Node nested = node("diagram", {"drive"});
  nested.nested = std::make_shared<const Diagram>(inner);
  outer.blocks["drive"] = node("mux", {"u", "u"});
  outer.blocks["lags"] = node("lag", {"drive"}, {{"times", "2 ms"}});
  outer.blocks["axis"] = nested;
  outer.blocks["axis"].in = {{"u", "lags[1]"}};
  outer.blocks["loop"] = node("sum", {"axis", "back"});
  outer.blocks["back"] = node("gain", {"loop"}, {{"gain", 0.5}});
  outer.outputs["y"] = "loop";
  for (const Diagram& d : {inner, outer}) {
    const ProgramPointer whole = compile(d, registry());
    const DraftProgram draft = compile_draft(d, registry());
    EXPECT_TRUE(draft.problems.empty() && draft.warnings.empty() && draft.left_out.empty()) << to_text(draft.problems);
    ASSERT_NE(draft.program, nullptr);
    EXPECT_EQ(draft.program->p, whole->p);
    EXPECT_EQ(draft.program->input_names, whole->input_names);
    EXPECT_EQ(draft.program->state_names, whole->state_names);
    EXPECT_EQ(draft.program->output_signals, whole->output_signals);
    EXPECT_EQ(draft.program->loops.size(), whole->loops.size());
    EXPECT_EQ(draft.program->derivative_steps.size(), whole->derivative_steps.size());
    ASSERT_EQ(draft.program->signals.size(), whole->signals.size());
    for (std::size_t s = 0; s < whole->signals.size(); ++s) {
      EXPECT_EQ(draft.program->signals[s].path, whole->signals[s].path);
      EXPECT_EQ(draft.program->signals[s].unit.text, whole->signals[s].unit.text);
    }
    SimulateOptions options;
    options.until = 0.01;
    options.every = 1e-3;
    options.signals = whole->output_signals;
    std::vector<Traces> traces;
    for (const auto& program : {whole, draft.program}) {
      hysteron::Run run = start(*program);
      bind_input(*program, run, "u", series({0, 1}, {0, 3}));
      traces.push_back(simulate(*program, run, options));
    }
    EXPECT_EQ(traces[0].values, traces[1].values) << "every bit";
  }
}

TEST(Draft, TellsTheProblemsOfAllStagesAtOnce) {
  Diagram d = healthy();
  const auto also = [&](const std::string& name, Node block) {
    d.blocks[name] = std::move(block);
    d.outputs["of_" + name] = name;
  };
  also("misspelt", node("gian", {"u"}, {{"gain", 1.0}}));     // names
  also("valueless", node("gain", {"nowhere"}));               // values and wires
  also("unwired", node("lag", {}, {{"times", "1 ms"}}));      // wires: unfinished
  d.blocks["unread"] = node("gain", {"u"}, {{"gain", 1.0}});  // wires: unfinished
  also("pair", node("mux", {"u", "u"}));
  also("triple", node("mux", {"u", "u", "u"}));
  also("unequal", node("sum", {"pair", "triple"}));          // lengths
  also("mixed", node("sum", {"u", "stage"}));                // units
  also("first", node("gain", {"second"}, {{"gain", 1.0}}));  // order: a loop of gain 1 has no solution,
  also("second", node("gain", {"first"}, {{"gain", 1.0}}));  // which nobody asked for
  d.simulate.loops = "error";
  d.simulate.guess["stage"] = {1, "V"};         // settings: stage is in um
  d.parameters["k"].lower = Number{3, "um/V"};  // bounds
  const DraftProgram draft = compile_draft(d, registry());
  const auto problems = told(draft.problems);
  for (const char* expected :
       {"unknown_block /blocks/misspelt/type", "missing_parameter /blocks/valueless/gain",
        "unknown_signal /blocks/valueless/in", "wrong_length /blocks/unequal/in", "wrong_unit /blocks/mixed",
        "wrong_unit /simulate/guess/stage", "bad_value /parameters/k"})
    EXPECT_TRUE(std::find(problems.begin(), problems.end(), expected) != problems.end())
        << expected << " is not among\n"
        << to_text(draft.problems);
  EXPECT_EQ(std::count_if(problems.begin(), problems.end(),
                          [](const std::string& p) { return p.starts_with("algebraic_loop"); }),
            1);
  EXPECT_EQ(problems.size(), 8U) << "nothing that comes of what is left out: " << to_text(draft.problems);
  EXPECT_EQ(told(draft.warnings), (Texts{"missing_connection /blocks/unwired/in", "unused_block /blocks/unread"}));
  ASSERT_NE(draft.program, nullptr);
  for (const char* block : {"amplifier", "stage", "unwired", "unread", "pair", "triple"})
    EXPECT_GE(draft.program->find_signal(block) + draft.program->find_signal(std::string(block) + "[0]"), -1) << block;
  for (const char* block : {"misspelt", "valueless", "unequal", "mixed"}) {
    EXPECT_EQ(draft.program->block_index(block), -1) << block;
    EXPECT_EQ(std::count(draft.left_out.begin(), draft.left_out.end(), block), 1) << block;
  }
}

TEST(Draft, AnInputThatIsNotWiredIsAnInputOfTheProgramInTheUnitOfItsReader) {
  Diagram d;
  d.blocks["stop"] = stop("");
  d.outputs["y"] = "stop";
  const DraftProgram draft = compile_draft(d, registry());
  EXPECT_TRUE(draft.problems.empty()) << to_text(draft.problems);
  EXPECT_EQ(told(draft.warnings), Texts{"missing_connection /blocks/stop/in"});
  ASSERT_NE(draft.program, nullptr);
  ASSERT_EQ(draft.program->input_names, Texts{"stop." + registry().find("saturation")->declaration.inputs[0].name});
  EXPECT_EQ(draft.program->input_units[0].text, "um");
}

TEST(Draft, WhatReadsABlockThatIsLeftOutIsCheckedAndRuns) {
  Diagram d = healthy();
  d.blocks["amplifier"].type = "lagg";
  d.blocks["stop"] = stop("amplifier");
  d.blocks["sum"] = node("sum", {"stop", "u"});  // um and V
  d.outputs["z"] = "sum";
  const DraftProgram draft = compile_draft(d, registry());
  EXPECT_EQ(told(draft.problems), (Texts{"unknown_block /blocks/amplifier/type", "wrong_unit /blocks/sum"}));
  EXPECT_EQ(draft.left_out, (Texts{"amplifier", "sum"}));
  ASSERT_NE(draft.program, nullptr);
  ASSERT_EQ(draft.program->input_names, (Texts{"u", "amplifier"}));
  hysteron::Run run = start(*draft.program);
  bind_input(*draft.program, run, "u", series({0, 1}, {0, 0}));
  bind_input(*draft.program, run, "amplifier", series({0, 1}, {0, 3}));
  SimulateOptions options;
  options.instants = {0, 0.5, 1};
  options.until = 1;
  options.signals = draft.program->output_signals;
  ASSERT_EQ(options.signals.size(), 1U) << "z is not there";
  EXPECT_DOUBLE_EQ(simulate(*draft.program, run, options).values[0][1], 2e-6 * 1.5);
}

TEST(Draft, TwoReadersOfABlockThatIsLeftOutMustAgreeOnItsUnit) {
  Diagram d = healthy();
  d.blocks["amplifier"].type = "lagg";
  d.blocks["stop"] = stop("amplifier");
  d.blocks["volts"] = node("sum", {"amplifier", "u"});
  d.outputs["z"] = "stop";
  d.outputs["w"] = "volts";
  EXPECT_EQ(compile_draft(d, registry()).problems.size(), 2U);
}

TEST(Draft, AWrongBlockOfANestedDiagramLeavesTheOthersOfIt) {
  Diagram inner = healthy();
  inner.blocks["stage"].parameters["gane"] = 1.0;
  inner.blocks["stage"].origin = "/blocks/axis/blocks/stage";
  inner.outputs["voltage"] = "amplifier";
  Diagram outer;
  outer.inputs["u"] = {"V", ""};
  outer.blocks["axis"] = node("diagram", {"u"});
  outer.blocks["axis"].nested = std::make_shared<const Diagram>(inner);
  outer.outputs["y"] = "axis.y";
  outer.outputs["voltage"] = "axis.voltage";
  const DraftProgram draft = compile_draft(outer, registry());
  EXPECT_EQ(told(draft.problems), Texts{"unknown_parameter /blocks/axis/blocks/stage/gane"});
  EXPECT_EQ(draft.left_out, Texts{"axis/stage"});
  ASSERT_NE(draft.program, nullptr);
  EXPECT_EQ(draft.program->output_names, Texts{"voltage"});
}

TEST(Draft, ABlockThatTakesAnyNumberOfWiresAndHasNoneIsLeftOut) {
  Diagram d = healthy();
  d.blocks["sum"] = node("sum", {}, {{"signs", "+-"}});
  d.outputs["z"] = "sum";
  const DraftProgram draft = compile_draft(d, registry());
  EXPECT_TRUE(draft.problems.empty()) << to_text(draft.problems);
  EXPECT_EQ(told(draft.warnings), Texts{"missing_connection /blocks/sum/in"});
  EXPECT_EQ(draft.left_out, Texts{"sum"});
}

TEST(Draft, OfNothingThereIsNoProgram) {
  const DraftProgram draft = compile_draft(Diagram{}, registry());
  EXPECT_EQ(draft.program, nullptr);
  EXPECT_EQ(told(draft.warnings), Texts{"empty_diagram /blocks"});
  Diagram wrong;
  wrong.blocks["a"] = node("gian");
  wrong.outputs["y"] = "a";
  EXPECT_EQ(compile_draft(wrong, registry()).program, nullptr);
}

}  // namespace
}  // namespace hysteron
