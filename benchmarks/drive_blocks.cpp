// What drives are made of, one block at a time as in single_blocks.cpp: controllers, an inertia with and without dry
// friction, a motor, a gear, moves within limits, states and conditions.
#include <algorithm>
#include <array>
#include <cmath>

#include "benchmarks/single_blocks.h"

namespace hysteron::benchmarks {
namespace {

constexpr double kp = 2, ki = 30, kd = 0.01, filter = 2e-3, limit = 1.2;
constexpr double follows = kp / ki;  // [s] the integral its limited command

Node controller(const char* type) {
  return node(type, {{"kp", kp},
                     {"ki", "30 1/s"},
                     {"kd", "10 ms"},
                     {"filter", "2 ms"},
                     {"derivative_on", "error"},
                     {"lower", -limit},
                     {"upper", limit}});
}

void pid_rows(std::vector<double>& y) {
  const auto command = [](const auto& x, const auto& u) {
    const double e = u[0] - u[1];
    return kp * e + x[0] + kd * (e - x[1]) / filter;
  };
  runge_kutta_rows<2, 2>(
      {0, 0}, y,
      [&](const auto& x, const auto& u) {
        const double e = u[0] - u[1], wanted = command(x, u);
        return std::array<double, 2>{ki * e + (std::clamp(wanted, -limit, limit) - wanted) / follows,
                                     (e - x[1]) / filter};
      },
      [&](const auto& x, const auto& u) { return std::clamp(command(x, u), -limit, limit); });
}

void discrete_pid_rows(std::vector<double>& y) {
  const auto &r = input(0), &m = input(1);
  double integral = 0, rate = 0, last = r[0] - m[0];
  for (std::size_t k = 0; k < samples; ++k) {
    const double e = r[k] - m[k];
    rate = (filter * rate + e - last) / (filter + row);
    last = e;
    const double wanted = kp * e + integral + kd * rate;
    y[k] = std::clamp(wanted, -limit, limit);
    integral += ki * row * e + row / follows * (y[k] - wanted);
  }
}

constexpr double inertia = 0.02, damping = 0.1;

/// Dry friction that sticks. Between the rows the torque is its mean, and what begins or ends to stick does so in a
/// row.
void friction_rows(std::vector<double>& y) {
  constexpr double coulomb = 0.3;
  const auto& torque = input(0);
  const double decay = std::exp(-row * damping / inertia), gain = (1 - decay) / damping;
  double w = 0;
  for (std::size_t k = 0; k < samples; ++k) {
    if (k > 0) {
      const double mean = 0.5 * (torque[k - 1] + torque[k]);
      const double way = w != 0 ? std::copysign(1.0, w) : std::abs(mean) > coulomb ? std::copysign(1.0, mean) : 0;
      if (way != 0) w = decay * w + gain * (mean - way * coulomb);
      if (w * way < 0) w = 0;
    }
    y[k] = w;
  }
}

/// x' = A x + b u + c v, exact for straight inputs; the velocity.
void motor_rows(std::vector<double>& y) {
  Eigen::Matrix2d a;
  a << -1, 1e3, -10, -200;  // of velocity and current; nothing hangs on the angle
  const Eigen::RowVector2d out(1, 0);
  const Recursion<2> of_voltage(a, Eigen::Vector2d(0, 100), out, 0), of_load(a, Eigen::Vector2d(-1e4, 0), out, 0);
  const auto &u = input(0), &v = input(1);
  std::array<double, 2> x{};
  for (std::size_t k = 0; k < samples; ++k) {
    if (k > 0) {
      const double du = u[k] - u[k - 1], dv = v[k] - v[k - 1];
      std::array<double, 2> next{};
      for (std::size_t i = 0; i < 2; ++i)
        next[i] = of_voltage.a[0][i] * x[0] + of_voltage.a[1][i] * x[1] + of_voltage.b[i] * u[k - 1] +
                  of_voltage.ramp[i] * du + of_load.b[i] * v[k - 1] + of_load.ramp[i] * dv;
      x = next;
    }
    y[k] = x[0];
  }
}

void gear_rows(std::vector<double>& y) {
  const double ratio = 3, stiffness = 200, damped = 0.5, half = 0.05, efficiency = 0.9;
  const double mean = 0.5 * (1 / efficiency + efficiency), loss = 0.5 * (1 / efficiency - efficiency);
  const auto &in = input(0), &w_in = input(1), &out = input(2), &w_out = input(3);
  for (std::size_t k = 0; k < samples; ++k) {
    const double twist = in[k] / ratio - out[k], rate = damped * (w_in[k] / ratio - w_out[k]);
    double load = 0;
    if (twist > half) load = std::max(0.0, stiffness * (twist - half) + rate);
    if (twist < -half) load = std::min(0.0, stiffness * (twist + half) + rate);
    const double through = load / ratio;
    y[k] = through * mean + std::abs(through) * loss * std::tanh(w_in[k] / 0.01);
  }
}

/// Two moves of 1 that reach velocity 0.5, acceleration 5 and jerk 200, each piece counted from its begin.
void profile_rows(std::vector<double>& y) {
  const double v = 0.5, a = 5, j = 200, dwell = 1;
  const double tj = a / j, te = v / a - tj, tc = 1 / v - v / a - tj;
  const std::array<double, 8> length{tj, te, tj, tc, tj, te, tj, dwell};
  const std::array<double, 8> jerk{j, 0, -j, 0, -j, 0, j, 0};
  double begin = 0, x = 0, w = 0, b = 0, sign = 1;
  std::size_t piece = 0, moves = 0;
  for (std::size_t k = 0; k < samples; ++k) {
    const double t = static_cast<double>(k) * row;
    while (moves < 2 && t >= begin + length[piece]) {
      const double h = length[piece], q = sign * jerk[piece];
      x += h * (w + h * (b / 2 + h * q / 6));
      w += h * (b + h * q / 2);
      b += h * q;
      begin += h;
      if (++piece == 8) {
        piece = 0;
        ++moves;
        sign = -sign;
        x = moves == 1 ? 1 : 0;
        w = b = 0;
      }
    }
    const double h = t - begin, q = moves < 2 ? sign * jerk[piece] : 0;
    y[k] = x + h * (w + h * (b / 2 + h * q / 6));
  }
}

void machine_rows(std::vector<double>& y) {
  const auto& u = input(0);
  int state = 0;
  double since = 0;
  for (std::size_t k = 0; k < samples; ++k) {
    const double t = static_cast<double>(k) * row;
    const int before = state;
    if (state == 0 && u[k] > 0.3)
      state = 1;
    else if (state == 1 && u[k] < -0.3 && t - since > 0.01)
      state = 2;
    else if (state == 2 && u[k] > 0)
      state = 0;
    if (state != before) since = t;
    y[k] = state;
  }
}

}  // namespace

std::vector<Case> drive_cases() {
  std::vector<Case> all;
  all.push_back({"pid", controller("pid"), {"", ""}, "", pid_rows});
  Node sampled = controller("discrete_pid");
  sampled.parameters["period"] = Value{"0.1 ms"};
  all.push_back({"discrete_pid", sampled, {"", ""}, "", discrete_pid_rows});
  const Recursion<1> free(Eigen::Matrix<double, 1, 1>(-damping / inertia), Eigen::Matrix<double, 1, 1>(1 / inertia),
                          Eigen::Matrix<double, 1, 1>(1.0), 0);
  all.push_back({"inertia",
                 node("inertia", {{"inertia", "0.02 kg*m^2"}, {"damping", "0.1 N*m*s/rad"}}),
                 {"N*m"},
                 ".velocity",
                 [free](auto& y) { free(input(0), y); }});
  all.push_back({"inertia_with_friction",
                 node("inertia_with_friction", {{"inertia", "0.02 kg*m^2"},
                                                {"damping", "0.1 N*m*s/rad"},
                                                {"coulomb", "0.3 N*m"},
                                                {"breakaway", "0.3 N*m"}}),
                 {"N*m"},
                 ".velocity",
                 friction_rows,
                 true});
  all.push_back({"dc_motor",
                 node("dc_motor", {{"resistance", "2 ohm"},
                                   {"inductance", "10 mH"},
                                   {"torque_constant", "0.1 N*m/A"},
                                   {"inertia", "1e-4 kg*m^2"},
                                   {"damping", "1e-4 N*m*s/rad"}}),
                 {"V", "N*m"},
                 ".velocity",
                 motor_rows});
  all.push_back({"gear",
                 node("gear", {{"ratio", 3.0},
                               {"stiffness", "200 N*m/rad"},
                               {"damping", "0.5 N*m*s/rad"},
                               {"gap", "0.1 rad"},
                               {"efficiency", 0.9}}),
                 {"rad", "rad/s", "rad", "rad/s"},
                 ".torque_in",
                 gear_rows});
  all.push_back({"motion_profile",
                 node("motion_profile", {{"positions", numbers({1, 0})},
                                         {"velocity", "0.5 1/s"},
                                         {"acceleration", "5 1/s^2"},
                                         {"jerk", "200 1/s^3"},
                                         {"dwell", "1 s"}}),
                 {},
                 ".position",
                 profile_rows,
                 true});
  all.push_back({"state_machine",
                 node("state_machine", {{"states", "low, high, late"},
                                        {"transitions",
                                         "low -> high: u > 0.3; high -> late: u < -0.3 and time > t0; late -> low: "
                                         "u > 0"},
                                        {"t0", "10 ms"}}),
                 {""},
                 ".state",
                 machine_rows,
                 true});
  return all;
}

}  // namespace hysteron::benchmarks
