// The generator: machines in units of their own, with what drives them and what they drive; drawn for seeds of their
// own.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/reference/generator.h"

namespace reference {

Wire Generator::in_unit(const Wire& u, double most, const std::string& unit) {
  return put({{"type", "gain"}, {"gain", with_unit(most / u.size, unit)}}, {u}, most, u.smooth);
}

Wire Generator::told(const Wire& w, double size, const std::string& per_unit) {
  return add({{"type", "gain"}, {"gain", with_unit(size / w.size, per_unit)}}, {w}, 2 * size, w.smooth);
}

Wire Generator::machine(const Json& block, const std::vector<Wire>& in, double size, const std::string& port) {
  const Wire made = put(block, in, size, true, port);
  dimensioned.insert(made.name.substr(0, made.name.find('.')));
  return made;
}

Wire Generator::grow_machine(const Wire& u) {
  static const std::vector<Maker> makers = {
      &Generator::function, &Generator::function, &Generator::triggered, &Generator::triggered,
      &Generator::linear,   &Generator::stopped,  &Generator::coil,      &Generator::bridge,
      &Generator::phases,   &Generator::battery,  &Generator::propeller, &Generator::arm,
      &Generator::rotor,    &Generator::moved,    &Generator::counted,   &Generator::tracking};
  return (this->*random.one_of(makers))(u);
}

/// A coil whose motion, or what it induces, is another signal.
Wire Generator::coil(const Wire& u) {
  const Wire moves = any();
  const double volts = random.spread(2, 20), ohm = random.spread(0.5, 5), k = random.spread(0.05, 1);
  const Wire voltage = in_unit(u, volts, "V");
  Json block = {{"type", "winding"}, {"resistance", with_unit(ohm, "ohm")}};
  block["inductance"] = with_unit(ohm * random.spread(2e-3, 0.1), "H");
  const double current = volts / ohm;
  switch (random.below(3)) {
    case 0:
      if (random.chance(0.4)) block["initial"] = with_unit(around(current), "A");
      return told(machine(block, {voltage, in_unit(moves, 0.5 * volts, "V")}, current, ""), u.size, "1/A");
    case 1:
      block["type"] = "voice_coil";
      block["force_constant"] = with_unit(k, "N/A");
      return told(machine(block, {voltage, in_unit(moves, 0.5 * volts / k, "m/s")}, k * current, "force"), u.size,
                  "1/N");
    default:
      block["type"] = "dc_winding";
      block["torque_constant"] = with_unit(k, "N*m/A");
      if (random.chance(0.5)) block["back_emf"] = with_unit(k * random.between(0.8, 1.2), "V*s/rad");
      return told(machine(block, {voltage, in_unit(moves, 0.5 * volts / k, "rad/s")}, current, "current"), u.size,
                  "1/A");
  }
}

/// Pulses or their mean on a bridge, and a motor whose current comes back to it.
Wire Generator::bridge(const Wire& u) {
  Wire gate = put({{"type", "gain"}, {"gain", random.between(0.5, 1.2) / u.size}}, {u}, 1, u.smooth);
  const auto modulation = random.one_of<std::string>({"bipolar", "unipolar", "single"});
  const double least = modulation == "single" ? 0.05 : -0.95;
  gate = put({{"type", "saturation"}, {"lower", least}, {"upper", 0.95}}, {gate}, 1, u.smooth);
  if (random.chance(0.5)) {
    Json pulses = {{"type", "pwm"}, {"frequency", with_unit(random.spread(3, 25), "Hz")}, {"modulation", modulation}};
    gate = put(pulses, {gate}, 1, false);
  }
  const double supply = random.spread(3, 24), ohm = random.spread(0.5, 5), kt = random.spread(0.02, 0.3);
  Json legs = {{"type", "h_bridge"}, {"supply", with_unit(supply, "V")}};
  legs["resistance"] = with_unit(random.between(0, 0.3) * ohm, "ohm");
  if (random.chance(0.3)) {  // of a current that is given
    legs["type"] = "h_bridge_with_dead_time";
    legs["loss"] = with_unit(random.between(0, 0.2) * supply, "V");
    const Wire voltage = machine(legs, {gate, in_unit(any(), supply / ohm, "A")}, supply, "");
    return told({voltage.name, supply, false}, u.size, "1/V");
  }
  const std::string motor = fresh();
  blocks[motor] = Json::object();  // its place in the file; the wires are known later
  const Wire voltage = machine(legs, {gate, {motor + ".current"}}, supply, "");
  const Wire held = put({{"type", "constant"}, {"value", "0 N*m"}}, {}, 1, true);
  Json block = {{"type", "dc_motor"}, {"resistance", with_unit(ohm, "ohm")}};
  block["inductance"] = with_unit(ohm * random.spread(5e-3, 0.1), "H");
  block["torque_constant"] = with_unit(kt, "N*m/A");
  const double inertia = kt * kt / ohm * random.spread(0.05, 0.5), stall = kt * supply / ohm;
  block["inertia"] = with_unit(inertia, "kg*m^2");
  if (random.chance(0.4)) {
    const double slip = random.between(0.05, 0.5);
    block["type"] = "dc_motor_with_presliding";
    block["contact_stiffness"] = {with_unit(random.between(0.05, 0.4) * stall / slip, "N*m/rad")};
    block["slip_distance"] = {with_unit(slip, "rad")};
  }
  block["in"] = {voltage.name, held.name};
  blocks[motor] = block;
  dimensioned.insert(motor);
  return told({motor + ".velocity", supply / kt, true}, u.size, "s/rad");
}

/// Currents of two windings; their torque turns an inertia that comes back to them.
Wire Generator::phases(const Wire& u) {
  const bool steps = random.chance(0.5);
  const double volts = random.spread(2, 20), ohm = random.spread(0.5, 5), k = random.spread(0.05, 0.3);
  const double current = volts / ohm, periods = 1 + random.below(5);
  const std::string rotor = fresh();
  blocks[rotor] = Json::object();
  Json block = {{"type", steps ? "stepper_motor" : "synchronous_motor"}, {"resistance", with_unit(ohm, "ohm")}};
  std::vector<Wire> in{in_unit(u, volts, "V"), in_unit(any(), volts, "V")};
  if (steps) {
    block["inductance"] = with_unit(ohm * random.spread(5e-3, 0.05), "H");
    block["torque_constant"] = with_unit(k, "N*m/A");
    block["teeth"] = periods;
    if (random.chance(0.5)) block["detent"] = with_unit(random.between(0, 0.3) * k * current, "N*m");
    in.push_back({rotor + ".angle"});
  } else {
    block["inductance_d"] = with_unit(ohm * random.spread(5e-3, 0.05), "H");
    block["inductance_q"] = with_unit(ohm * random.spread(5e-3, 0.05), "H");
    block["flux"] = with_unit(k, "V*s");
    block["pole_pairs"] = periods;
  }
  in.push_back({rotor + ".velocity"});
  const Wire torque = machine(block, in, k * current * (steps ? 1 : periods), "torque");
  const double kgm2 = k * k / ohm * random.spread(0.1, 1);
  blocks[rotor] = {{"type", "inertia"}, {"inertia", with_unit(kgm2, "kg*m^2")}, {"in", torque.name}};
  blocks[rotor]["damping"] = with_unit(k * k / ohm * random.between(0.2, 1), "N*m*s/rad");
  dimensioned.insert(rotor);
  return told({rotor + ".velocity", volts / k, true}, u.size, "s/rad");
}

Wire Generator::battery(const Wire& u) {
  const double ampere = random.spread(0.5, 5);
  Json block = {{"type", "battery_cell"}, {"capacity", with_unit(ampere * random.spread(2, 20), "C")}};
  block["resistance"] = with_unit(random.between(0, 0.2), "ohm");
  block["charges"] = {0, random.between(0.2, 0.45), random.between(0.5, 0.8), 1};
  block["open_circuit"] = {with_unit(3, "V"), with_unit(3.5, "V"), with_unit(3.7, "V"), with_unit(4.2, "V")};
  block["resistances"] = {with_unit(random.between(0, 0.3), "ohm")};
  block["times"] = {with_unit(random.spread(0.05, 2), "s")};
  block["initial"] = random.between(0.3, 0.9);
  return told(machine(block, {in_unit(u, ampere, "A")}, 4, "voltage"), 1, "1/V");
}

Wire Generator::propeller(const Wire& u) {
  const double w = random.spread(10, 200), newton = random.spread(0.5, 5);
  Json block = {{"type", "propeller"}, {"thrust_coefficient", with_unit(newton / w / w, "N*s^2/rad^2")}};
  block["time"] = with_unit(random.spread(0.02, 0.3), "s");
  return told(machine(block, {in_unit(u, w, "rad/s")}, newton, "thrust"), u.size, "1/N");
}

Wire Generator::arm(const Wire& u) {
  const double kg = random.spread(0.2, 3), length = random.spread(0.2, 1), weight = kg * 9.80665 * length;
  const double w = std::sqrt(9.80665 / length), kgm2 = kg * length * length;
  Json block = {{"type", "pendulum"}, {"mass", with_unit(kg, "kg")}, {"length", with_unit(length, "m")}};
  block["damping"] = with_unit(random.between(0.1, 1) * kgm2 * w, "N*m*s/rad");
  if (random.chance(0.3)) block["initial_angle"] = with_unit(around(1), "rad");
  if (random.chance(0.4)) {
    const double slip = random.between(0.02, 0.2);
    block["type"] = "pendulum_with_presliding";
    block["contact_stiffness"] = {with_unit(random.between(0.05, 0.3) * weight / slip, "N*m/rad")};
    block["slip_distance"] = {with_unit(slip, "rad")};
    if (random.chance(0.4)) block["excess"] = random.between(0, 0.5);
  }
  return told(machine(block, {in_unit(u, random.between(0.2, 0.7) * weight, "N*m")}, 1, "angle"), u.size, "1/rad");
}

/// An inertia that air, magnets or bearings hold back.
Wire Generator::rotor(const Wire& u) {
  const double torque = random.spread(0.1, 2), kgm2 = random.spread(0.01, 0.2), w = random.spread(3, 30);
  const double stiffness = kgm2 * w * w, travel = torque / stiffness;
  Json block = {{"type", "inertia_with_drag"}, {"inertia", with_unit(kgm2, "kg*m^2")}};
  block["stiffness"] = with_unit(stiffness, "N*m/rad");
  block["damping"] = with_unit(random.between(0.05, 0.6) * kgm2 * w, "N*m*s/rad");
  switch (random.below(3)) {
    case 0:
      block["drag"] = with_unit(random.between(0.1, 2) * kgm2 / travel, "N*m*s^2/rad^2");
      break;
    case 1:
      block["type"] = "inertia_with_cogging";
      block["periods"] = 1 + random.below(12);
      block["cosine"] = with_unit(random.between(0, 0.3) * torque, "N*m");
      block["sine"] = with_unit(random.between(-0.3, 0.3) * torque, "N*m");
      break;
    default:
      block["type"] = "inertia_with_presliding";
      block["contact_stiffness"] = {with_unit(random.between(0.1, 0.6) * stiffness, "N*m/rad")};
      block["slip_distance"] = {with_unit(random.between(0.1, 0.5) * travel, "rad")};
  }
  return told(machine(block, {in_unit(u, torque, "N*m")}, travel, "angle"), u.size, "1/rad");
}

/// A pulley or a screw, whose angle is given, and what it moves.
Wire Generator::moved(const Wire& u) {
  const double kg = random.spread(0.5, 5), w = random.spread(10, 60), way = random.spread(0.01, 0.1);
  const double turn = random.spread(1, 10), lever = way / turn;
  const std::string table = fresh();
  blocks[table] = Json::object();
  const Wire slow = put({{"type", "lag"}, {"times", {with_unit(random.spread(50, 300), "ms")}}}, {u}, u.size, true);
  const Wire angle = in_unit(slow, turn, "rad");
  const Wire rate = put({{"type", "filtered_derivative"}, {"time", "20 ms"}}, {angle}, 10 * turn, true);
  dimensioned.insert(rate.name);
  Json block = {{"type", "belt"}, {"radius", with_unit(lever, "m")}};
  if (random.chance(0.5)) {
    block = {{"type", "ball_screw"}, {"pitch", with_unit(lever * 2 * std::numbers::pi, "m")}};
    if (random.chance(0.5)) block["pitch_error"] = random.between(-0.02, 0.02);
    if (random.chance(0.5)) block["wobble"] = with_unit(random.between(0, 0.02) * way, "m");
    if (random.chance(0.5)) block["wobble_phase"] = with_unit(random.between(-180, 180), "deg");
  }
  block["stiffness"] = with_unit(kg * w * w, "N/m");
  block["damping"] = with_unit(random.between(0.1, 0.6) * kg * w, "N*s/m");
  if (random.chance(0.5)) block["gap"] = with_unit(random.between(0.02, 0.2) * way, "m");
  if (random.chance(0.5)) block["efficiency"] = random.between(0.7, 1);
  const Wire force =
      machine(block, {angle, rate, {table + ".position"}, {table + ".velocity"}}, kg * w * w * way, "force");
  blocks[table] = {{"type", "mass_spring_damper"}, {"mass", with_unit(kg, "kg")}, {"in", force.name}};
  blocks[table]["damping"] = with_unit(random.between(0.2, 1) * kg * w, "N*s/m");
  blocks[table]["stiffness"] = "0 N/m";
  dimensioned.insert(table);
  return told({table + ".position", way, true}, u.size, "1/m");
}

/// An encoder, of some ten counts.
Wire Generator::counted(const Wire& u) {
  const double error = random.chance(0.5) ? random.between(0, 0.1) : 0;
  if (random.chance(0.5)) {
    const double lines = 1 + random.below(8), pitch = 2 * std::numbers::pi / lines;
    Json block = {{"type", "encoder"}, {"lines", lines}, {"error_sine", with_unit(error * pitch, "rad")}};
    const Wire told_angle = machine(block, {in_unit(u, random.between(1, 4), "rad")}, 4, "");
    return told({told_angle.name, 4, false}, u.size, "1/rad");
  }
  const double pitch = random.spread(0.01, 0.05);
  Json block = {{"type", "linear_encoder"}, {"pitch", with_unit(pitch, "m")}};
  block["error_cosine"] = with_unit(error * pitch, "m");
  const Wire place = machine(block, {in_unit(u, random.between(1, 4) * pitch, "m")}, 4 * pitch, "");
  return told({place.name, 4 * pitch, false}, u.size, "1/m");
}

/// A controller whose integral follows another signal.
Wire Generator::tracking(const Wire& u) {
  const Wire measured = any(), follows = any();
  const bool is_sampled = random.chance(0.5);
  const double size = std::max(u.size, measured.size);
  Json block = {{"type", is_sampled ? "discrete_pid_tracking" : "pid_tracking"}, {"kp", random.between(0.2, 1.5)}};
  block["ki"] = with_unit(random.spread(0.5, 5), "1/s");
  if (random.chance(0.5)) block["kd"] = with_unit(random.spread(0.01, 0.1), "s");
  block["filter"] = with_unit(random.spread(0.02, 0.1), "s");
  block["tracking_time"] = with_unit(random.spread(0.1, 1), "s");
  block["lower"] = -random.between(0.5, 2) * size;
  block["upper"] = random.between(0.5, 2) * size;
  return add(is_sampled ? sampled(block) : block, {u, measured, follows}, 3 * size, false);
}

}  // namespace reference
