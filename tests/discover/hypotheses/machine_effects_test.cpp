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
  EXPECT_NEAR(friction_torque(d), m.coulomb, 0.05 * m.coulomb) << "[N m]: another law of friction, a twentieth";
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
  EXPECT_NEAR(friction_torque(d), p.coulomb, 0.05 * p.coulomb) << "[N m]: another law of friction, a twentieth";
  EXPECT_EQ(d.final_diagram.blocks.find("arm")->from.find("on")->type, "pendulum_with_presliding");
}

}  // namespace
}  // namespace hysteron
