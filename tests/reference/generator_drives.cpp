// The generator: what drives are made of, drawn for seeds of their own.
#include <algorithm>
#include <cmath>

#include "tests/reference/generator.h"

namespace reference {

Wire Generator::grow_drive(const Wire& u) {
  static const std::vector<Maker> makers = {&Generator::controller, &Generator::controller, &Generator::inertia,
                                            &Generator::motor, &Generator::geared};
  return (this->*random.one_of(makers))(u);
}

/// `pid` or `discrete_pid`, of two signals, in any form.
Wire Generator::controller(const Wire& u) {
  const Wire measured = any();
  const bool is_sampled = random.chance(0.5);
  const double size = std::max(u.size, measured.size), kp = random.between(0.2, 1.5);
  Json block = {{"type", is_sampled ? "discrete_pid" : "pid"}, {"kp", kp}};
  const auto form = random.one_of<std::string>({"parallel", "standard", "series"});
  const double ti = random.spread(0.1, 2), td = random.chance(0.6) ? random.spread(0.02, 0.2) : 0;
  if (form == "parallel") {
    block["ki"] = with_unit(kp / ti, "1/s");
    if (td > 0) block["kd"] = with_unit(kp * td, "s");
  } else {
    block["form"] = form;
    block["integral_time"] = with_unit(ti, "s");
    if (td > 0) block["derivative_time"] = with_unit(td, "s");
  }
  if (random.chance(0.5)) block["filter"] = with_unit(random.spread(0.01, 0.1), "s");
  if (random.chance(0.5)) block["derivative_on"] = "error";
  if (random.chance(0.4)) block["setpoint_weight"] = random.between(0, 1);
  const auto windup = random.one_of<std::string>({"back_calculation", "clamping", "none"});
  const double limit = random.between(0.5, 2) * size;
  const bool both = windup == "clamping";  // the continuous one needs them
  if (both || random.chance(0.7)) block["lower"] = -limit;
  if (both || random.chance(0.7)) block["upper"] = random.between(0.5, 1) * limit;
  block["anti_windup"] = windup;
  if (random.chance(0.3)) block["tracking_time"] = with_unit(random.spread(0.05, 1), "s");
  if (random.chance(0.3)) block["initial"] = around(0.5 * limit);
  const bool rate = random.chance(0.3);
  if (rate) block["rate"] = with_unit(random.spread(2, 20) * size, "1/s");
  if (is_sampled) {
    block["rule"] = random.one_of<std::string>({"forward", "backward", "trapezoidal"});
    return add(sampled(block), {u, measured}, 3 * size, false);
  }
  if (rate) {
    block["output_rate"] = "limited";
    block["follow_time"] = with_unit(random.spread(2, 20), "ms");
  }
  return add(block, {u, measured}, 3 * size, rate || (u.smooth && measured.smooth));
}

/// A torque turns it; of its motion a number remains.
Wire Generator::inertia(const Wire& u) {
  const double torque = random.spread(0.1, 2), kgm2 = random.spread(0.01, 0.2), w = random.spread(3, 40);
  const double stiffness = kgm2 * w * w, travel = torque * u.size / stiffness;
  const Wire twist = put({{"type", "gain"}, {"gain", with_unit(torque, "N*m")}}, {u}, torque * u.size, u.smooth);
  Json block = {{"type", "inertia"}, {"inertia", with_unit(kgm2, "kg*m^2")}};
  block["damping"] = with_unit(random.between(0.05, 0.6) * kgm2 * w, "N*m*s/rad");
  block["stiffness"] = with_unit(stiffness, "N*m/rad");
  if (random.chance(0.5)) {
    const double coulomb = random.between(0.05, 0.7) * torque * u.size;
    block["type"] = "inertia_with_friction";
    block["coulomb"] = with_unit(coulomb, "N*m");
    block["breakaway"] = with_unit(coulomb * random.between(1, 1.5), "N*m");
    if (random.chance(0.5)) block["stribeck_velocity"] = with_unit(random.between(0.1, 1) * travel * w, "rad/s");
  } else if (random.chance(0.5)) {
    block["initial_angle"] = with_unit(around(travel), "rad");
  }
  const Wire angle = put(block, {twist}, travel, true, "angle");
  return add({{"type", "gain"}, {"gain", with_unit(u.size / travel, "1/rad")}}, {angle}, 2 * u.size, true);
}

Wire Generator::motor(const Wire& u) {
  const Wire held = any();
  const double volts = random.spread(2, 20), kt = random.spread(0.02, 0.3), ohm = random.spread(0.5, 5);
  const Wire voltage = put({{"type", "gain"}, {"gain", with_unit(volts, "V")}}, {u}, volts * u.size, u.smooth);
  const double stall = kt * volts * u.size / ohm;
  const Wire load = put({{"type", "gain"}, {"gain", with_unit(random.between(0, 0.3) * stall / held.size, "N*m")}},
                        {held}, stall, held.smooth);
  Json block = {{"type", "dc_motor"}, {"resistance", with_unit(ohm, "ohm")}};
  block["inductance"] = with_unit(ohm * random.spread(2e-3, 0.1), "H");
  block["torque_constant"] = with_unit(kt, "N*m/A");
  if (random.chance(0.5)) block["back_emf"] = with_unit(kt * random.between(0.8, 1.2), "V*s/rad");
  block["inertia"] = with_unit(kt * kt / ohm * random.spread(0.02, 0.5), "kg*m^2");
  block["damping"] = with_unit(kt * kt / ohm * random.between(0, 0.5), "N*m*s/rad");
  if (random.chance(0.3)) block["initial_velocity"] = with_unit(around(volts * u.size / kt), "rad/s");
  const double speed = volts * u.size / kt, current = volts * u.size / ohm;
  const bool of_current = random.chance(0.4);
  const Wire turning =
      put(block, {voltage, load}, of_current ? current : speed, true, of_current ? "current" : "velocity");
  return add({{"type", "gain"},
              {"gain", of_current ? with_unit(u.size / current, "1/A") : with_unit(u.size / speed, "s/rad")}},
             {turning}, 2 * u.size, true);
}

/// Two inertias and a gear between them, whose torque comes back to the driver; a spring holds the driver.
Wire Generator::geared(const Wire& u) {
  const double torque = random.spread(0.1, 2), kgm2 = random.spread(0.01, 0.2), w = random.spread(3, 15);
  const double ratio = random.spread(0.5, 5), stiffness = kgm2 * w * w, travel = torque * u.size / stiffness;
  const Wire push = put({{"type", "gain"}, {"gain", with_unit(torque, "N*m")}}, {u}, torque * u.size, u.smooth);
  const std::string left = fresh(), load = fresh(), gear = fresh();
  blocks[left] = Json::object();  // their places in the file; the wires are known later
  blocks[load] = Json::object();
  Json driver = {{"type", "inertia"}, {"inertia", with_unit(kgm2, "kg*m^2")}};
  driver["damping"] = with_unit(random.between(0.1, 0.6) * kgm2 * w, "N*m*s/rad");
  driver["stiffness"] = with_unit(stiffness, "N*m/rad");
  const std::string shaft = put(driver, {Wire{left}}, travel, true).name;
  const double driven = kgm2 * ratio * ratio * random.spread(0.1, 1),
               contact = driven * std::pow(w * random.spread(1.5, 5), 2);
  blocks[left] = {{"type", "sum"}, {"signs", "+-"}, {"in", {push.name, gear + ".torque_in"}}};
  blocks[load] = {{"type", "inertia"}, {"in", gear + ".torque_out"}, {"inertia", with_unit(driven, "kg*m^2")}};
  blocks[load]["damping"] = with_unit(random.between(0.1, 1) * driven * w, "N*m*s/rad");
  Json block = {{"type", "gear"}, {"ratio", ratio}, {"stiffness", with_unit(contact, "N*m/rad")}};
  block["damping"] = with_unit(random.between(0.01, 0.2) * std::sqrt(contact * driven), "N*m*s/rad");
  if (random.chance(0.5)) block["gap"] = with_unit(random.between(0.05, 0.5) * travel / ratio, "rad");
  if (random.chance(0.5)) block["efficiency"] = random.between(0.7, 1);
  block["in"] = {shaft + ".angle", shaft + ".velocity", load + ".angle", load + ".velocity"};
  blocks[gear] = block;
  const Wire angle{load + ".angle", travel / ratio, true};
  return add({{"type", "gain"}, {"gain", with_unit(u.size * ratio / travel, "1/rad")}}, {angle}, 2 * u.size, true);
}

}  // namespace reference
