#include "discover/placement/add.h"

#include <gtest/gtest.h>

#include "blocks/register_all.h"
#include "discover/effects/all.h"
#include "engine/program/program.h"
#include "io/diagram/diagram_file.h"
#include "tests/io/temporary_folder.h"

namespace hysteron {
namespace {

Node node(const char* type, std::vector<Wire> in) {
  Node n;
  n.type = type;
  n.in = std::move(in);
  return n;
}

/// u -> plays -> stage -> sensor -> y, with a monitor that reads the drive too.
Diagram stage() {
  Diagram d;
  d.title = "stage";
  d.inputs["u"].unit = "V";
  d.blocks["drive"] = node("gain", {{"", "u"}});
  d.blocks["drive"].parameters["gain"] = Value("10");
  d.blocks["actuator"] = node("prandtl_ishlinskii", {{"", "drive"}});
  d.blocks["actuator"].parameters["thresholds"] = Value(NumberList{Number{0, "V"}, Number{5, "V"}});
  d.blocks["actuator"].parameters["weights"] = Value(NumberList{Number{0.1, "um/V"}, Number{0.02, "um/V"}});
  d.blocks["monitor"] = node("gain", {{"", "drive"}});
  d.blocks["monitor"].parameters["gain"] = Value("0.01");
  d.blocks["sensor"] = node("calibration", {{"", "actuator"}});
  d.blocks["sensor"].parameters["gain"] = Value("1");
  d.blocks["sensor"].parameters["offset"] = Value("0.3 um");
  d.outputs["y"] = "sensor";
  d.outputs["v"] = "monitor";
  d.record = {"drive", "actuator"};
  return d;
}

class AddedEffect : public ::testing::Test {
 protected:
  Registry registry = all_blocks();
  Effects effects = all_effects();
};

TEST_F(AddedEffect, StandsAsAChoiceRightBehindItsSourceAndEveryReaderReadsIt) {
  const Added a = add_effect(stage(), registry, effects.get("creep"), "drive");
  EXPECT_EQ(a.name, "drive_creep");
  const auto names = a.diagram.blocks.names();
  EXPECT_EQ(names, (std::vector<std::string>{"drive", "drive_creep", "actuator", "monitor", "sensor"}));
  const Node& choice = *a.diagram.blocks.find("drive_creep");
  EXPECT_EQ(choice.choose, "on");
  EXPECT_EQ(choice.effect, "creep");
  EXPECT_EQ(choice.in.front().from, "drive");
  EXPECT_EQ(choice.from.find("off")->type, "pass");
  EXPECT_EQ(choice.from.find("on")->type, "logarithmic_creep");
  EXPECT_EQ(a.diagram.blocks.find("actuator")->in.front().from, "drive_creep");
  EXPECT_EQ(a.diagram.blocks.find("monitor")->in.front().from, "drive_creep");
  EXPECT_EQ(a.diagram.record, stage().record) << "what is recorded stays what it was";
  EXPECT_NO_THROW(compile(a.diagram, registry));
}

TEST_F(AddedEffect, AtAnOutputIsReadByTheOutput) {
  const Added a = add_effect(stage(), registry, effects.get("sensor_lag"), "sensor");
  EXPECT_EQ(*a.diagram.outputs.find("y"), "sensor_sensor_lag");
  EXPECT_NO_THROW(compile(a.diagram, registry));
}

TEST_F(AddedEffect, AtAnInputOfTheDiagramStandsFirst) {
  const Added a = add_effect(stage(), registry, effects.get("amplifier_lag"), "u");
  EXPECT_EQ(a.diagram.blocks.names().front(), "u_amplifier_lag");
  EXPECT_EQ(a.diagram.blocks.find("drive")->in.front().from, "u_amplifier_lag");
}

TEST_F(AddedEffect, AtAnInputWithCapitalLettersHasANameThatABlockMayHave) {
  Diagram d;
  d.inputs["T_amb"].unit = "degC";
  d.inputs["t_amb"].unit = "degC";
  d.blocks["air"] = node("lag", {{"", "T_amb"}});
  d.blocks["air"].parameters["times"] = Value(NumberList{Number{10, "s"}});
  d.blocks["wall"] = node("lag", {{"", "t_amb"}});
  d.blocks["wall"].parameters["times"] = Value(NumberList{Number{10, "s"}});
  d.outputs["T"] = "air";
  d.outputs["W"] = "wall";
  const Added first = add_effect(d, registry, effects.get("dead_time"), "T_amb");
  EXPECT_EQ(first.name, "t_amb_dead_time");
  const Added second = add_effect(first.diagram, registry, effects.get("dead_time"), "t_amb");
  EXPECT_EQ(second.name, "t_amb_dead_time_2");
  const TemporaryFolder folder;
  const std::string file = folder.path("d.json");
  write_diagram(file, second.diagram);
  const Diagram back = read_diagram(file);
  EXPECT_NO_THROW(compile(back, registry));
  EXPECT_EQ(diagram_text(remove_effect(remove_effect(back, registry, second.name), registry, first.name)),
            diagram_text(d));
}

TEST_F(AddedEffect, AtAnInputPortLeavesOtherReadersAlone) {
  const Added a = add_effect(stage(), registry, effects.get("dead_time"), "actuator.in");
  EXPECT_EQ(a.diagram.blocks.find("actuator")->in.front().from, a.name);
  EXPECT_EQ(a.diagram.blocks.find("monitor")->in.front().from, "drive");
  EXPECT_NO_THROW(compile(a.diagram, registry));
}

TEST_F(AddedEffect, ComesAfterTheOneThatStandsOnTheWireAlready) {
  const Added first = add_effect(stage(), registry, effects.get("amplifier_lag"), "u");
  const Added second = add_effect(first.diagram, registry, effects.get("dead_time"), "u");
  EXPECT_EQ(second.name, "u_dead_time");
  EXPECT_EQ(second.diagram.blocks.find("u_dead_time")->in.front().from, "u_amplifier_lag");
  EXPECT_EQ(second.diagram.blocks.find("drive")->in.front().from, "u_dead_time");
  EXPECT_NO_THROW(compile(second.diagram, registry));
}

/// Two axes: u -> drive (a vector) -> y, and a monitor of its second element.
Diagram two_axes() {
  Diagram d;
  d.inputs["u"] = {"V", "", 2};
  d.blocks["drive"] = node("gain", {{"", "u"}});
  d.blocks["drive"].parameters["gain"] = Value("10");
  d.blocks["monitor"] = node("gain", {{"", "drive[1]"}});
  d.blocks["monitor"].parameters["gain"] = Value("0.01");
  d.outputs["y"] = "drive";
  d.outputs["v"] = "monitor";
  return d;
}

TEST_F(AddedEffect, OnAVectorStandsBeforeTheReadersOfItsElementsToo) {
  const Added a = add_effect(two_axes(), registry, effects.get("creep"), "drive");
  EXPECT_EQ(a.diagram.blocks.find(a.name)->in.front().from, "drive");
  EXPECT_EQ(a.diagram.blocks.find("monitor")->in.front().from, a.name + "[1]");
  EXPECT_EQ(*a.diagram.outputs.find("y"), a.name);
  EXPECT_NO_THROW(compile(a.diagram, registry));
  const Diagram back = remove_effect(a.diagram, registry, a.name);
  EXPECT_EQ(diagram_text(back), diagram_text(two_axes()));
}

TEST_F(AddedEffect, OnOneElementOfAVectorLeavesTheOthersAlone) {
  const Added a = add_effect(two_axes(), registry, effects.get("creep"), "drive[1]");
  EXPECT_EQ(a.name, "drive_1_creep");
  EXPECT_EQ(a.diagram.blocks.find(a.name)->in.front().from, "drive[1]");
  EXPECT_EQ(a.diagram.blocks.find("monitor")->in.front().from, a.name);
  EXPECT_EQ(*a.diagram.outputs.find("y"), "drive");
  EXPECT_NO_THROW(compile(a.diagram, registry));
}

TEST_F(AddedEffect, IsRefusedWhereItStandsAlready) {
  const Added first = add_effect(stage(), registry, effects.get("creep"), "drive");
  try {
    add_effect(first.diagram, registry, effects.get("creep"), "drive");
    FAIL() << "the same effect twice at one place";
  } catch (const Error& e) {
    EXPECT_EQ(e.problems.front().code, "effect_there");
    EXPECT_FALSE(e.problems.front().cure.empty());
  }
}

TEST_F(AddedEffect, AtAnUnknownPlaceNamesTheNearestSignal) {
  try {
    add_effect(stage(), registry, effects.get("creep"), "drve");
    FAIL() << "no such signal";
  } catch (const Error& e) {
    EXPECT_EQ(e.problems.front().code, "unknown_place");
    EXPECT_NE(e.problems.front().cure.find("\"drive\""), std::string::npos) << e.problems.front().cure;
  }
}

TEST_F(AddedEffect, IsTakenOutWithoutATrace) {
  const Diagram before = stage();
  for (const auto& effect : effects.list()) {
    for (const auto& place : places_of(effect, before, registry)) {
      Excitation at;
      at.unit = parse_unit("V");
      const Added a = add_effect(before, registry, effect, effect.laws(at).front(), place);
      EXPECT_EQ(diagram_text(remove_effect(a.diagram, registry, a.name)), diagram_text(before))
          << effect.id << " at " << place.at;
      EXPECT_EQ(diagram_text(remove_effect(a.diagram, registry, effect.id)), diagram_text(before))
          << effect.id << " at " << place.at;
    }
  }
}

TEST_F(AddedEffect, OfTwoOnOneWireEitherCanBeTakenOut) {
  const Added lag = add_effect(stage(), registry, effects.get("amplifier_lag"), "u");
  const Added both = add_effect(lag.diagram, registry, effects.get("dead_time"), "u");
  EXPECT_EQ(diagram_text(remove_effect(both.diagram, registry, "dead_time")), diagram_text(lag.diagram));
  const Added delay_alone = add_effect(stage(), registry, effects.get("dead_time"), "u");
  EXPECT_EQ(diagram_text(remove_effect(both.diagram, registry, "amplifier_lag")), diagram_text(delay_alone.diagram));
}

TEST_F(AddedEffect, ThatVariesABlockKeepsItsNameAndItsReaders) {
  const Added a = add_effect(stage(), registry, effects.get("initial_remanence"), "actuator");
  const Node& choice = *a.diagram.blocks.find("actuator");
  EXPECT_EQ(choice.from.find("off")->parameters.find("before"), nullptr);
  EXPECT_NE(choice.from.find("on")->parameters.find("before"), nullptr);
  EXPECT_EQ(choice.in.front().from, "drive");
  EXPECT_EQ(a.diagram.blocks.find("sensor")->in.front().from, "actuator");
  EXPECT_NO_THROW(compile(a.diagram, registry));
}

TEST_F(AddedEffect, OfAMassIsItsRicherTypeAndOnASpeedABlockOfItsOwn) {
  Diagram d;
  d.inputs["force"].unit = "N";
  d.inputs["v"].unit = "mm/s";
  d.blocks["body"] = node("mass_spring_damper", {{"", "force"}});
  d.blocks["body"].parameters["mass"] = Value("1 kg");
  d.blocks["body"].parameters["stiffness"] = Value("100 N/m");
  d.outputs["x"] = "body.position";
  d.blocks["dashpot"] = node("gain", {{"", "v"}});
  d.blocks["dashpot"].parameters["gain"] = Value("2 N*s/m");
  d.outputs["f"] = "dashpot";
  // No data: the numbers are placeholders, the types are not.
  for (const char* effect : {"friction", "hysteresis"}) {
    const Added a = add_effect(d, registry, effects.get(effect), "body");
    EXPECT_TRUE(a.diagram.blocks.find("body")->from.find("on")->type.starts_with("mass_")) << effect;
    EXPECT_NO_THROW(compile(a.diagram, registry)) << effect;
  }
  const Added a = add_effect(d, registry, effects.get("friction"), "v");
  EXPECT_EQ(a.diagram.blocks.find(a.name)->from.find("on")->type, "sliding_friction");
  EXPECT_NO_THROW(compile(a.diagram, registry));
}

/// A mass on a spring, moved by a force.
Diagram body_on_spring() {
  Diagram d;
  d.title = "body";
  d.inputs["force"].unit = "N";
  d.blocks["body"] = node("mass_spring_damper", {{"", "force"}});
  d.blocks["body"].parameters["mass"] = Value("1 kg");
  d.blocks["body"].parameters["stiffness"] = Value("100 N/m");
  d.outputs["x"] = "body.position";
  return d;
}

TEST_F(AddedEffect, OfThreeInOneBlockAnyCanBeTakenOutAndWhatStaysIsAsIfItHadNeverBeenThere) {
  const std::vector<std::string> three{"friction", "quadratic_drag", "stiffening"};
  for (const std::vector<int>& order : {std::vector{0, 1, 2}, {2, 0, 1}, {1, 2, 0}, {2, 1, 0}}) {
    const auto with = [&](int leaving) {
      Diagram d = body_on_spring();
      for (const int i : order)
        if (i != leaving) d = add_effect(d, registry, effects.get(three[i]), "body").diagram;
      return d;
    };
    const Diagram all = with(-1);
    EXPECT_NO_THROW(compile(all, registry)) << diagram_text(all);
    EXPECT_EQ(effects_in(all).size(), 3u) << diagram_text(all);
    for (int leaving = 0; leaving < 3; ++leaving) {
      const Diagram rest = remove_effect(all, registry, three[leaving]);
      EXPECT_EQ(diagram_text(rest), diagram_text(with(leaving))) << three[leaving] << " out of\n" << diagram_text(all);
      EXPECT_NO_THROW(compile(rest, registry));
    }
  }
}

TEST_F(AddedEffect, OfABlockSaysUponWhichCandidateItStandsAndReadsBackSo) {
  Diagram d = add_effect(body_on_spring(), registry, effects.get("stiffening"), "body").diagram;
  d = add_effect(d, registry, effects.get("friction"), "body").diagram;
  const Node& choice = *d.blocks.find("body");
  EXPECT_EQ(choice.choose, "friction");
  const Node& both = *choice.from.find("friction");
  EXPECT_EQ(both.upon, "on");
  EXPECT_EQ(both.effect, "friction");
  EXPECT_EQ(both.type, "mass_with_presliding");
  EXPECT_NE(both.parameters.find("stiffening"), nullptr) << "what was found before stays";
  TemporaryFolder folder;
  EXPECT_EQ(diagram_text(read_diagram(folder.write("body.json", diagram_text(d)))), diagram_text(d));
  EXPECT_THROW(add_effect(d, registry, effects.get("stiffening"), "body"), Error) << "it is there";
  try {
    remove_effect(d, registry, "body");
    FAIL() << "two of them";
  } catch (const Error& e) {
    EXPECT_EQ(e.problems.front().code, "ambiguous_effect");
    EXPECT_NE(e.problems.front().cure.find("friction"), std::string::npos);
  }
}

TEST_F(AddedEffect, OfABlockThatIsAChoiceOfTheUsersLeavesThatChoiceWhenItGoes) {
  Diagram d = body_on_spring();
  Node& body = *d.blocks.find("body");
  Node choice;
  choice.in = body.in;
  body.in.clear();
  choice.from["light"] = body;
  choice.from["heavy"] = body;
  choice.from["heavy"].parameters["mass"] = Value("3 kg");
  choice.choose = "heavy";
  body = choice;
  const Diagram with = add_effect(d, registry, effects.get("stiffening"), "body").diagram;
  EXPECT_EQ(with.blocks.find("body")->from.find("stiffening")->upon, "heavy");
  EXPECT_EQ(effects_in(with).size(), 1u);
  EXPECT_EQ(diagram_text(remove_effect(with, registry, "stiffening")), diagram_text(d));
}

TEST_F(AddedEffect, InsideADiagramChangesThatDiagramAndNamesItsNewFile) {
  auto inner = std::make_shared<Diagram>(stage());
  Diagram outer;
  outer.inputs["w"].unit = "V";
  Node n;
  n.type = "diagram";
  n.file = "stages/stage.json";
  n.nested = inner;
  n.in = {{"", "w"}};
  outer.blocks["rig"] = n;
  outer.outputs["y"] = "rig.y";
  const Added a = add_effect(outer, registry, effects.get("creep"), "rig/actuator.in");
  EXPECT_EQ(a.name, "rig/drive_creep");
  ASSERT_EQ(a.nested.size(), 1u);
  EXPECT_EQ(a.nested.front().first, "stages/stage_creep.json");
  EXPECT_EQ(a.diagram.blocks.find("rig")->file, "stages/stage_creep.json");
  const auto program = compile(a.diagram, registry);
  EXPECT_GE(program->block_index("rig/drive_creep"), 0);
  const Diagram back = remove_effect(a.diagram, registry, "rig/drive_creep");
  EXPECT_EQ(back.blocks.find("rig")->file, "stages/stage.json");
  EXPECT_EQ(diagram_text(*back.blocks.find("rig")->nested), diagram_text(*inner));
}

TEST_F(AddedEffect, ThatIsNotThereCannotBeRemovedAndTheMessageSaysWhatIs) {
  const Added a = add_effect(stage(), registry, effects.get("creep"), "drive");
  try {
    remove_effect(a.diagram, registry, "hysteresis");
    FAIL() << "nothing to remove";
  } catch (const Error& e) {
    EXPECT_EQ(e.problems.front().code, "unknown_effect");
    EXPECT_NE(e.problems.front().cure.find("drive_creep"), std::string::npos) << e.problems.front().cure;
  }
}

TEST_F(AddedEffect, AddedTwiceIsAmbiguousByIdAndClearByName) {
  const Added one = add_effect(stage(), registry, effects.get("creep"), "drive");
  const Added two = add_effect(one.diagram, registry, effects.get("creep"), "actuator");
  try {
    remove_effect(two.diagram, registry, "creep");
    FAIL() << "two of them";
  } catch (const Error& e) {
    EXPECT_EQ(e.problems.front().code, "ambiguous_effect");
  }
  EXPECT_EQ(diagram_text(remove_effect(two.diagram, registry, two.name)), diagram_text(one.diagram));
}

TEST_F(AddedEffect, IsRefusedWhereItClosesALoopThatTheDiagramDidNotHave) {
  const auto with_gain = [&](const char* reads) {
    Diagram d = stage();
    d.blocks["error"] = node("sum", {{"", "u"}, {"", reads}});
    d.blocks["drive"].in = {{"", "error"}};
    d.blocks["slow"] = node("lag", {{"", "sensor"}});
    d.blocks["slow"].parameters["times"] = Value(NumberList{Number{1, "s"}});
    d.blocks["late"] = node("gain", {{"", "slow"}});
    d.blocks["late"].parameters["gain"] = Value("0.1 V/um");
    d.blocks["early"] = node("gain", {{"", "sensor"}});
    d.blocks["early"].parameters["gain"] = Value("0.1 V/um");
    d.outputs["late"] = "late";
    d.outputs["early"] = "early";
    return compile(d, registry);
  };
  const auto before = with_gain("late"), after = with_gain("early");
  EXPECT_NO_THROW(refuse_new_loop(*before, *before, "drive"));
  EXPECT_NO_THROW(refuse_new_loop(*after, *after, "drive")) << "a loop of the user's own is no obstacle";
  try {
    refuse_new_loop(*before, *after, "drive");
    FAIL() << "a new loop was accepted";
  } catch (const Error& e) {
    EXPECT_EQ(e.problems.front().code, "closes_loop");
    EXPECT_EQ(e.problems.front().path, "drive");
    EXPECT_NE(e.problems.front().what.find("error -> drive -> actuator -> sensor -> early -> error"), std::string::npos)
        << e.problems.front().what;
  }
}

}  // namespace
}  // namespace hysteron
