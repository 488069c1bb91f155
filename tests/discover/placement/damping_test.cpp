// Beside a damping that is drawn as a gain dry friction may enter: whoever else reads the speed knows nothing of it.
#include <gtest/gtest.h>

#include <memory>

#include "blocks/register_all.h"
#include "discover/effects/all.h"
#include "discover/placement/add.h"
#include "discover/placement/excitation.h"
#include "discover/placement/places.h"
#include "io/diagram/diagram_file.h"
#include "tests/discover/motor.h"

namespace hysteron {
namespace {

/// The motor as one draws it who knows how long it takes to its speed: no integrator makes that, and friction beside
/// the damping has no other block to enter.
Diagram lagging() {
  Diagram d = testing::motor();
  d.blocks["acceleration"].parameters["gain"] = Value("500 rad/s/(N m)");
  d.blocks["speed"].type = "lag";
  d.blocks["speed"].parameters["times"] = Value(NumberList{Number{0.01, "s"}});
  return d;
}

class Dampings : public ::testing::Test {
 protected:
  std::vector<std::string> dampings(const Diagram& d, const char* effect = "friction") {
    std::vector<std::string> list;
    for (const auto& p : places_of(effects.get(effect), d, registry))
      if (p.kind == "damping") list.push_back(p.at);
    return list;
  }
  std::vector<std::string> integrators(const Diagram& d, const char* effect = "friction") {
    std::vector<std::string> list;
    for (const auto& p : places_of(effects.get(effect), d, registry))
      if (p.by == "integrator_with_friction") list.push_back(p.at);
    return list;
  }
  Diagram with_gain(const Value& gain) {
    Diagram d = lagging();
    d.blocks["bearing"].parameters["gain"] = gain;
    return d;
  }
  using Names = std::vector<std::string>;
  Registry registry = all_blocks();
  Effects effects = all_effects();
};

TEST_F(Dampings, ArePlacesOfFrictionAlone) {
  EXPECT_EQ(dampings(lagging()), Names{"bearing.in"}) << "not the gain that makes the back-EMF, a voltage";
  EXPECT_EQ(dampings(lagging(), "stribeck_friction"), Names{"bearing.in"});
  EXPECT_EQ(dampings(lagging(), "backlash"), Names{});
  const Place p = place_at(lagging(), registry, "bearing.in");
  EXPECT_EQ(p.kind, "damping");
  EXPECT_EQ(p.wire, "speed");
  EXPECT_EQ(p.moves_from(), "bearing");
  for (const auto& group : p.group) EXPECT_EQ(group, "bearing.in") << "one finding with no other place";
}

TEST_F(Dampings, BehindAnIntegratorLeaveTheFrictionToIt) {
  EXPECT_EQ(dampings(testing::motor()), Names{});
  EXPECT_EQ(integrators(testing::motor()), Names{"speed"});
  EXPECT_EQ(integrators(testing::motor(), "stribeck_friction"), Names{"speed"});
  EXPECT_EQ(integrators(lagging()), Names{});
  Diagram further = testing::motor();  // what integrates the speed makes an angle
  further.blocks["angle"].type = "integrator";
  further.blocks["angle"].in = {{"", "speed"}};
  further.outputs["angle"] = "angle";
  EXPECT_EQ(integrators(further), Names{"speed"});
}

TEST_F(Dampings, TheFrictionOfAnIntegratorIsToldByTheGainBeforeIt) {
  const Added a = add_effect(testing::motor(), registry, effects.get("friction"), "speed");
  EXPECT_EQ(a.diagram.blocks.find("speed")->from.find("on")->type, "integrator_with_friction");
  EXPECT_NO_THROW(compile(a.diagram, registry));
  EXPECT_EQ(integrators(a.diagram), Names{}) << "it stands there";
  EXPECT_EQ(dampings(a.diagram), Names{}) << "beside the damping it would be the same force";
  EXPECT_EQ(diagram_text(remove_effect(a.diagram, registry, "speed")), diagram_text(testing::motor()));

  Place p = places_of(effects.get("friction"), testing::motor(), registry).front();
  ASSERT_EQ(p.at, "speed");
  Excitation at;
  at.unit = parse_unit("rad/s^2");
  at.by = p.by;
  at.lowest = -3000;
  at.highest = 3000;
  at.inertia = inertia_before(*compile(testing::motor(), registry), p);
  ASSERT_TRUE(at.inertia.has_value());
  EXPECT_DOUBLE_EQ(*at.inertia, 2e-5);
  const auto laws = effects.get("friction").laws(at);
  const std::string told = effects.get("friction").summary(laws.front(), {600}, at);
  EXPECT_NE(told.find("600 rad/s^2 (10 % of the acceleration): 0.012 N m"), std::string::npos) << told;
}

TEST_F(Dampings, AreKnownByTheirUnitHoweverItIsWritten) {
  EXPECT_EQ(dampings(with_gain("3 uN m/rpm")), Names{"bearing.in"});
  Diagram named = with_gain("$b");
  named.parameters["b"].value = Value("0.3 mN m s/rad");
  EXPECT_EQ(dampings(named), Names{"bearing.in"});
  EXPECT_EQ(dampings(with_gain(0.3)), Names{}) << "a plain number makes a speed of a speed";
}

TEST_F(Dampings, OfACandidateInUseCount) {
  Diagram d = lagging();
  Node& bearing = d.blocks["bearing"];
  Node choice;
  choice.in = bearing.in;
  bearing.in.clear();
  choice.choose = "oil";
  choice.from["oil"] = bearing;
  choice.from["none"] = bearing;
  bearing = choice;
  EXPECT_EQ(dampings(d), Names{"bearing.in"});
}

TEST_F(Dampings, GetTheFrictionAndNobodyElse) {
  const Added a = add_effect(lagging(), registry, effects.get("friction"), "bearing.in");
  EXPECT_EQ(a.name, "speed_friction");
  EXPECT_EQ(a.diagram.blocks.find(a.name)->from.find("on")->type, "bearing_friction");
  EXPECT_EQ(a.diagram.blocks.find("bearing")->in.front().from, a.name);
  EXPECT_EQ(a.diagram.blocks.find("back_emf")->in.front().from, "speed");
  EXPECT_EQ(*a.diagram.outputs.find("w"), "speed");
  EXPECT_NO_THROW(compile(a.diagram, registry));
  EXPECT_EQ(dampings(a.diagram), Names{}) << "it stands there";
  EXPECT_EQ(diagram_text(remove_effect(a.diagram, registry, a.name)), diagram_text(lagging()));
}

TEST_F(Dampings, InsideANestedDiagramAreSeen) {
  Diagram d;
  d.title = "drive";
  d.inputs["u"].unit = "V";
  d.blocks["motor"].type = "diagram";
  d.blocks["motor"].file = "motor.json";
  d.blocks["motor"].nested = std::make_shared<const Diagram>(lagging());
  d.blocks["motor"].in = {{"u", "u"}};
  d.outputs["w"] = "motor.w";
  EXPECT_EQ(dampings(d), Names{"motor/bearing.in"});
  const Place p = place_at(d, registry, "motor/bearing.in");
  EXPECT_EQ(p.wire, "motor/speed");
  EXPECT_EQ(p.moves_from(), "motor/bearing");
  const Added a = add_effect(d, registry, effects.get("friction"), "motor/bearing.in");
  EXPECT_EQ(a.name, "motor/speed_friction");
  EXPECT_NO_THROW(compile(a.diagram, registry));
  EXPECT_EQ(dampings(a.diagram), Names{}) << "it stands there";
}

TEST_F(Dampings, TellTheLawsWhatTheyMakeOfASpeed) {
  const auto program = compile(lagging(), registry);
  const Place p = place_at(lagging(), registry, "bearing.in");
  const auto damping = damping_behind(*program, p, parse_unit("rad/s"));
  ASSERT_TRUE(damping.has_value());
  EXPECT_DOUBLE_EQ(*damping, 3e-4);
  EXPECT_FALSE(damping_behind(*program, p, parse_unit("")).has_value()) << "kg/s may be a flow";
  EXPECT_FALSE(damping_behind(*program, place_at(lagging(), registry, "speed"), parse_unit("rad/s")).has_value());

  Excitation at;
  at.unit = parse_unit("rad/s");
  at.lowest = -200;
  at.highest = 150;
  at.damping = damping;
  const auto laws = effects.get("friction").laws(at);
  EXPECT_EQ(laws.front().block.type, "bearing_friction");
  EXPECT_EQ(laws.front().free.front().scan, (std::vector<double>{6, 60, 600})) << "of 200 rad/s";
  EXPECT_EQ(effects.get("friction").unseen(at), "");
  const std::string told = effects.get("friction").summary(laws.front(), {50, 0.1}, at);
  EXPECT_NE(told.find("0.015 N m"), std::string::npos) << told;
  at.damping = 0;
  EXPECT_NE(effects.get("friction").unseen(at).find("give the gain a value"), std::string::npos);
  at.damping.reset();
  at.unit = parse_unit("V");
  EXPECT_NE(effects.get("friction").unseen(at).find("a damping"), std::string::npos);
}

}  // namespace
}  // namespace hysteron
