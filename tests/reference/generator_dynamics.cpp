// The generator: what moves on its own and what limits it.
#include <algorithm>
#include <cmath>

#include "tests/reference/generator.h"

namespace reference {

Wire Generator::lag(const Wire& u) {
  Json times = Json::array();
  for (int i = 1 + random.below(2); i > 0; --i) times.push_back(with_unit(random.spread(5, 500), "ms"));
  return add({{"type", "lag"}, {"times", times}}, {u}, u.size, true);
}

Wire Generator::integrator(const Wire& u) {
  const Wire rate = put({{"type", "gain"}, {"gain", with_unit(random.spread(0.5, 5), "1/s")}}, {u}, u.size, u.smooth);
  Json block = {{"type", "integrator"}};
  if (random.chance(0.3)) block["initial"] = around(u.size);
  return add(block, {rate}, 2 * u.size, true);
}

Wire Generator::resonance(const Wire& u) {
  Json block = {{"type", "resonance"}, {"frequency", with_unit(random.spread(1, 20), "Hz")}};
  block["damping"] = random.spread(0.05, 1);
  if (random.chance(0.3)) {
    block["type"] = "duffing";
    block["stiffening"] = random.between(0, 0.5) / (u.size * u.size);
  }
  return add(block, {u}, 1.5 * u.size, true);
}

Wire Generator::modes(const Wire& u) {
  Json block = {{"type", "modes"}, {"frequencies", {with_unit(random.spread(1, 15), "Hz")}}};
  block["dampings"] = {random.spread(0.05, 0.5)};
  block["positions"] = {random.between(0.1, 0.6)};
  block["velocities"] = {random.between(-0.2, 0.2)};
  return add(block, {u}, 1.5 * u.size, u.smooth);
}

Wire Generator::creep(const Wire& u) {
  Json block = {{"type", "creep"}, {"amounts", {random.between(0.02, 0.3), random.between(0.02, 0.3)}}};
  block["times"] = {with_unit(random.spread(0.03, 0.3), "s"), with_unit(random.spread(0.3, 3), "s")};
  return add(block, {u}, 1.5 * u.size, u.smooth);
}

Wire Generator::transfer(const Wire& u) {
  const double w = random.spread(3, 60), d = random.between(0.1, 1.2);
  Json num = random.chance(0.3) ? Json{random.between(0, 1), w * random.between(0, 2), w * w} : Json{w * w};
  const bool direct = num.size() == 3;
  return add({{"type", "transfer_function"}, {"num", num}, {"den", {1, 2 * d * w, w * w}}}, {u}, 1.5 * u.size,
             u.smooth || !direct);
}

Wire Generator::section(const Wire& u) {
  const auto corner = [&] { return with_unit(random.spread(1, 20), "Hz"); };
  switch (random.below(4)) {
    case 0:
      return add({{"type", "lead_lag"}, {"zero", corner()}, {"pole", corner()}}, {u}, 3 * u.size, u.smooth);
    case 1: {
      Json block = {{"type", "notch"}, {"frequency", corner()}, {"damping", random.between(0.1, 1)}};
      block["depth"] = random.between(0, 1.2);
      return add(block, {u}, 1.5 * u.size, u.smooth);
    }
    case 2: {
      Json block = {{"type", "second_order"}, {"frequency", corner()}, {"damping", random.between(0.1, 1.3)}};
      const auto pass = random.one_of<std::string>({"low", "band", "high"});
      block["pass"] = pass;
      return add(block, {u}, 1.5 * u.size, u.smooth || pass != "high");
    }
    default: {
      Json block = {{"type", "biquads"}, {"zero_frequencies", {corner(), corner()}}};
      block["zero_dampings"] = {random.between(-0.3, 0.5), random.between(0, 0.5)};
      block["pole_frequencies"] = {with_unit(random.spread(2, 20), "Hz"), with_unit(random.spread(2, 20), "Hz")};
      block["pole_dampings"] = {random.between(0.2, 1), random.between(0.2, 1)};
      return add(block, {u}, 10 * u.size, u.smooth);
    }
  }
}

Wire Generator::dead_time(const Wire& u) {
  return add({{"type", "dead_time"}, {"delay", with_unit(random.spread(0.01, 0.6), "s")}}, {u}, u.size, u.smooth);
}

Wire Generator::limiter(const Wire& u) {
  const double rate = random.spread(0.5, 10) * u.size;
  if (random.chance(0.4)) {
    Json block = {{"type", "slew_limit"}, {"rate", with_unit(rate, "1/s")}};
    block["time"] = with_unit(random.spread(2, 20), "ms");
    return add(block, {u}, u.size, true);
  }
  Json block = {{"type", "rate_limiter"}, {"rise", with_unit(rate, "1/s")}};
  block["fall"] = with_unit(random.spread(0.5, 10) * u.size, "1/s");
  block["time"] = with_unit(random.spread(2, 20), "ms");
  return add(block, {u}, u.size, true);
}

Wire Generator::body(const Wire& u) {
  const double newtons = random.spread(0.5, 5), kilogram = random.spread(0.2, 3), force = newtons * u.size;
  const Wire push = put({{"type", "gain"}, {"gain", with_unit(newtons, "N")}}, {u}, force, u.smooth);
  const int kind = random.below(6);
  const bool spring = kind == 0 || kind == 3 || random.chance(0.7);
  const double w = random.spread(3, 40), stiffness = spring ? kilogram * w * w : 0;
  const double travel = spring ? force / stiffness : force / kilogram / 30;
  Json block = {{"type", "mass_spring_damper"}, {"mass", with_unit(kilogram, "kg")}};
  block["damping"] = with_unit(random.between(0.05, 0.6) * kilogram * w, "N*s/m");
  if (spring || kind == 3 || kind == 4) block["stiffness"] = with_unit(stiffness, "N/m");
  if (kind == 1 || kind == 2) {
    const double coulomb = random.between(0.05, 0.7) * force;
    block["type"] = "mass_with_friction";
    block["coulomb"] = with_unit(coulomb, "N");
    block["breakaway"] = with_unit(coulomb * random.between(1, 1.5), "N");
    if (random.chance(0.5)) block["stribeck_velocity"] = with_unit(random.between(0.1, 1) * travel * w, "m/s");
  } else if (kind == 5) {
    block["type"] = "mass_with_stops";
    block["lower"] = with_unit(-random.between(0.2, 1) * travel, "m");
    block["upper"] = with_unit(random.between(0.2, 1) * travel, "m");
    if (random.chance(0.6)) block["restitution"] = random.between(0.1, 0.8);
  } else if (kind == 4) {
    block["type"] = random.chance(0.5) ? "mass_with_presliding" : "mass_on_hysteretic_spring";
    const double slip = random.between(0.1, 0.5) * travel;
    block["contact_stiffness"] = {with_unit(random.between(0.1, 0.6) * force / slip, "N/m")};
    block["slip_distance"] = {with_unit(slip, "m")};
  } else if (kind == 3 && random.chance(0.6)) {
    block["type"] = "mass_on_stiffening_spring";
    block["stiffening"] = with_unit(random.between(0, 1) * stiffness / (travel * travel), "N/m^3");
  }
  const Wire mass = put(block, {push}, travel, true, "position");
  return add({{"type", "gain"}, {"gain", with_unit(u.size / travel, "1/m")}}, {mass}, 2 * u.size, true);
}

}  // namespace reference
