// Decides a DC motor as users draw it, from gains and integrators, and what it does with dry friction, by a formula of
// its own.
#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "engine/diagram/diagram.h"

namespace hysteron::testing {

/// u [V] -> w [rad/s]: 0.05 N m/A over 2 ohm (no inductance), 2e-5 kg m^2, 3e-4 N m s/rad.
inline Diagram motor() {
  Diagram d;
  d.title = "motor";
  d.inputs["u"].unit = "V";
  const auto block = [&](const char* name, const char* type, std::vector<std::string> in, const char* gain) {
    Node& node = d.blocks[name];
    node.type = type;
    for (auto& from : in) node.in.push_back({"", std::move(from)});
    if (*gain != 0) node.parameters[std::string(type) == "sum" ? "signs" : "gain"] = Value(gain);
  };
  block("drive", "sum", {"u", "back_emf"}, "+-");
  block("torque", "gain", {"drive"}, "25 mN m/V");
  block("net", "sum", {"torque", "bearing"}, "+-");
  block("acceleration", "gain", {"net"}, "5e4 rad/s^2/(N m)");
  block("speed", "integrator", {"acceleration"}, "");
  block("bearing", "gain", {"speed"}, "0.3 mN m s/rad");
  block("back_emf", "gain", {"speed"}, "0.05 V s/rad");
  d.outputs["w"] = "speed";
  return d;
}

/// Its speed [rad/s] at each t, with Coulomb friction of `dry` [N m] in the bearing that truly holds it at rest: by the
/// rule of Heun in 100 steps to a row, a step over the turn of the speed ending at rest.
inline std::vector<double> motor_speed(const std::vector<double>& t, const std::vector<double>& u, double dry) {
  const auto pull = [](double volts, double w) { return 0.025 * (volts - 0.05 * w) - 3e-4 * w; };  // [N m]
  std::vector<double> list;
  double w = 0;
  constexpr int steps = 100;
  for (std::size_t k = 0; k < t.size(); ++k) {
    list.push_back(w);
    if (k + 1 == t.size()) break;
    const double h = (t[k + 1] - t[k]) / steps;
    for (int i = 0; i < steps; ++i) {
      const auto volts = [&](int at) { return u[k] + (u[k + 1] - u[k]) * at / steps; };
      const double free = pull(volts(i), w);
      if (w == 0 && std::abs(free) <= dry) continue;
      const double side = w != 0 ? std::copysign(1.0, w) : std::copysign(1.0, free);
      const double a = 5e4 * (free - dry * side);
      const double b = 5e4 * (pull(volts(i + 1), w + h * a) - dry * side);
      const double next = w + h / 2 * (a + b);
      w = next * side < 0 ? 0 : next;
    }
  }
  return list;
}

}  // namespace hysteron::testing
