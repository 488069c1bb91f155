// What is read off a wire that moves other blocks, too: the speed of a motor makes its back-EMF, and knows nothing of
// the sensor that reads it.
#include <gtest/gtest.h>

#include "blocks/register_all.h"
#include "discover/effects/all.h"
#include "discover/placement/add.h"
#include "discover/placement/places.h"
#include "io/data/dataset.h"
#include "io/diagram/diagram_file.h"

namespace hysteron {
namespace {

Node block(const char* type, std::vector<Wire> in) {
  Node n;
  n.type = type;
  n.in = std::move(in);
  return n;
}

/// u - back-EMF -> torque -> speed, read as w.
Diagram back_emf_motor() {
  Diagram d;
  d.title = "motor";
  d.inputs["u"].unit = "V";
  d.blocks["net"] = block("sum", {{"", "u"}, {"", "back_emf"}});
  d.blocks["net"].parameters["signs"] = Value("+-");
  d.blocks["acceleration"] = block("gain", {{"", "net"}});
  d.blocks["acceleration"].parameters["gain"] = Value("40 rad/s^2/V");
  d.blocks["speed"] = block("integrator", {{"", "acceleration"}});
  d.blocks["back_emf"] = block("gain", {{"", "speed"}});
  d.blocks["back_emf"].parameters["gain"] = Value("0.05 V s/rad");
  d.outputs["w"] = "speed";
  return d;
}

/// The same under a controller that samples the speed.
Diagram drive() {
  Diagram d = back_emf_motor();
  d.inputs["ref"].unit = "rad/s";
  d.inputs.erase("u");
  d.blocks["controller"] = block("discrete_pid", {{"", "ref"}, {"", "speed"}});
  d.blocks["controller"].parameters["period"] = Value("1 ms");
  d.blocks["controller"].parameters["kp"] = Value("0.1 V s/rad");
  d.blocks["net"].in.front().from = "controller";
  return d;
}

class Readings : public ::testing::Test {
 protected:
  std::vector<std::string> where(const char* effect, const Diagram& d) {
    std::vector<std::string> list;
    for (const auto& p : places_of(effects.get(effect), d, registry)) list.push_back(p.at);
    return list;
  }
  Registry registry = all_blocks();
  Effects effects = all_effects();
};

TEST_F(Readings, OfAWireThatMovesOtherBlocksAreWhereASensorActs) {
  for (const char* effect : {"sensor_lag", "sensor_nonlinearity", "quantization", "calibration", "mains_interference"})
    EXPECT_EQ(where(effect, back_emf_motor()), std::vector<std::string>{"outputs.w"}) << effect;
}

TEST_F(Readings, AreOneOfTwoPlacesWhereAControllerActsOnTheWire) {
  EXPECT_EQ(where("sensor_lag", drive()), (std::vector<std::string>{"outputs.w", "speed"}));
}

TEST_F(Readings, AreAPlaceOfWhatLiesBetweenMotionAndSensorBesideTheWireItself) {
  EXPECT_EQ(where("backlash", back_emf_motor()), (std::vector<std::string>{"outputs.w", "speed"}));
}

/// With the effect at its first place, by its first law.
Diagram with(const Diagram& d, const char* effect, const Registry& registry, const Effects& effects) {
  return add_effect(d, registry, effects.get(effect), "").diagram;
}

// Behind the mains or a drift every lag would follow a function of time, and a curve bend what it never saw.
TEST_F(Readings, OfASensorStandBeforeWhatMovesTheReadingAlone) {
  for (const char* stands : {"mains_interference", "sensor_drift", "calibration"}) {
    const Diagram d = with(back_emf_motor(), stands, registry, effects);
    const Diagram both = with(d, "sensor_lag", registry, effects);
    EXPECT_EQ(*both.outputs.find("w"), std::string("w_") + stands);
    EXPECT_EQ(both.blocks.find(std::string("w_") + stands)->in.front().from, "speed_sensor_lag") << stands;
    ASSERT_NE(both.blocks.find("speed_sensor_lag"), nullptr) << stands;
    EXPECT_EQ(both.blocks.find("speed_sensor_lag")->in.front().from, "speed") << stands;
    EXPECT_TRUE(where(stands, both).empty()) << stands << " is offered twice";
  }
}

TEST_F(Readings, OfAnElementOfAVectorAreCalledByItWhateverStandsThere) {
  Diagram d = back_emf_motor();
  d.blocks["both"] = block("mux", {{"", "speed"}, {"", "acceleration"}});
  d.outputs["w"] = "both[0]";
  const Diagram stands = with(d, "mains_interference", registry, effects);
  for (const char* effect : {"sensor_lag", "sensor_nonlinearity"})
    for (const auto& p : places_of(effects.get(effect), stands, registry))
      EXPECT_EQ(p.where().find("mains"), std::string::npos) << effect << " at " << p.where();
}

TEST_F(Readings, AreNoPlacesOfTheirOwnWhereNobodyElseReads) {
  Diagram d = back_emf_motor();
  d.blocks["sensor"] = block("gain", {{"", "speed"}});
  d.blocks["sensor"].parameters["gain"] = Value("1");
  d.outputs["w"] = "sensor";
  EXPECT_EQ(where("sensor_lag", d), std::vector<std::string>{"sensor"});
}

TEST_F(Readings, KeepTheLoopAsItIsAndGiveBackTheDiagram) {
  const Added a = add_effect(back_emf_motor(), registry, effects.get("sensor_lag"), "outputs.w");
  EXPECT_EQ(a.name, "w_sensor_lag");
  EXPECT_EQ(*a.diagram.outputs.find("w"), "w_sensor_lag");
  EXPECT_EQ(a.diagram.blocks.find("back_emf")->in.front().from, "speed") << "the motor feels its own speed";
  EXPECT_EQ(where("sensor_lag", a.diagram), std::vector<std::string>{}) << "it stands there";

  const Added both = add_effect(a.diagram, registry, effects.get("quantization"), "");
  EXPECT_EQ(*both.diagram.outputs.find("w"), "w_quantization") << "behind what stands there";
  EXPECT_EQ(both.diagram.blocks.find("w_quantization")->in.front().from, "w_sensor_lag");

  const Diagram without = remove_effect(both.diagram, registry, "w_sensor_lag");
  EXPECT_EQ(without.blocks.find("w_quantization")->in.front().from, "speed");
  EXPECT_EQ(diagram_text(remove_effect(without, registry, "w_quantization")), diagram_text(back_emf_motor()));
}

TEST_F(Readings, OfABundleStandBeforeItsMux) {
  Diagram d = back_emf_motor();
  d.blocks["both"] = block("mux", {{"", "speed"}, {"", "acceleration"}});
  d.outputs = {};
  d.outputs["y"] = "both";
  const auto places = places_of(effects.get("quantization"), d, registry);
  ASSERT_FALSE(places.empty());
  EXPECT_EQ(places.front().at, "both.in[0]");
  const Added a = add_effect(d, registry, effects.get("quantization"), "both.in[0]");
  EXPECT_EQ(a.diagram.blocks.find("both")->in.front().from, a.name);
  EXPECT_EQ(a.diagram.blocks.find("back_emf")->in.front().from, "speed");
}

/// What a data set holds beside what the diagram reads.
DataSet with_column(const std::string& name, const char* unit) {
  DataSet data;
  data.notes[name].to = name;
  Recording r;
  r.t = {0, 1};
  r.columns[name] = {0, 1};
  r.units[name] = parse_unit(unit);
  data.recordings.push_back(std::move(r));
  return data;
}

TEST_F(Readings, AreCoupledToAColumnInTheUnitOfADriveThatNobodyBound) {
  Diagram d = back_emf_motor();
  d.inputs["u"].unit = "%";
  const auto sides = [&](const DataSet& data) {
    std::vector<std::string> list;
    for (const auto& p : places_of(effects.get("cross_coupling"), d, registry, &data)) list.push_back(p.side);
    return list;
  };
  EXPECT_EQ(sides(with_column("heater2", "%")), (std::vector<std::string>{"heater2", "heater2"}))
      << "behind the core: what is read, and the wire";
  EXPECT_TRUE(sides(with_column("row", "1")).empty()) << "a count is no drive";
}

}  // namespace
}  // namespace hysteron
