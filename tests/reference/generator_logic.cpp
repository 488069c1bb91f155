// The generator: what is true or false, what that triggers, and laws by name; drawn for seeds of their own.
#include <algorithm>
#include <cmath>

#include "tests/reference/generator.h"

namespace reference {

Wire Generator::function(const Wire& u) {
  switch (random.below(8)) {
    case 4:
    case 5:
      return plain(u);
    case 0: {
      const double a = random.between(0.1, 0.6) * u.size;
      return add({{"type", "dead_zone"}, {"lower", -a}, {"upper", random.between(0.5, 1.5) * a}}, {u}, u.size,
                 u.smooth);
    }
    case 1:
      return add({{"type", "wrap"}, {"period", random.between(0.5, 2) * u.size}, {"lower", around(u.size)}}, {u},
                 3 * u.size, false);
    case 2:
      return add({{"type", random.chance(0.5) ? "abs" : "sign"}}, {u}, std::max(u.size, 1.0), false);
    case 3: {  // over what is never zero
      const Wire v = any();
      const Wire size = put({{"type", "abs"}}, {v}, v.size, v.smooth);
      const Wire least = put({{"type", "constant"}, {"value", random.between(0.2, 1) * v.size}}, {}, v.size, true);
      const Wire below = put({{"type", "sum"}}, {size, least}, 2 * v.size, v.smooth);
      return add({{"type", "divide"}}, {u, below}, 5 * u.size / v.size, u.smooth && v.smooth);
    }
    default:
      return trigonometry(u);
  }
}

/// What hardly changes its signal.
Wire Generator::plain(const Wire& u) {
  const Wire v = any();
  switch (random.below(4)) {
    case 0:
      return add({{"type", "pass"}}, {u}, u.size, u.smooth);
    case 1:
      return add({{"type", "calibration"}, {"gain", random.between(0.8, 1.2)}, {"offset", around(0.2 * u.size)}}, {u},
                 1.5 * u.size, u.smooth);
    case 2:
      return add({{"type", "cross_coupling"}, {"coefficient", random.between(-0.2, 0.2)}}, {u, v}, u.size + v.size,
                 u.smooth && v.smooth);
    default:
      return add({{"type", "manual_switch"}, {"position", random.chance(0.5) ? "first" : "second"}}, {u, v},
                 u.size + v.size, u.smooth && v.smooth);
  }
}

Wire Generator::trigonometry(const Wire& u) {
  const auto name = random.one_of<std::string>({"sin", "cos", "atan", "sinh", "tanh", "atan2"});
  if (name != "atan" && name != "atan2") {
    const Wire small = put({{"type", "gain"}, {"gain", random.between(1, 3) / u.size}}, {u}, 3, u.smooth);
    return add({{"type", "trigonometry"}, {"function", name}}, {small}, name == "sinh" ? 5 : 1, u.smooth);
  }
  const Json block = {{"type", "trigonometry"}, {"function", name}};
  if (name == "atan") return told(put(block, {u}, 1.5, u.smooth), 1, "1/rad");
  const Wire v = any();  // not the same two: at the origin there is no direction
  const Wire beside = put({{"type", "constant"}, {"value", random.between(0.3, 1) * v.size}}, {}, v.size, true);
  const Wire off = put({{"type", "sum"}}, {v, beside}, 2 * v.size, v.smooth);
  return told(put(block, {u, off}, 3, false), 1, "1/rad");
}

/// True for part of the time.
Wire Generator::condition(const Wire& u) {
  if (random.chance(0.6)) {
    const Wire v = any();
    const auto is = random.one_of<std::string>({"less", "at_most", "at_least", "greater"});
    const Wire level =
        random.chance(0.5) ? v : put({{"type", "constant"}, {"value", around(0.7 * u.size)}}, {}, u.size, true);
    return put({{"type", "compare"}, {"is", is}}, {u, level}, 1, false);
  }
  const Wire a = put({{"type", "comparator"}, {"level", around(u.size)}, {"above", 1}, {"below", 0}}, {u}, 1, false);
  const auto is = random.one_of<std::string>({"and", "or", "nand", "nor", "xor", "not"});
  if (is == "not") return put({{"type", "logic"}, {"is", is}}, {a}, 1, false);
  const Wire v = any();
  const Wire b = put({{"type", "comparator"}, {"level", around(v.size)}, {"above", 0}, {"below", 1}}, {v}, 1, false);
  return put({{"type", "logic"}, {"is", is}}, {a, b}, 1, false);
}

Wire Generator::triggered(const Wire& u) {
  const auto edge = random.one_of<std::string>({"rising", "falling", "either"});
  const int kind = random.below(6);
  if (kind == 5) return two_states(u);
  const Wire when = condition(any());
  switch (kind) {
    case 0:
      return add({{"type", "sample_and_hold"}, {"edge", edge}, {"initial", around(u.size)}}, {u, when}, u.size, false);
    case 1: {
      const Wire reset =
          put({{"type", "comparator"}, {"level", 0.7 * u.size}, {"above", 1}, {"below", 0}}, {u}, 1, false);
      return add({{"type", "counter"}, {"edge", edge}, {"by", random.between(0.5, 2)}}, {when, reset}, 5, false);
    }
    case 2: {
      const Wire time = put({{"type", "timer"}}, {when}, 1, false);
      dimensioned.insert(time.name);
      return told(time, 1, "1/s");
    }
    case 3:
      return add(sampled({{"type", "edge"}, {"edge", edge}}), {when}, 1, false);
    default:
      return begun_anew(u, when);
  }
}

Wire Generator::two_states(const Wire& u) {
  Json block = {{"type", "state_machine"}, {"states", "low, high"}, {"outputs", "level"}};
  block["transitions"] = "low -> high: u > a; high -> low: u < b and time > dwell";
  const double a = random.between(-0.2, 0.7) * u.size;
  block["a"] = a;
  block["b"] = a - random.between(0.1, 0.5) * u.size;
  block["dwell"] = with_unit(random.between(0, 0.4), "s");
  block["level"] = {random.between(-1, 0), random.between(0, 1)};
  wires.push_back(put(block, {u}, 1, false, "level"));
  dimensioned.insert(wires.back().name.substr(0, wires.back().name.find('.')));
  return wires.back();
}

Wire Generator::begun_anew(const Wire& u, const Wire& when) {
  const Wire rate = put({{"type", "gain"}, {"gain", with_unit(random.spread(0.5, 5), "1/s")}}, {u}, u.size, u.smooth);
  const Wire start = any();
  const auto at = random.one_of<std::string>({"rising", "falling", "either", "while_on"});
  return add({{"type", "integrator_with_reset"}, {"reset_at", at}}, {rate, when, start}, 2 * u.size + start.size,
             false);
}

Wire Generator::stopped(const Wire& u) {
  const Wire rate = put({{"type", "gain"}, {"gain", with_unit(random.spread(0.5, 5), "1/s")}}, {u}, u.size, u.smooth);
  Json block = {{"type", "limited_integrator"}};
  block["lower"] = -random.between(0.1, 1) * u.size;
  block["upper"] = random.between(0.1, 1) * u.size;
  return add(block, {rate}, u.size, true);
}

/// Linear laws by zeros and poles, by matrices, a sum and its integral, a shaper, and a rate.
Wire Generator::linear(const Wire& u) {
  switch (random.below(6)) {
    case 3: {
      const double w = random.spread(3, 30);
      Json block = {{"type", "state_space"}, {"a", {{-w * random.between(0.2, 1), w}, {-w, -0.5 * w}}}};
      block["b"] = {{0}, {w}};
      block["c"] = {{1, random.between(0, 1)}};
      const bool direct = random.chance(0.5);
      if (direct) block["d"] = {{random.between(0, 1)}};
      return add(block, {u}, 2 * u.size, u.smooth || !direct);
    }
    case 4: {
      Json block = {{"type", "pi_controller"}, {"kp", random.between(0.2, 1)}};
      block["ki"] = with_unit(random.spread(0.1, 2), "1/s");
      return add(block, {u}, 3 * u.size, u.smooth);
    }
    case 5: {
      Json block = {{"type", "input_shaper"}, {"frequency", with_unit(random.spread(0.8, 10), "Hz")}};
      if (random.chance(0.7)) block["damping"] = random.between(0, 0.5);
      return add(block, {u}, u.size, u.smooth);
    }
    case 0: {
      const double real = -random.spread(2, 30), w = random.spread(3, 30);
      Json block = {{"type", "zero_pole_gain"}, {"poles", {real}}, {"zeros", {-random.spread(2, 30)}}};
      block["pole_pairs"] = {{-w * random.between(0.1, 1), w}};
      block["gain"] = w * w;
      return add(block, {u}, 3 * u.size, true);
    }
    case 1: {
      const double pole = random.between(0.2, 0.9), turn = random.between(0, 0.4);
      Json block = {{"type", "discrete_state_space"}, {"a", {{pole, turn}, {-turn, pole}}}, {"b", {{0}, {1 - pole}}}};
      block["c"] = {{1, random.between(0, 1)}};
      if (random.chance(0.5)) block["d"] = {{random.between(0, 1)}};
      return add(sampled(block), {u}, 2 * u.size, false);
    }
    default: {
      const double time = random.spread(0.02, 0.5);
      const Wire rate =
          put({{"type", "filtered_derivative"}, {"time", with_unit(time, "s")}}, {u}, 2 * u.size / time, u.smooth);
      dimensioned.insert(rate.name);
      return told(rate, u.size, "s");
    }
  }
}

}  // namespace reference
