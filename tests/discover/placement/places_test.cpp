#include "discover/placement/places.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "blocks/register_all.h"
#include "discover/effects/all.h"
#include "discover/placement/add.h"
#include "discover/wiring/wiring.h"

namespace hysteron {
namespace {

Node typed_node(const char* type, std::vector<Wire> in) {
  Node n;
  n.type = type;
  n.in = std::move(in);
  return n;
}

/// u -> dynamics -> sensor(gain, offset) -> y
Diagram linear_stage() {
  Diagram d;
  d.inputs["u"].unit = "V";
  d.blocks["stage"] = typed_node("transfer_function", {{"", "u"}});
  d.blocks["stage"].parameters["gain"] = Value("1.2 um/V");
  d.blocks["stage"].parameters["num"] = Value(NumberList{Number{1, {}}});
  d.blocks["stage"].parameters["den"] = Value(NumberList{Number{1e-3, {}}, Number{1, {}}});
  d.blocks["sensor"] = typed_node("calibration", {{"", "stage"}});
  d.blocks["sensor"].parameters["gain"] = Value("1");
  d.blocks["sensor"].parameters["offset"] = Value("0.4 um");
  d.outputs["y"] = "sensor";
  return d;
}

Diagram hysteretic_stage() {
  Diagram d = linear_stage();
  d.blocks["stage"] = typed_node("prandtl_ishlinskii", {{"", "u"}});
  d.blocks["stage"].parameters["thresholds"] = Value(NumberList{Number{0, "V"}, Number{1, "V"}});
  d.blocks["stage"].parameters["weights"] = Value(NumberList{Number{1, "um/V"}, Number{0.2, "um/V"}});
  return d;
}

class Places : public ::testing::Test {
 protected:
  std::vector<std::string> where(const char* effect, const Diagram& d) {
    std::vector<std::string> list;
    for (const auto& p : places_of(effects.get(effect), d, registry)) list.push_back(p.at);
    return list;
  }
  /// The diagram with an effect at a wire that reads `side` beside it; `unit` of the wire.
  Added with_beside(const Diagram& d, const char* effect, const char* at, const char* side, const char* unit) {
    Excitation c;
    c.unit = c.side_unit = parse_unit(unit);
    const auto& e = effects.get(effect);
    Place place = place_at(d, registry, at);
    place.side = side;
    return add_effect(d, registry, e, e.laws(c).front(), place);
  }
  Registry registry = all_blocks();
  Effects effects = all_effects();
};

TEST_F(Places, OfAChainAreTheDriveTheCoreAndTheSignalBeforeTheOffsetOfTheSensor) {
  EXPECT_EQ(where("amplifier_lag", linear_stage()), std::vector<std::string>{"u"});
  EXPECT_EQ(where("sensor_lag", linear_stage()), std::vector<std::string>{"stage"})
      << "a lag must not act on the sensor's zero";
  EXPECT_EQ(where("hysteresis", linear_stage()), (std::vector<std::string>{"u", "stage"}));
  EXPECT_EQ(where("creep", linear_stage()), std::vector<std::string>{"stage"}) << "creep adds behind the core";
  EXPECT_EQ(where("calibration", linear_stage()), std::vector<std::string>{"sensor"});
}

TEST_F(Places, OfAMemoryAreBeforeAndBehindIt) {
  EXPECT_EQ(where("creep", hysteretic_stage()), std::vector<std::string>{"stage"});
  EXPECT_EQ(where("initial_remanence", hysteretic_stage()), std::vector<std::string>{"stage"});
  EXPECT_TRUE(where("initial_remanence", linear_stage()).empty()) << "nothing remembers there";
}

TEST_F(Places, ThatOnlyLinearBlocksSeparateCannotBeToldApartByALag) {
  const auto lag = effects.get("amplifier_lag");
  const auto in = places_of(lag, linear_stage(), registry).front();
  const auto out = places_of(effects.get("sensor_lag"), linear_stage(), registry).front();
  EXPECT_EQ(in.group_for(lag), out.group_for(lag));
  const auto in_plays = places_of(lag, hysteretic_stage(), registry).front();
  const auto out_plays = places_of(effects.get("sensor_lag"), hysteretic_stage(), registry).front();
  EXPECT_NE(in_plays.group_for(lag), out_plays.group_for(lag))
      << "a lag before plays is another thing than behind them";
  const auto delay = effects.get("dead_time");
  EXPECT_EQ(in_plays.group_for(delay), out_plays.group_for(delay))
      << "a delay may change places with anything that has no clock";
}

TEST_F(Places, OfTheCommandStayBeforeAnEffectOfTheCoreThatWasFoundFirst) {
  Excitation at;
  at.unit = parse_unit("V");
  const auto& h = effects.get("hysteresis");
  const Added a =
      add_effect(linear_stage(), registry, h, h.laws(at).front(), places_of(h, linear_stage(), registry).front());
  EXPECT_EQ(where("amplifier_lag", a.diagram), std::vector<std::string>{"u_hysteresis.in"});
  EXPECT_TRUE(where("hysteresis", a.diagram).empty() || where("hysteresis", a.diagram).front() != "u")
      << "it stands there already";
}

TEST_F(Places, OfTheDeviceStayBeforeWhatTheSensorDoesWhicheverWasFoundFirst) {
  Excitation at;
  at.unit = parse_unit("um");
  for (const char* first : {"sensor_nonlinearity", "rectification"}) {
    const auto& sensor = effects.get(first);
    const auto places = places_of(sensor, linear_stage(), registry);
    const Added a = add_effect(linear_stage(), registry, sensor, sensor.laws(at).front(), places.back());
    const std::string before = std::string("stage_") + first + ".in";
    for (const char* effect : {"structural_resonance", "creep", "backlash"}) {
      EXPECT_EQ(where(effect, a.diagram), std::vector<std::string>{before}) << effect;
      EXPECT_EQ(places_of(effects.get(effect), a.diagram, registry).front().where(), "stage")
          << "it is called by the wire, not by what stands there";
    }
    EXPECT_EQ(where("sensor_lag", a.diagram), std::vector<std::string>{"stage"}) << "of the sensor, too: behind it";
  }
  // A limit of the command is none of the sensor's: a curve of the device comes behind it.
  const auto& limit = effects.get("saturation");
  at.unit = parse_unit("V");
  const Added a = add_effect(linear_stage(), registry, limit, limit.laws(at).front(),
                             places_of(limit, linear_stage(), registry).front());
  EXPECT_EQ(where("asymmetry", a.diagram).front(), "u");
}

TEST_F(Places, WhatTheCableOfASensorPicksUpStaysBehindEverything) {
  Excitation at;
  at.unit = parse_unit("um");
  const auto& mains = effects.get("mains_interference");
  const Added a = add_effect(linear_stage(), registry, mains, mains.laws(at).front(),
                             places_of(mains, linear_stage(), registry).front());
  for (const char* effect : {"dead_time", "sensor_nonlinearity", "creep", "structural_resonance", "hysteresis"})
    EXPECT_EQ(where(effect, a.diagram), where(effect, linear_stage())) << effect;
}

TEST_F(Places, ABlockThatWasGivenAnotherLawIsStillTheCoreOfItsAxis) {
  // Of two axes with plays, one comes late: the other one is not all that is left of the cores.
  Diagram d = hysteretic_stage();
  d.inputs["u2"] = hysteretic_stage().inputs["u"];
  for (const auto& [name, node] : hysteretic_stage().blocks) {
    Node& second = d.blocks[name + "2"] = node;
    for (auto& wire : second.in) wire.from += "2";
  }
  for (const auto& [name, from] : hysteretic_stage().outputs) d.outputs[name + "2"] = from + "2";
  const auto& late = effects.get("rate_dependence");
  const auto at = places_of(late, d, registry);
  ASSERT_EQ(at.size(), 2u);
  Excitation c;
  c.unit = parse_unit("um");
  const Added found = add_effect(d, registry, late, late.laws(c).front(), at.front());
  for (const char* effect :
       {"asymmetry", "creep", "backlash", "cross_coupling", "temperature_gain", "structural_resonance"})
    EXPECT_EQ(where(effect, found.diagram), where(effect, d)) << effect;
}

TEST_F(Places, WhatWasFoundDoesNotMoveWhereElseSomethingMayEnter) {
  // Both bring a memory; the model had none, so that its core is the whole way from the drive to what is measured.
  const auto with = [&](const char* effect, const char* at) {
    Excitation c;
    c.unit = parse_unit(std::string(at) == "u" ? "V" : "um");
    const auto& e = effects.get(effect);
    return add_effect(linear_stage(), registry, e, e.laws(c).front(), place_at(linear_stage(), registry, at)).diagram;
  };
  for (const char* effect : {"asymmetry", "creep", "amplifier_lag", "sensor_nonlinearity", "backlash"}) {
    EXPECT_EQ(where(effect, with("friction", "stage")).size(), where(effect, linear_stage()).size()) << effect;
    EXPECT_EQ(where(effect, with("hysteresis", "u")).size(), where(effect, linear_stage()).size()) << effect;
  }
}

/// Ageing and a gain by temperature read a second signal: that one is no place for anything.
TEST_F(Places, BesideAnEffectThatReadsASecondSignalStayThoseOfTheSignalItself) {
  Diagram d = linear_stage();
  d.inputs["T"] = {"degC", "", 0};
  const Added a = with_beside(d, "temperature_gain", "stage", "T", "um");
  for (const char* effect : {"amplifier_lag", "dead_time", "sensor_nonlinearity", "creep", "saturation", "hysteresis"})
    EXPECT_EQ(where(effect, a.diagram), where(effect, linear_stage())) << effect;
  for (const auto& p : find_places(a.diagram, registry)) EXPECT_TRUE(p.at == "u" || p.at == "stage") << p.at;
}

TEST_F(Places, BeforeAnEffectThatReadsASecondSignalAreNamedByItsPort) {
  Excitation at;
  at.unit = parse_unit("V");
  Diagram d = linear_stage();
  d.inputs["cycles_before"] = {"", "", 0};
  const Added a = with_beside(d, "ageing", "u", "cycles_before", "V");
  const auto& lag = effects.get("amplifier_lag");
  const auto places = places_of(lag, a.diagram, registry);
  ASSERT_EQ(places.size(), 1u);
  const Added both = add_effect(a.diagram, registry, lag, lag.laws(at).front(), places.front());
  EXPECT_EQ(both.diagram.blocks.find("u_ageing")->in.front().from, both.name) << "the amplifier comes first";
}

/// Two stages with a sensor each.
Diagram two_stages() {
  Diagram d = linear_stage();
  const Diagram second = linear_stage();
  d.inputs["u2"].unit = "V";
  d.blocks["stage2"] = *second.blocks.find("stage");
  d.blocks["stage2"].in = {{"", "u2"}};
  d.blocks["sensor2"] = *second.blocks.find("sensor");
  d.blocks["sensor2"].in = {{"", "stage2"}};
  d.outputs["y2"] = "sensor2";
  return d;
}

TEST_F(Places, OfOneAxisStayOnItsWayWhenACouplingReadsIt) {
  const Diagram d = two_stages();
  const Added a = with_beside(d, "cross_coupling", "stage2", "stage", "um");
  const Wiring w(a.diagram, registry);
  EXPECT_EQ(w.outputs_on_the_way("stage"), std::vector<std::string>{"y"});
  EXPECT_EQ(w.outputs_on_the_way("stage2"), std::vector<std::string>{"y2"});
  EXPECT_TRUE(w.reaches_output("stage"));
  EXPECT_EQ(where("sensor_nonlinearity", a.diagram), where("sensor_nonlinearity", d))
      << "before the zero of the sensor, whoever else reads the motion";
}

TEST_F(Places, AreFoundWhereEachStageIsReachedByTwoWays) {
  // 2^40 ways lead through 40 stages of two wires each: each wire is to be looked at once.
  Diagram d = two_stages();
  std::string from = "stage2";
  for (int i = 0; i < 40; ++i) {
    const std::string gain = "gain" + std::to_string(i), sum = "sum" + std::to_string(i);
    d.blocks[gain] = typed_node("gain", {{"", from}});
    d.blocks[gain].parameters["gain"] = Value("0.01");
    d.blocks[sum] = typed_node("sum", {{"", from}, {"", gain}});
    d.blocks[sum].parameters["signs"] = Value("++");
    from = sum;
  }
  d.blocks["sensor2"].in = {{"", from}};
  const auto before = places_of(effects.get("cross_coupling"), two_stages(), registry);
  const auto at = places_of(effects.get("cross_coupling"), d, registry);
  const auto of_first_axis = [](const std::vector<Place>& places) {
    return std::count_if(places.begin(), places.end(), [](const Place& p) { return p.wire == "stage"; });
  };
  EXPECT_GT(of_first_axis(before), 0);
  EXPECT_EQ(of_first_axis(at), of_first_axis(before));
}

TEST_F(Places, OfCouplingsBothWaysReadEachAxisOwnMotion) {
  const Added one = with_beside(two_stages(), "cross_coupling", "stage2", "stage", "um");
  const Added both = with_beside(one.diagram, "cross_coupling", "stage", "stage2", "um");
  const auto wires = [&](const std::string& block) {
    std::vector<std::string> list;
    for (const auto& wire : both.diagram.blocks.find(block)->in) list.push_back(wire.from);
    return list;
  };
  EXPECT_EQ(wires("stage2_cross_coupling"), (std::vector<std::string>{"stage2", "stage"}))
      << "what the first axis gets from the second does not come back";
  EXPECT_EQ(wires("stage_cross_coupling"), (std::vector<std::string>{"stage", "stage2"}));
  EXPECT_EQ(both.diagram.blocks.find("sensor")->in.front().from, "stage_cross_coupling");
  const Added crept = with_beside(one.diagram, "creep", "stage", "", "um");
  EXPECT_EQ(crept.diagram.blocks.find("stage2_cross_coupling")->in.back().from, "stage_creep")
      << "the other axis gets the motion as it is";
  EXPECT_EQ(remove_effect(both.diagram, registry, "stage_cross_coupling").blocks.find("sensor")->in.front().from,
            "stage");
}

TEST_F(Places, OfABundleAreThoseOfItsWires) {
  Diagram d = linear_stage();
  d.blocks["second"] = *linear_stage().blocks.find("sensor");
  d.blocks["second"].in = {{"", "stage"}};
  d.blocks["both"] = typed_node("mux", {{"", "sensor"}, {"", "second"}});
  d.outputs = {};
  d.outputs["y"] = "both";
  EXPECT_EQ(where("calibration", d), (std::vector<std::string>{"sensor", "second"}));
}

TEST_F(Places, NamedInTheDiagramGoBeforeThoseWorkedOut) {
  Diagram d = linear_stage();
  d.places["command"] = {"stage"};
  EXPECT_EQ(where("amplifier_lag", d), std::vector<std::string>{"stage"});
}

}  // namespace
}  // namespace hysteron
