// What turns: inertias, gears, belts, screws, motors; by closed forms and by the masses whose laws they share.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/blocks/samples.h"
#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using bench::Bench;
using tools::block;
using tools::Parameters;
constexpr double pi = std::numbers::pi;

const bench::Samples rotary{
    {"inertia", {{"inertia", {2}}, {"damping", {0.8}}, {"stiffness", {50}}}},
    {"inertia_with_friction",
     {{"inertia", {2}}, {"damping", {0.8}}, {"coulomb", {0.4}}, {"breakaway", {0.7}}, {"stribeck_velocity", {0.5}}}},
    {"inertia_with_drag", {{"inertia", {2}}, {"damping", {0.8}}, {"stiffness", {50}}, {"drag", {0.6}}}},
    {"inertia_with_presliding",
     {{"inertia", {2}}, {"stiffness", {50}}, {"contact_stiffness", {20, 9}}, {"slip_distance", {0.1, 0.4}}}},
    {"inertia_with_cogging",
     {{"inertia", {2}}, {"stiffness", {5}}, {"cosine", {0.4}}, {"sine", {-0.3}}, {"periods", {3}}}},
    {"mass_with_cogging", {{"mass", {2}}, {"stiffness", {5}}, {"cosine", {0.4}}, {"sine", {-0.3}}, {"period", {2}}}},
    {"gear", {{"ratio", {3}}, {"stiffness", {7}}, {"damping", {0.3}}, {"efficiency", {0.8}}}},
    {"gear", {{"ratio", {3}}, {"stiffness", {7}}, {"damping", {0.3}}, {"gap", {0.5}}, {"efficiency", {0.8}}}},
    {"gear", {{"ratio", {3}}, {"stiffness", {7}}, {"damping", {0.3}}}},
    {"belt", {{"radius", {0.4}}, {"stiffness", {7}}, {"damping", {0.3}}}},
    {"belt", {{"radius", {0.4}}, {"stiffness", {7}}, {"damping", {0.3}}, {"gap", {0.2}}}},
    {"ball_screw", {{"pitch", {0.9}}, {"stiffness", {7}}, {"damping", {0.3}}, {"pitch_error", {0.1}}}},
    {"ball_screw",
     {{"pitch", {0.9}},
      {"stiffness", {7}},
      {"damping", {0.3}},
      {"gap", {0.2}},
      {"pitch_error", {0.1}},
      {"wobble", {0.05}},
      {"wobble_phase", {0.3}}}},
    {"dc_motor", {{"resistance", {2}}, {"inductance", {0.3}}, {"torque_constant", {0.4}}, {"inertia", {0.2}}}},
    {"dc_motor_with_presliding",
     {{"resistance", {2}},
      {"inductance", {0.3}},
      {"torque_constant", {0.4}},
      {"inertia", {0.2}},
      {"contact_stiffness", {20, 9}},
      {"slip_distance", {0.1, 0.4}},
      {"excess", {0.3}},
      {"contact_time", {0.01}}}},
    {"pendulum_with_presliding",
     {{"mass", {2}}, {"length", {0.5}}, {"contact_stiffness", {20, 9}}, {"slip_distance", {0.1, 0.4}}}},
    {"dc_winding", {{"resistance", {2}}, {"inductance", {0.3}}, {"torque_constant", {0.4}}, {"back_emf", {0.5}}}}};

Traces simulated(const Diagram& d, std::vector<double> instants, double rtol = 1e-9) {
  const auto program = tools::compiled(d);
  SimulateOptions options;
  options.instants = std::move(instants);
  options.until = options.instants.back();
  options.relative_tolerance = rtol;
  options.method = Method::bdf;
  return simulate(*program, start(*program), options);
}

TEST(RotaryBlocks, InertiasTurnAsTheMassesOfTheirLawsMove) {
  const auto sine = [](const std::string& unit) {
    return block("sine", {{"amplitude", "3 " + unit}, {"frequency", "2 Hz"}});
  };
  const auto compare = [&](const std::string& rest, const std::string& other, Parameters linear,
                           Parameters rotary_ones) {
    linear.insert(linear.begin(), {{"mass", "0.2 kg"}, {"damping", "0.8 N s/m"}, {"stiffness", "50 N/m"}});
    rotary_ones.insert(rotary_ones.begin(),
                       {{"inertia", "0.2 kg m^2"}, {"damping", "0.8 N m s/rad"}, {"stiffness", "50 N m/rad"}});
    const auto d = tools::diagram({{"f", sine("N")},
                                   {"t", sine("N m")},
                                   {"m", block(rest, linear, {"f"})},
                                   {"j", block(other, rotary_ones, {"t"})}},
                                  {"m.position", "j.angle"});
    const auto traces = simulated(d, tools::grid(0, 2, 40), 1e-7);
    EXPECT_GT(tools::largest(traces.values[0]), 0.01);
    EXPECT_LT(tools::distance(traces.values[0], traces.values[1]), 1e-6 * tools::largest(traces.values[0])) << other;
  };
  compare("mass_spring_damper", "inertia", {}, {});
  compare("mass_with_drag", "inertia_with_drag", {{"drag", "0.6 N s^2/m^2"}}, {{"drag", "0.6 N m s^2/rad^2"}});
  compare("mass_with_friction", "inertia_with_friction", {{"coulomb", "0.5 N"}, {"breakaway", "0.8 N"}},
          {{"coulomb", "0.5 N m"}, {"breakaway", "0.8 N m"}});
  compare("mass_with_presliding", "inertia_with_presliding",
          {{"contact_stiffness", tools::list({30}, "N/m")}, {"slip_distance", tools::list({0.02}, "m")}},
          {{"contact_stiffness", tools::list({30}, "N m/rad")}, {"slip_distance", tools::list({0.02}, "rad")}});
}

TEST(RotaryBlocks, UnitsOfTurningAreRevolutionsPerMinuteToo) {
  // 30 N m s/rad at 1 N m are 1/30 rad/s = 0.31831 rpm.
  const auto d = tools::diagram(
      {{"t", block("constant", {{"value", "1 N m"}})},
       {"j",
        block("inertia", {{"inertia", "1 g m^2"}, {"damping", "30 N m s/rad"}, {"initial_velocity", "1 rpm"}}, {"t"})}},
      {"j.velocity"});
  const auto traces = simulated(d, {0, 1});
  EXPECT_NEAR(traces.values[0][0], 2 * pi / 60, 1e-15);
  EXPECT_NEAR(traces.values[0][1], 1.0 / 30, 1e-9);
}

TEST(RotaryBlocks, AnInertiaInATroughOfCoggingSwingsLikeAPendulum) {
  // J q'' = -T sin(n q): amplitude 2/n rad is the pendulum's 2 rad; its period 4 K(sin(1)) sqrt(J/(n T)), K by the
  // arithmetic-geometric mean.
  const double n = 4, torque = 3, inertia = 0.2, amplitude = 2 / n;
  double a = 1, g = std::cos(1.0);
  for (int i = 0; i < 30; ++i) {
    const double mean = 0.5 * (a + g);
    g = std::sqrt(a * g);
    a = mean;
  }
  const double period = 2 * pi / a * std::sqrt(inertia / (n * torque));
  const auto d = tools::diagram({{"t", block("constant", {{"value", "0 N m"}})},
                                 {"j", block("inertia_with_cogging",
                                             {{"inertia", "0.2 kg m^2"},
                                              {"cosine", "0 N m"},
                                              {"sine", "-3 N m"},
                                              {"periods", 4.0},
                                              {"initial_angle", "0.5 rad"}},
                                             {"t"})}},
                                {"j.angle"});
  const auto traces = simulated(d, {0.25 * period, 0.5 * period, 5 * period});
  EXPECT_NEAR(traces.values[0][0], 0, 1e-6);
  EXPECT_NEAR(traces.values[0][1], -amplitude, 1e-6);
  EXPECT_NEAR(traces.values[0][2], amplitude, 1e-6);
}

TEST(RotaryBlocks, AnInertiaWithCoggingRestsWhereItsTeethDrawIt) {
  // sin: stable where it falls, at pi/n; -sin at 0. 1 N m of 2 from outside: a twelfth of a period further on.
  const auto rest = [](double sine, double outside) {
    return Bench("inertia_with_cogging", {{"inertia", {1}}, {"cosine", {0}}, {"sine", {sine}}, {"periods", {5}}})
        .rest({outside})[0];
  };
  EXPECT_NEAR(std::fabs(rest(2, 0)), pi / 5, 1e-14);
  EXPECT_NEAR(rest(-2, 0), 0, 1e-14);
  EXPECT_NEAR(rest(-2, 1), pi / 6 / 5, 1e-14);
  EXPECT_TRUE(std::isnan(rest(-2, 3))) << "it turns";
}

TEST(RotaryBlocks, AMassWithCoggingGoesAsAnInertiaWithAsManyPeriodsOnItsWay) {
  // 2 pi/5 m are a fifth of what a turn is: 5 periods. One law, so the same numbers but for the rounding of 2 pi/5.
  const Bench along("mass_with_cogging",
                    {{"mass", {2}}, {"stiffness", {3}}, {"cosine", {0.4}}, {"sine", {-0.3}}, {"period", {2 * pi / 5}}});
  const Bench about("inertia_with_cogging",
                    {{"inertia", {2}}, {"stiffness", {3}}, {"cosine", {0.4}}, {"sine", {-0.3}}, {"periods", {5}}});
  EXPECT_NEAR(along.rest({0.2})[0], about.rest({0.2})[0], 1e-15);
  // m dv/dt at x = period/4: the sine alone, -0.3 N, with 0.2 N from outside and 3 N/m.
  const Bench free("mass_with_cogging", {{"mass", {2}}, {"cosine", {0.4}}, {"sine", {-0.3}}, {"period", {0.8}}});
  EXPECT_NEAR(free.derivative({0.2}, {0.2, 0})[1], (0.2 - 0.3) / 2, 1e-15);
}

TEST(GearBlock, CarriesTorqueWithItsRatioAndLosesItsShare) {
  const Bench whole("gear", {{"ratio", {5}}, {"stiffness", {100}}});
  EXPECT_EQ(whole.output(0, {1, 0, 0.1, 0}), (bench::Numbers{10, 2})) << "0.1 rad of twist: 10 N m out, a fifth in";
  const Bench lossy("gear", {{"ratio", {5}}, {"stiffness", {100}}, {"efficiency", {0.8}}});
  EXPECT_NEAR(lossy.output(0, {1, 9, 0.1, 1.8})[1], 2 / 0.8, 1e-12) << "drives";
  EXPECT_NEAR(lossy.output(0, {1, -9, 0.1, -1.8})[1], 2 * 0.8, 1e-12) << "is driven back by its load";
  EXPECT_NEAR(lossy.output(0, {0, -9, 0.1, -1.8})[1], -2 / 0.8, 1e-12) << "drives the other way";
}

TEST(GearBlock, HasPlayWithinItsGapAndNeverPulls) {
  const Bench b("gear", {{"ratio", {1}}, {"stiffness", {100}}, {"damping", {3}}, {"gap", {0.02}}});
  EXPECT_EQ(b.output(0, {0.009, 5, 0, 0})[0], 0);
  EXPECT_NEAR(b.output(0, {0.03, 0, 0, 0})[0], 2, 1e-13);
  EXPECT_NEAR(b.output(0, {0.03, 0.1, 0, 0})[0], 2.3, 1e-13);
  EXPECT_EQ(b.output(0, {0.03, -1, 0, 0})[0], 0) << "3 N m of damping would pull";
  EXPECT_NEAR(b.output(0, {-0.03, 0, 0, 0})[0], -2, 1e-13);
}

TEST(GearBlock, AnInertiaThatCrossesTheGapKeepsItsSpeedAndRebounds) {
  // From rest in the middle of the gap the driven side stays; the driver, 1 rad/s and 0.2 kg m^2, meets 0.2 kg m^2 on
  // 500 N m/rad at half of the gap, 0.1 rad; without damping they exchange their speeds within pi/sqrt(2 k/J).
  const auto free = [](const std::string& speed) {
    return Parameters{{"inertia", "0.2 kg m^2"}, {"initial_velocity", speed}};
  };
  const auto d = tools::diagram({{"back", block("gain", {{"gain", -1.0}}, {"g.torque_in"})},
                                 {"a", block("inertia", free("1 rad/s"), {"back"})},
                                 {"b", block("inertia", free("0 rad/s"), {"g.torque_out"})},
                                 {"g", block("gear", {{"ratio", 1.0}, {"stiffness", "500 N m/rad"}, {"gap", "0.2 rad"}},
                                             {"a.angle", "a.velocity", "b.angle", "b.velocity"})}},
                                {"a.velocity", "b.velocity"});
  const double contact = pi / std::sqrt(2 * 500 / 0.2);
  const auto traces = simulated(d, {0.09, 0.1 + 0.5 * contact, 0.1 + contact + 1e-3, 0.2});
  const double expected[2][4] = {{1, 0.5, 0, 0}, {0, 0.5, 1, 1}};
  for (std::size_t s = 0; s < 2; ++s)
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(traces.values[s][k], expected[s][k], 1e-6) << s << k;
}

TEST(BallScrewBlock, MovesByItsPitchAndItsErrors) {
  const Bench b("ball_screw", {{"pitch", {5e-3}}, {"stiffness", {1e6}}, {"pitch_error", {1e-3}}, {"wobble", {2e-6}}});
  // A quarter beyond ten turns: 51.25 mm and 51.25 um of pitch error and 2 um; the nut is where it would be without.
  const auto y = b.output(0, {20.5 * pi, 0, 51.25e-3, 0});
  EXPECT_NEAR(y[0], 1e6 * (51.25e-6 + 2e-6), 1e-6);
  EXPECT_NEAR(y[1], y[0] * 5e-3 / (2 * pi), 1e-9);
  EXPECT_NEAR(Bench("belt", {{"radius", {0.02}}, {"stiffness", {1e5}}}).output(0, {1, 0, 0.019, 0})[1], 2, 1e-12);
}

TEST(BallScrewBlock, LosesNoEnergyWithoutDampingAndLosses) {
  // A screw of 1e-4 kg m^2 and a table of 20 kg on 1e7 N/m swing against each other: energy before and behind.
  const auto d = tools::diagram(
      {{"back", block("gain", {{"gain", -1.0}}, {"s.torque"})},
       {"screw", block("inertia", {{"inertia", "1e-4 kg m^2"}, {"initial_velocity", "100 rad/s"}}, {"back"})},
       {"table", block("mass_spring_damper", {{"mass", "20 kg"}, {"stiffness", "0 N/m"}}, {"s.force"})},
       {"s", block("ball_screw", {{"pitch", "10 mm"}, {"stiffness", "1e7 N/m"}},
                   {"screw.angle", "screw.velocity", "table.position", "table.velocity"})}},
      {"screw.velocity", "table.velocity", "screw.angle", "table.position"});
  const auto traces = simulated(d, tools::grid(0, 0.05, 50), 1e-10);
  for (std::size_t k = 0; k < traces.t.size(); ++k) {
    const double w = traces.values[0][k], v = traces.values[1][k];
    const double stretch = traces.values[2][k] * 10e-3 / (2 * pi) - traces.values[3][k];
    EXPECT_NEAR(0.5 * 1e-4 * w * w + 10 * v * v + 0.5e7 * stretch * stretch, 0.5, 1e-6) << traces.t[k];
  }
}

TEST(DcMotorBlock, SettlesAtItsSpeedUnderLoadWithItsTwoTimes) {
  // Steady: i = (K w/..): u = R i + K w, K i = b w + load. Its way there by the roots of J L s^2 + (J R + b L) s + b R
  // + K^2.
  const double r = 2, l = 3e-3, k = 0.05, j = 2e-5, b = 1e-5, u = 12, load = 0.02;
  const double speed = (u * k - r * load) / (b * r + k * k);
  const double half = (j * r + b * l) / (2 * j * l), root = std::sqrt(half * half - (b * r + k * k) / (j * l));
  const double s1 = -half + root, s2 = -half - root;
  const auto d = tools::diagram({{"u", block("constant", {{"value", "12 V"}})},
                                 {"load", block("constant", {{"value", "0.02 N m"}})},
                                 {"m", block("dc_motor",
                                             {{"resistance", "2 Ohm"},
                                              {"inductance", "3 mH"},
                                              {"torque_constant", "0.05 N m/A"},
                                              {"inertia", "2e-5 kg m^2"},
                                              {"damping", "1e-5 N m s/rad"}},
                                             {"u", "load"})}},
                                {"m.velocity", "m.current"});
  const auto t = tools::grid(0, 0.2, 40);
  const auto traces = simulated(d, t);
  // w = speed + A e^(s1 t) + B e^(s2 t), w(0) = 0, w'(0) = -load/J.
  const double first = (-load / j + s2 * speed) / (s1 - s2), second = -speed - first;
  for (std::size_t i = 0; i < t.size(); ++i)
    EXPECT_NEAR(traces.values[0][i], speed + first * std::exp(s1 * t[i]) + second * std::exp(s2 * t[i]), 1e-5) << t[i];
  EXPECT_NEAR(traces.values[1].back(), (b * speed + load) / k, 1e-5);
}

TEST(DcMotorBlock, IsAWindingAndAnInertia) {
  const Parameters winding{
      {"resistance", "2 Ohm"}, {"inductance", "3 mH"}, {"torque_constant", "0.05 N m/A"}, {"back_emf", "0.04 V s/rad"}};
  Parameters motor = winding;
  motor.insert(motor.end(), {{"inertia", "2e-5 kg m^2"}, {"damping", "1e-5 N m s/rad"}});
  const auto d = tools::diagram(
      {{"u", block("sine", {{"amplitude", "5 V"}, {"frequency", "8 Hz"}})},
       {"none", block("constant", {{"value", "0 N m"}})},
       {"m", block("dc_motor", motor, {"u", "none"})},
       {"w", block("dc_winding", winding, {"u", "j.velocity"})},
       {"j", block("inertia", {{"inertia", "2e-5 kg m^2"}, {"damping", "1e-5 N m s/rad"}}, {"w.torque"})}},
      {"m.angle", "j.angle"});
  const auto traces = simulated(d, tools::grid(0, 0.5, 50));
  EXPECT_GT(tools::largest(traces.values[0]), 1);
  EXPECT_LT(tools::distance(traces.values[0], traces.values[1]), 1e-6);
}

const Parameters motor_in_bearings{{"resistance", "2 Ohm"},           {"inductance", "3 mH"},
                                   {"torque_constant", "0.05 N m/A"}, {"inertia", "2e-5 kg m^2"},
                                   {"damping", "0.02 N m s/rad"},     {"contact_stiffness", "1 N m/rad"},
                                   {"slip_distance", "20 mrad"}};

/// Angle and speed of a block some seconds behind a first input that went up to `top` within one.
std::vector<double> behind_a_ramp(const std::string& type, const Parameters& parameters, const std::string& unit,
                                  double top, const std::string& angle, const std::string& speed) {
  const auto u = block("ramp", {{"slope", std::to_string(top) + " " + unit + "/s"}, {"duration", "1 s"}});
  auto d = tools::diagram({{"u", u}, {"m", block(type, parameters, {"u"})}}, {"m." + angle, "m." + speed});
  if (unit == "V") {
    d.blocks["no_load"] = block("constant", {{"value", "0 N m"}});
    d.blocks["m"] = block(type, parameters, {"u", "no_load"});
  }
  const auto traces = simulated(d, {0, 1, 2, 3, 4, 6});
  return {traces.values[0].back(), traces.values[1].back()};
}

TEST(DcMotorInBearings, GivesWayLikeASpringAndIsThenHeld) {
  // 0.4 V on 2 Ohm: 0.01 N m, half of what the bearings hold. On a way without a turn Dahl's element holds
  // k d (1 - exp(-x/d)); the damping lets it come to rest without one.
  const auto end = behind_a_ramp("dc_motor_with_presliding", motor_in_bearings, "V", 0.4, "angle", "velocity");
  EXPECT_NEAR(end[0], 0.02 * std::log(2), 1e-4 * 0.02) << "[rad]";
  EXPECT_NEAR(end[1], 0, 1e-6);
}

TEST(DcMotorInBearings, TurnsSlowerByTheTorqueOfItsFriction) {
  // K (u - K w)/R = b w + k d.
  const auto end = behind_a_ramp("dc_motor_with_presliding", motor_in_bearings, "V", 12, "angle", "velocity");
  EXPECT_NEAR(end[1], (0.05 * 12 / 2 - 0.02) / (0.02 + 0.05 * 0.05 / 2), 1e-5) << "[rad/s]";
}

TEST(PendulumInBearings, HangsWhereItsWeightAndItsPivotHoldTheTorque) {
  const double torque = 3, k = 50, slip = 0.02, weight = 2 * 9.80665 * 0.5;
  const auto end = behind_a_ramp("pendulum_with_presliding",
                                 {{"mass", "2 kg"},
                                  {"length", "0.5 m"},
                                  {"damping", "6 N m s/rad"},  // without a turn, to rest in half a second
                                  {"contact_stiffness", "50 N m/rad"},
                                  {"slip_distance", "20 mrad"}},
                                 "N m", torque, "angle", "speed");
  EXPECT_GT(end[0], 0.1);
  EXPECT_NEAR(weight * std::sin(end[0]) + k * slip * (1 - std::exp(-end[0] / slip)), torque, 1e-3 * torque);
}

}  // namespace
}  // namespace hysteron
