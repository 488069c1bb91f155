// What bends, switches, winds or is moved, one block at a time as in single_blocks.cpp.
#include <algorithm>
#include <array>
#include <cmath>

#include "benchmarks/single_blocks.h"

namespace hysteron::benchmarks {
namespace {

constexpr double lever = 0.02, stiffness = 5000, damping = 20, half = 0.001;  // of a belt, SI

/// Of what a belt or a screw moves by, for an angle.
double contact_force(const std::array<double, 4>& u, double per_angle) {
  const double stretch = per_angle * u[0] - u[2], rate = damping * (per_angle * u[1] - u[3]);
  if (stretch > half) return std::max(0.0, stiffness * (stretch - half) + rate);
  return stretch < -half ? std::min(0.0, stiffness * (stretch + half) + rate) : 0.0;
}

constexpr double resistance = 2, inductance = 0.01, constant = 0.1;  // of a winding, SI

/// The current behind voltage and what the motion induces, exact for straight inputs.
void winding_rows(std::vector<double>& y, double induced) {
  const double decay = std::exp(-row * resistance / inductance), share = (1 - decay) / (row * resistance / inductance);
  const auto &u = input(0), &v = input(1);
  double i = 0;
  for (std::size_t k = 0; k < samples; ++k) {
    if (k > 0) {
      const double before = (u[k - 1] - induced * v[k - 1]) / resistance, now = (u[k] - induced * v[k]) / resistance;
      i = decay * i + (share - decay) * before + (1 - share) * now;
    }
    y[k] = i;
  }
}

/// Two phases of 50 teeth, one step of Runge-Kutta a row.
void stepper_rows(std::vector<double>& y) {
  runge_kutta_rows<2, 4>(
      {0, 0}, y,
      [](const auto& x, const auto& u) {
        const double back = constant * u[3];
        return std::array<double, 2>{(u[0] - resistance * x[0] + back * std::sin(50 * u[2])) / inductance,
                                     (u[1] - resistance * x[1] - back * std::cos(50 * u[2])) / inductance};
      },
      [](const auto& x, const auto& u) {
        return constant * (x[1] * std::cos(50 * u[2]) - x[0] * std::sin(50 * u[2]));
      });
}

Node winding(const char* type) { return node(type, {{"resistance", "2 ohm"}, {"inductance", "10 mH"}}); }

/// x+ = A x + b u, y = c x + d u, at every row.
void discrete_rows(std::vector<double>& y) {
  const auto& u = input(0);
  double p = 0, q = 0;
  for (std::size_t k = 0; k < samples; ++k) {
    y[k] = p + 0.5 * q + 0.1 * u[k];
    const double next = 0.8 * p + 0.3 * q;
    q = -0.3 * p + 0.8 * q + 0.2 * u[k];
    p = next;
  }
}

/// What u was at t [s], straight between the rows; at rest before the first.
double past(const std::vector<double>& u, double t) {
  const double place = std::max(0.0, t / row);
  const auto k = std::min(static_cast<std::size_t>(place), samples - 2);
  return u[k] + (place - static_cast<double>(k)) * (u[k + 1] - u[k]);
}

void delayed_rows(std::vector<double>& y) {
  for (std::size_t k = 0; k < samples; ++k)
    y[k] = past(input(0), static_cast<double>(k) * row - std::clamp(input(1)[k], 0.0, 0.5));
}

/// Two impulses that leave a mode of 20 Hz and a damping of 0.1 at rest.
void shaped_rows(std::vector<double>& y) {
  const double root = std::sqrt(1 - 0.1 * 0.1), k1 = std::exp(-std::numbers::pi * 0.1 / root),
               delay = 1 / (2 * 20 * root);
  for (std::size_t k = 0; k < samples; ++k)
    y[k] = (input(0)[k] + k1 * past(input(0), static_cast<double>(k) * row - delay)) / (1 + k1);
}

}  // namespace

std::vector<Case> more_cases() {
  std::vector<Case> all;
  all.push_back(
      {"dead_zone", node("dead_zone", {{"lower", -0.3}, {"upper", 0.4}}), {""}, "", of_inputs<1>([](const auto& u) {
         return u[0] - std::max(-0.3, std::min(0.4, u[0]));
       })});
  all.push_back({"wrap", node("wrap", {{"period", 0.5}, {"lower", -0.25}}), {""}, "", of_inputs<1>([](const auto& u) {
                   return u[0] - 0.5 * std::floor((u[0] + 0.25) / 0.5);
                 })});
  all.push_back({"sign", node("sign", {}), {""}, "", of_inputs<1>([](const auto& u) {
                   return u[0] > 0 ? 1.0 : u[0] < 0 ? -1.0 : 0.0;
                 })});
  all.push_back({"switch", node("switch", {}), {"", "", ""}, "", of_inputs<3>([](const auto& u) {
                   return u[1] > 0 ? u[0] : u[2];
                 })});
  all.push_back(
      {"manual_switch", node("manual_switch", {}), {"", ""}, "", of_inputs<2>([](const auto& u) { return u[0]; })});
  all.push_back(
      {"variable_dead_time", node("variable_dead_time", {{"longest", "0.5 s"}}), {"", "s"}, "", delayed_rows, true});
  all.push_back(
      {"input_shaper", node("input_shaper", {{"frequency", "20 Hz"}, {"damping", 0.1}}), {""}, "", shaped_rows, true});
  all.push_back({"h_bridge_with_dead_time",
                 node("h_bridge_with_dead_time", {{"supply", "24 V"}, {"resistance", "0.1 ohm"}, {"loss", "1 V"}}),
                 {"", "A"},
                 "",
                 of_inputs<2>([](const auto& u) {
                   const double way = u[1] > 0 ? 1 : u[1] < 0 ? -1 : 0;
                   return 24 * u[0] - 0.1 * u[1] - way;
                 })});
  all.push_back({"logic (and)", node("logic", {}), {"", ""}, "", of_inputs<2>([](const auto& u) {
                   return u[0] > 0.5 && u[1] > 0.5 ? 1.0 : 0.0;
                 })});
  all.push_back({"belt",
                 node("belt", {{"radius", "20 mm"}, {"stiffness", "5 N/mm"}, {"damping", "20 N*s/m"}, {"gap", "2 mm"}}),
                 {"rad", "rad/s", "m", "m/s"},
                 ".force",
                 of_inputs<4>([](const auto& u) { return contact_force(u, lever); })});
  all.push_back({"ball_screw",
                 node("ball_screw", {{"pitch", "20 mm"},
                                     {"stiffness", "5 N/mm"},
                                     {"damping", "20 N*s/m"},
                                     {"gap", "2 mm"},
                                     {"efficiency", 0.9}}),
                 {"rad", "rad/s", "m", "m/s"},
                 ".torque",
                 of_inputs<4>([](const auto& u) {
                   const double through = contact_force(u, 0.02 / tau) * 0.02 / tau;
                   return through * 0.5 * (1 / 0.9 + 0.9) +
                          std::abs(through) * 0.5 * (1 / 0.9 - 0.9) * std::tanh(u[1] / 0.01);
                 })});
  all.push_back(
      {"encoder", node("encoder", {{"lines", 500.0}, {"divisions", 4.0}}), {"rad"}, "", of_inputs<1>([](const auto& u) {
         const double q = tau / 2000;
         return q * std::round(u[0] / q);
       })});
  all.push_back({"comparator",
                 node("comparator", {{"level", 0.2}, {"above", 1.0}, {"below", -1.0}}),
                 {""},
                 "",
                 of_inputs<1>([](const auto& u) { return u[0] > 0.2 ? 1.0 : -1.0; })});
  all.push_back(
      {"stepper_motor",
       node("stepper_motor", {{"resistance", "2 ohm"}, {"inductance", "10 mH"}, {"torque_constant", "0.1 N*m/A"}}),
       {"V", "V", "rad", "rad/s"},
       ".torque",
       stepper_rows});
  {
    const double p = 1 / 5e-3;
    const Recursion<1> law(Eigen::Matrix<double, 1, 1>(-p), Eigen::Matrix<double, 1, 1>(p),
                           Eigen::Matrix<double, 1, 1>(-p), p);
    all.push_back({"filtered_derivative", node("filtered_derivative", {{"time", "5 ms"}}), {""}, "", [law](auto& y) {
                     law(input(0), y);
                   }});
  }
  {
    Eigen::Matrix2d a;
    a << -100, 0, 400, -400;
    const Recursion<2> law(a, Eigen::Vector2d(100, 0), Eigen::RowVector2d(0, 1), 0);
    all.push_back({"zero_pole_gain, two poles",
                   node("zero_pole_gain", {{"poles", numbers({-100, -400})}, {"gain", 40000.0}}),
                   {""},
                   "",
                   [law](auto& y) { law(input(0), y); }});
  }
  all.push_back({"winding", winding("winding"), {"V", "V"}, "", [](auto& y) { winding_rows(y, 1); }});
  Node of_motor = winding("dc_winding");
  of_motor.parameters["torque_constant"] = Value("0.1 N*m/A");
  all.push_back({"dc_winding", of_motor, {"V", "rad/s"}, ".current", [](auto& y) { winding_rows(y, constant); }});
  all.push_back({"discrete_state_space (2)",
                 node("discrete_state_space", {{"a", matrix({{0.8, 0.3}, {-0.3, 0.8}})},
                                               {"b", matrix({{0}, {0.2}})},
                                               {"c", matrix({{1, 0.5}})},
                                               {"d", matrix({{0.1}})},
                                               {"period", "0.1 ms"}}),
                 {""},
                 "",
                 discrete_rows});
  return all;
}

}  // namespace hysteron::benchmarks
