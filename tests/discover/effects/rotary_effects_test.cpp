// Effects of what turns, each hidden by a formula of its own: named in units of turning.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/discover/discoveries.h"
#include "tests/discover/synthetic.h"

namespace hysteron {
namespace {

using namespace testing;

class RotaryEffects : public Discoveries {};

struct Shaft {
  double inertia, damping, stiffness;  // [kg m^2], [N m s/rad], [N m/rad]
  double coulomb = 0;                  // [N m]
  double cogging = 0, periods = 0;     // [N m] of the sine, a turn
  double gain = 0.2;                   // [N m/V]
  bool of_velocity = false;            // what is measured
};

/// Turned by a torque, with Coulomb's friction that truly sticks: what a step's friction cannot stop goes on (Moreau's
/// time stepping), 100 steps a row.
std::vector<double> turned(const Shaft& s, const std::vector<double>& t, const std::vector<double>& u) {
  std::vector<double> y{0};
  double angle = 0, w = 0;
  for (std::size_t k = 1; k < t.size(); ++k) {
    const double h = (t[k] - t[k - 1]) / 100;
    for (int i = 0; i < 100; ++i) {
      const double torque = s.gain * (u[k - 1] + (u[k] - u[k - 1]) * (i + 0.5) / 100);
      angle += 0.5 * h * w;
      w += h / s.inertia * (torque + s.cogging * std::sin(s.periods * angle) - s.damping * w - s.stiffness * angle);
      const double most = h * s.coulomb / s.inertia;
      w = std::abs(w) <= most ? 0 : w - std::copysign(most, w);
      angle += 0.5 * h * w;
    }
    y.push_back(s.of_velocity ? w : angle);
  }
  return y;
}

DataSet turned_recordings(const Shaft& s, double white, double step, double seconds) {
  std::vector<Recording> list;
  std::uint64_t seed = 4100;
  const auto t = rows(static_cast<int>(seconds / step), step);
  const auto drive = [&](std::vector<double> hertz, double top) {
    return sampled(t, [&](double x) {
      double sum = 0;
      for (std::size_t i = 0; i < hertz.size(); ++i) sum += std::sin(2 * std::numbers::pi * hertz[i] * x);  // from rest
      return top * sum / static_cast<double>(hertz.size());
    });
  };
  const std::pair<Role, std::vector<double>> drives[] = {{Role::train, drive({0.11, 0.37, 0.83}, 3)},
                                                         {Role::train, drive({0.07, 0.53, 1.3}, 2)},
                                                         {Role::validate, drive({0.13, 0.29, 0.71}, 2.5)}};
  for (const auto& [role, u] : drives) {
    auto y = turned(s, t, u);
    const auto disturbed = noise(t.size(), white, 0, seed);
    for (std::size_t k = 0; k < y.size(); ++k) y[k] += disturbed[k];
    auto r = recording(std::to_string(seed++) + ".csv", role, t, u, y);
    r.units["y"] = parse_unit(s.of_velocity ? "rad/s" : "rad");
    list.push_back(std::move(r));
  }
  return data_set(list, white);
}

Diagram shaft(const Shaft& s) {
  Diagram d;
  d.inputs["u"].unit = "V";
  Node& torque = d.blocks["torque"];
  torque.type = "gain";
  torque.parameters["gain"] = Value(std::to_string(s.gain) + " N m/V");
  torque.in = {{"", "u"}};
  Node& rotor = d.blocks["rotor"];
  rotor.type = "inertia";
  rotor.parameters["inertia"] = Value(std::to_string(s.inertia) + " kg m^2");
  rotor.parameters["damping"] = Value(std::to_string(s.damping) + " N m s/rad");
  if (s.stiffness > 0) rotor.parameters["stiffness"] = Value(std::to_string(s.stiffness) + " N m/rad");
  rotor.in = {{"", "torque"}};
  d.outputs["y"] = s.of_velocity ? "rotor.velocity" : "rotor.angle";
  return d;
}

double friction_torque(const Discovery& d) {
  for (const auto& f : d.steps.front().winner.found)
    if (f.estimate.path == "rotor.coulomb") return f.estimate.used;
  return std::nan("");
}

TEST_F(RotaryEffects, CoulombFrictionOfAnInertiaIsNamedWithItsTorque) {
  const Shaft s{.inertia = 0.02, .damping = 0.05, .stiffness = 8, .coulomb = 0.05};
  const Discovery d = diagnosed(shaft(s), turned_recordings(s, 1e-5, 0.01, 20),
                                {"friction", "quadratic_drag", "cogging", "backlash", "saturation", "asymmetry"});
  ASSERT_EQ(d.steps.size(), 1u) << tried(d);
  const auto& winner = d.steps.front().winner;
  EXPECT_EQ(winner.effect, "friction") << tried(d);
  EXPECT_NEAR(friction_torque(d), 0.05, 2.5e-3) << "[N m]";
  EXPECT_NE(winner.summary.find("N m"), std::string::npos) << winner.summary;
  EXPECT_EQ(d.final_diagram.blocks.find("rotor")->from.find("on")->type, "inertia_with_friction");
}

TEST_F(RotaryEffects, CoulombFrictionOfAShaftThatTurnsFreelyIsSeenInItsSpeed) {
  const Shaft s{.inertia = 0.02, .damping = 0.05, .stiffness = 0, .coulomb = 0.05, .of_velocity = true};
  const Discovery d = diagnosed(shaft(s), turned_recordings(s, 1e-3, 0.01, 20));
  ASSERT_EQ(d.steps.size(), 1u) << tried(d);
  EXPECT_EQ(d.steps.front().winner.effect, "friction") << tried(d);
  EXPECT_NEAR(friction_torque(d), 0.05, 2.5e-3);
}

TEST_F(RotaryEffects, CoggingOfALinearMotorIsNamedWithItsForceAndItsPeriod) {
  // The same motion in metres, with magnets as far apart as on a way of some twenty pitches: 4 periods on 2 pi m.
  const Shaft s{.inertia = 0.02, .damping = 0.05, .stiffness = 0, .cogging = -0.02, .periods = 4, .gain = 0.05};
  DataSet data = turned_recordings(s, 1e-4, 0.005, 20);
  for (auto& r : data.recordings) r.units["y"] = parse_unit("m");
  Diagram d = shaft(s);
  d.blocks["torque"].parameters["gain"] = Value(std::to_string(s.gain) + " N/V");
  Node& mass = d.blocks["rotor"];
  mass.type = "mass_spring_damper";
  mass.parameters = {};
  mass.parameters["mass"] = Value(std::to_string(s.inertia) + " kg");
  mass.parameters["damping"] = Value(std::to_string(s.damping) + " N s/m");
  mass.parameters["stiffness"] = Value("0 N/m");
  d.outputs["y"] = "rotor.position";
  const Discovery found = diagnosed(d, data, {"quadratic_drag", "cogging", "periodic_error"}, exact());
  ASSERT_EQ(winner(found), "cogging") << tried(found);
  // As near as the shaft's: 0.1 % of the period and 1 % of the force.
  EXPECT_NEAR(value(found, "period"), 2 * std::numbers::pi / 4, 2 * std::numbers::pi / 4 * 1e-3);
  EXPECT_NEAR(std::hypot(value(found, "cosine"), value(found, "sine")), 0.02, 2e-4);
}

}  // namespace
}  // namespace hysteron
