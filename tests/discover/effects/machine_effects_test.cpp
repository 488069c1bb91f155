// Effects of machines that turn and have a block of their own (motors, pendulums, gears), each hidden by a formula of
// its own: they vary that block, and are told in units of turning.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <tuple>

#include "discover/placement/places.h"
#include "tests/discover/discoveries.h"
#include "tests/discover/synthetic.h"

namespace hysteron {
namespace {

using namespace testing;

class MachineEffects : public Discoveries {
 protected:
  static double friction_torque(const Discovery& d) {
    return value(d, "contact_stiffness[0]") * value(d, "slip_distance[0]");
  }
};

/// What a machine measures at rows `t` under the voltage `u`.
using Machine = std::function<std::vector<double>(const std::vector<double>& t, const std::vector<double>& u)>;

/// Two recordings to fit to and one to check, with white noise.
DataSet recorded(const Machine& machine, const std::vector<double>& t, double top, double white, const char* unit) {
  std::vector<Recording> list;
  std::uint64_t seed = 4300;
  for (const auto& [role, hertz, part] :
       {std::tuple{Role::train, 0.9, 1.0}, {Role::train, 1.7, 0.7}, {Role::validate, 1.2, 0.85}}) {
    const auto u = sampled(t, [&, hertz = hertz, part = part](double x) {
      const double phase = 2 * std::numbers::pi * hertz * x;
      return top * part * (std::sin(phase) + std::sin(0.31 * phase)) / 2;
    });
    auto y = machine(t, u);
    const auto disturbed = noise(t.size(), white, 0, seed);
    for (std::size_t k = 0; k < y.size(); ++k) y[k] += disturbed[k];
    auto r = recording(std::to_string(seed++) + ".csv", role, t, u, y);
    r.units["y"] = parse_unit(unit);
    list.push_back(std::move(r));
  }
  return data_set(list, white);
}

constexpr int steps = 100;  // in a row

/// The voltage within a row.
double within(const std::vector<double>& u, std::size_t k, int step) {
  return u[k - 1] + (u[k] - u[k - 1]) * (step + 0.5) / steps;
}

/// Coulomb's friction that truly sticks: a step's friction takes away `most`, and what it cannot stop goes on (Moreau's
/// time stepping).
double slowed(double w, double most) { return std::abs(w) <= most ? 0 : w - std::copysign(most, w); }

Value of(double number, const char* unit) { return Value(std::to_string(number) + " " + unit); }

/// Brushes, a winding and a rotor on dry bearings.
struct DryMotor {
  double resistance = 1, inductance = 0.002, constant = 0.05;  // [Ohm], [H], [N m/A]
  double inertia = 2e-4, damping = 1e-4, coulomb = 0.01;       // [kg m^2], [N m s/rad], [N m]

  /// [rad/s]
  std::vector<double> speed(const std::vector<double>& t, const std::vector<double>& u) const {
    std::vector<double> y{0};
    double i = 0, w = 0;
    for (std::size_t k = 1; k < t.size(); ++k) {
      const double h = (t[k] - t[k - 1]) / steps;
      for (int n = 0; n < steps; ++n) {
        i += h / inductance * (within(u, k, n) - resistance * i - constant * w);
        w = slowed(w + h / inertia * (constant * i - damping * w), h * coulomb / inertia);
      }
      y.push_back(w);
    }
    return y;
  }
  Diagram model() const {
    Diagram d;
    d.inputs["u"].unit = "V";
    d.blocks["load"].type = "constant";
    d.blocks["load"].parameters["value"] = of(0, "N m");
    Node& motor = d.blocks["motor"];
    motor.type = "dc_motor";
    motor.parameters["resistance"] = of(resistance, "Ohm");
    motor.parameters["inductance"] = of(inductance, "H");
    motor.parameters["torque_constant"] = of(constant, "N m/A");
    motor.parameters["inertia"] = of(inertia, "kg m^2");
    motor.parameters["damping"] = of(damping, "N m s/rad");
    motor.in = {{"", "u"}, {"", "load"}};
    d.outputs["y"] = "motor.velocity";
    return d;
  }
};

TEST_F(MachineEffects, FrictionOfAMotorIsNamedWithItsTorqueThoughAVoltageDrivesIt) {
  const DryMotor m;
  const auto data =
      recorded([&](const auto& t, const auto& u) { return m.speed(t, u); }, rows(500, 0.006), 3, 0.02, "rad/s");
  const Discovery d = diagnosed(m.model(), data, {"friction", "drive_gain", "amplifier_lag", "saturation"});
  ASSERT_EQ(d.steps.size(), 1u) << tried(d);
  const auto& winner = d.steps.front().winner;
  EXPECT_EQ(winner.effect, "friction") << tried(d);
  EXPECT_NEAR(friction_torque(d), m.coulomb, 0.05 * m.coulomb) << "[N m]: another law of friction, a twentieth\n"
                                                               << tried(d);
  EXPECT_NE(winner.summary.find("N m"), std::string::npos) << winner.summary;
  EXPECT_EQ(d.final_diagram.blocks.find("motor")->from.find("on")->type, "dc_motor_with_presliding");
}

TEST_F(MachineEffects, AMotorWithoutFrictionIsNotGivenAny) {
  DryMotor m;
  m.coulomb = 0;
  const auto data =
      recorded([&](const auto& t, const auto& u) { return m.speed(t, u); }, rows(500, 0.006), 3, 0.02, "rad/s");
  const Discovery d = diagnosed(m.model(), data, {"friction"});
  EXPECT_TRUE(d.steps.empty()) << tried(d);
}

/// A point on an arm, on a dry pivot.
struct DryPendulum {
  double mass = 0.5, length = 0.3, damping = 0.02;  // [kg], [m], [N m s/rad]
  double coulomb = 0.05, gain = 0.2;                // [N m], [N m/V]

  /// [rad]
  std::vector<double> angle(const std::vector<double>& t, const std::vector<double>& u) const {
    const double inertia = mass * length * length, weight = mass * 9.80665 * length;
    std::vector<double> y{0};
    double angle = 0, w = 0;
    for (std::size_t k = 1; k < t.size(); ++k) {
      const double h = (t[k] - t[k - 1]) / steps;
      for (int n = 0; n < steps; ++n) {
        angle += h / 2 * w;
        w += h / inertia * (gain * within(u, k, n) - damping * w - weight * std::sin(angle));
        w = slowed(w, h * coulomb / inertia);
        angle += h / 2 * w;
      }
      y.push_back(angle);
    }
    return y;
  }
  Diagram model() const {
    Diagram d;
    d.inputs["u"].unit = "V";
    Node& torque = d.blocks["torque"];
    torque.type = "gain";
    torque.parameters["gain"] = of(gain, "N m/V");
    torque.in = {{"", "u"}};
    Node& arm = d.blocks["arm"];
    arm.type = "pendulum";
    arm.parameters["mass"] = of(mass, "kg");
    arm.parameters["length"] = of(length, "m");
    arm.parameters["damping"] = of(damping, "N m s/rad");
    arm.in = {{"", "torque"}};
    d.outputs["y"] = "arm.angle";
    return d;
  }
};

TEST_F(MachineEffects, FrictionOfAPendulumIsNamedWithItsTorque) {
  const DryPendulum p;
  const auto data =
      recorded([&](const auto& t, const auto& u) { return p.angle(t, u); }, rows(500, 0.006), 3, 1e-4, "rad");
  const Discovery d = diagnosed(p.model(), data, {"friction", "drive_gain", "amplifier_lag"});
  ASSERT_EQ(d.steps.size(), 1u) << tried(d);
  EXPECT_EQ(d.steps.front().winner.effect, "friction") << tried(d);
  // [N m] Another law of friction, found in steps that are too coarse for a contact as stiff as dry friction: a softer
  // one leaves 4 mrad, and holds a tenth more.
  EXPECT_NEAR(friction_torque(d), p.coulomb, 0.12 * p.coulomb) << tried(d);
  EXPECT_EQ(d.final_diagram.blocks.find("arm")->from.find("on")->type, "pendulum_with_presliding");
}

/// A motor, a gear of ratio 4 with a gap, and a load that its damping holds: [rad] of the load.
struct GearedDrive {
  double motor = 0.002, motor_damping = 0.01;  // [kg m^2], [N m s/rad]
  double load = 0.02, load_damping = 0.2;
  double ratio = 4, stiffness = 60, damping = 0.3;  // [N m/rad], [N m s/rad]
  double gap = 0.03;                                // [rad]
  double gain = 0.1;                                // [N m/V]
};

std::vector<double> geared(const GearedDrive& g, const std::vector<double>& t, const std::vector<double>& u) {
  std::vector<double> y{0};
  double a1 = 0, w1 = 0, a2 = 0, w2 = 0;
  for (std::size_t k = 1; k < t.size(); ++k) {
    const double h = (t[k] - t[k - 1]) / steps;
    for (int i = 0; i < steps; ++i) {
      const double torque = g.gain * within(u, k, i);
      const double twist = a1 / g.ratio - a2, rate = w1 / g.ratio - w2;
      double between = 0;  // teeth push, they do not pull
      if (twist > g.gap / 2) between = std::max(0.0, g.stiffness * (twist - g.gap / 2) + g.damping * rate);
      if (twist < -g.gap / 2) between = std::min(0.0, g.stiffness * (twist + g.gap / 2) + g.damping * rate);
      w1 += h * (torque - between / g.ratio - g.motor_damping * w1) / g.motor;
      w2 += h * (between - g.load_damping * w2) / g.load;
      a1 += h * w1;
      a2 += h * w2;
    }
    y.push_back(a2);
  }
  return y;
}

Diagram geared(const GearedDrive& g) {
  Diagram d;
  d.inputs["u"].unit = "V";
  Node& torque = d.blocks["torque"];
  torque.type = "gain";
  torque.parameters["gain"] = of(g.gain, "N m/V");
  torque.in = {{"", "u"}};
  Node& left = d.blocks["left"];
  left.type = "sum";
  left.parameters["signs"] = Value("+-");
  left.in = {{"", "torque"}, {"", "gear.torque_in"}};
  for (const auto& [name, inertia, damping, from] :
       {std::tuple{"motor", g.motor, g.motor_damping, "left"}, {"load", g.load, g.load_damping, "gear.torque_out"}}) {
    Node& rotor = d.blocks[name];
    rotor.type = "inertia";
    rotor.parameters["inertia"] = of(inertia, "kg m^2");
    rotor.parameters["damping"] = of(damping, "N m s/rad");
    rotor.in = {{"", from}};
  }
  Node& gear = d.blocks["gear"];
  gear.type = "gear";
  gear.parameters["ratio"] = Value(g.ratio);
  gear.parameters["stiffness"] = of(g.stiffness, "N m/rad");
  gear.parameters["damping"] = of(g.damping, "N m s/rad");
  gear.in = {{"", "motor.angle"}, {"", "motor.velocity"}, {"", "load.angle"}, {"", "load.velocity"}};
  d.outputs["y"] = "load.angle";
  return d;
}

TEST_F(MachineEffects, PlayOfAGearIsNamedInRadiansOfItsDrivenSide) {
  const GearedDrive g;
  const auto data =
      recorded([&](const auto& t, const auto& u) { return geared(g, t, u); }, rows(500, 0.006), 3, 1e-4, "rad");
  const Discovery d = diagnosed(geared(g), data, {"backlash", "friction", "quadratic_drag", "amplifier_lag"}, exact());
  ASSERT_EQ(d.steps.size(), 1u) << tried(d);
  const auto& winner = d.steps.front().winner;
  EXPECT_EQ(winner.effect, "backlash") << tried(d);
  EXPECT_NEAR(value(d, "gap"), g.gap, 0.02 * g.gap) << "[rad]: their steps in time are coarser than ours";
  EXPECT_NE(winner.summary.find("mrad"), std::string::npos) << winner.summary;
  EXPECT_EQ(d.final_diagram.blocks.find("gear")->from.find("on")->type, "gear");
}

/// Of a transmission: its name, what says how far its driven side goes, and that way for an angle of 2 rad, in `unit`.
struct Side {
  const char *type, *parameter;
  double value, moved;
  const char* unit;
};

TEST_F(MachineEffects, PlayIsSoughtInTheWayOfTheDrivenSide) {
  for (const Side& side : {Side{"gear", "ratio", 50, 0.04, "rad"}, Side{"belt", "radius", 0.05, 0.1, "m"},
                           Side{"ball_screw", "pitch", 0.005, 0.01 / (2 * std::numbers::pi), "m"}}) {
    Excitation at;
    at.unit = parse_unit("rad");
    at.lowest = -1;
    at.highest = 1;
    at.by = side.type;
    at.own = {{side.parameter, side.value}};
    const auto laws = effects.get("backlash").laws(at);
    ASSERT_EQ(laws.size(), 1u) << side.type;
    const Law& law = laws.front();
    EXPECT_EQ(law.block.type, side.type);
    const auto& gap = law.free.front();
    EXPECT_NEAR(gap.upper, 0.8 * side.moved, 1e-12) << side.type << ": most of the way";
    // Rounded to three digits, that files stay readable.
    EXPECT_NEAR(gap.scan.front(), 0.002 * side.moved, 0.005 * 0.002 * side.moved) << side.type;
    EXPECT_EQ(std::get<Number>(law.block.parameters.find("gap")->content).unit, side.unit) << side.type;
  }
}

TEST_F(MachineEffects, PlayThatATransmissionHasAlreadyIsNotPutInAgain) {
  Diagram d = geared(GearedDrive{});
  const Effect& backlash = effects.get("backlash");
  const auto in_gear = [&] {
    const auto places = places_of(backlash, d, registry, nullptr);
    return std::any_of(places.begin(), places.end(), [](const Place& p) { return p.at == "gear"; });
  };
  EXPECT_TRUE(in_gear());
  d.blocks["gear"].parameters["gap"] = of(0.01, "rad");
  EXPECT_FALSE(in_gear());
}

TEST_F(MachineEffects, PlayMayAlsoStandBetweenAMachineAndItsSensor) {
  const auto where = [&](const Diagram& d) {
    std::vector<std::string> list;
    for (const auto& place : places_of(effects.get("backlash"), d, registry, nullptr)) list.push_back(place.at);
    return list;
  };
  // not on the wire of the load's angle, which the gear reads as well
  EXPECT_EQ(where(geared(GearedDrive{})), (std::vector<std::string>{"gear", "outputs.y"}));
}

/// The play operator behind a motion: what a loose coupling hands on.
std::vector<double> behind_a_loose_coupling(std::vector<double> y, double gap) {
  double held = 0;
  for (double& now : y) now = held = std::clamp(held, now - gap / 2, now + gap / 2);
  return y;
}

TEST_F(MachineEffects, PlayOfASensorIsNotTakenForThatOfTheGear) {
  GearedDrive g;
  g.gap = 0;
  const auto data =
      recorded([&](const auto& t, const auto& u) { return behind_a_loose_coupling(geared(g, t, u), 0.02); },
               rows(500, 0.006), 3, 1e-4, "rad");
  const Discovery d = diagnosed(geared(g), data, {"backlash", "friction", "quadratic_drag", "amplifier_lag"}, exact());
  ASSERT_EQ(d.steps.size(), 1u) << tried(d);
  EXPECT_EQ(d.steps.front().winner.effect, "backlash") << tried(d);
  EXPECT_EQ(d.steps.front().winner.place, "outputs.y") << tried(d);
  EXPECT_NEAR(value(d, "gap"), 0.02, 0.02 * 0.02) << "[rad]";
}

}  // namespace
}  // namespace hysteron
