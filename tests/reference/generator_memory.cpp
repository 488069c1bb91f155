// The generator: laws that remember.
#include <algorithm>
#include <cmath>

#include "tests/reference/generator.h"

namespace reference {

Wire Generator::relay(const Wire& u) {
  const double on = around(u.size), off = on - random.between(0.05, 0.8) * u.size;
  Json block = {{"type", "relay"}, {"on_at", on}, {"off_at", off}};
  block["on_value"] = random.between(-2, 2);
  block["off_value"] = random.between(-2, 2);
  if (random.chance(0.3)) block["initial"] = "on";
  return add(block, {u}, 2, false);
}

Wire Generator::play(const Wire& u) {
  Json block = {{"type", "play"}, {"radius", random.between(0.05, 0.7) * u.size}};
  if (random.chance(0.3)) block["sides"] = "one";
  if (random.chance(0.2)) block["before"] = around(u.size);
  return add(block, {u}, u.size, u.smooth);
}

Wire Generator::backlash(const Wire& u) {
  return add({{"type", "backlash"}, {"gap", random.between(0.05, 0.9) * u.size}}, {u}, u.size, u.smooth);
}

Json Generator::plays_of(const Wire& u, const std::string& type) {
  Json block = {{"type", type}, {"thresholds", {0}}, {"weights", {random.between(0.3, 1)}}};
  double r = 0;
  for (int i = 1 + random.below(4); i > 0; --i) {
    r += random.between(0.05, 0.3) * u.size;
    block["thresholds"].push_back(r);
    block["weights"].push_back(random.between(0.05, 0.4));
  }
  block["sides"] = random.chance(0.5) ? "one" : "two";
  return block;
}

Wire Generator::plays(const Wire& u) {
  if (random.chance(0.25)) {
    Json block = plays_of(u, "asymmetric_prandtl_ishlinskii");
    block.erase("sides");
    block["saturation"] = random.between(0.3, 1) * u.size;
    block["bend"] = random.between(0.3, 1) * u.size;
    return add(block, {u}, 3 * u.size, u.smooth);
  }
  Json block = plays_of(u, "prandtl_ishlinskii");
  if (random.chance(0.2)) block["before"] = around(u.size);
  return add(block, {u}, 2 * u.size, u.smooth);
}

Wire Generator::inverse(const Wire& u) {
  if (random.chance(0.4)) return add(plays_of(u, "prandtl_ishlinskii_inverse"), {u}, 3 * u.size, u.smooth);
  if (!u.smooth) return lag(u);
  if (random.chance(0.5)) {
    Json block = bouc_wen_numbers(u, "bouc_wen_inverse");
    return add(block, {u}, 2 * u.size, true);
  }
  return add(jiles_atherton_numbers(u, "jiles_atherton_inverse"), {u}, 2 * u.size, true);
}

Wire Generator::preisach(const Wire& u) {
  const int cells = 2 + random.below(3);
  Json block = {{"type", "preisach"}, {"levels", Json::array()}, {"weights", Json::array()}};
  double level = random.between(-1, -0.4) * u.size;
  block["before"] = level - 0.5 * u.size;
  for (int i = 0; i <= cells; ++i, level += random.between(0.2, 0.6) * u.size) block["levels"].push_back(level);
  for (int k = 0; k < cells * (cells + 1) / 2; ++k) block["weights"].push_back(random.between(0, 0.3));
  block["gain"] = random.between(0, 1);
  return add(block, {u}, 2 * u.size + 1, u.smooth);
}

Json Generator::bouc_wen_numbers(const Wire& u, const std::string& type) {
  const double width = random.between(0.5, 3) / u.size;  // 1/how far until it has bent
  Json block = {{"type", type}, {"alpha", random.between(0.2, 0.8)}, {"beta", width}};
  block["gamma"] = random.between(-0.5, 0.5) * width;
  block["d_p"] = random.between(1, 2);
  if (random.chance(0.4)) {
    block["exponent"] = random.between(1.2, 2.5);
    block["scale"] = random.between(0.2, 0.6) * u.size;
  }
  return block;
}

Wire Generator::bouc_wen(const Wire& u) {
  if (!u.smooth) return lag(u);
  return add(bouc_wen_numbers(u, "bouc_wen"), {u}, 2 * u.size, true);
}

Json Generator::jiles_atherton_numbers(const Wire& u, const std::string& type) {
  Json block = {{"type", type}, {"p_s", random.between(1.5, 4) * u.size}, {"a", random.between(1.2, 3) * u.size}};
  block["alpha"] = random.between(0, 0.15);
  block["k"] = random.between(0.2, 0.8) * u.size;
  block["c"] = random.between(0.2, 0.8);
  return block;
}

Wire Generator::jiles_atherton(const Wire& u) {
  if (!u.smooth) return lag(u);
  return add(jiles_atherton_numbers(u, "jiles_atherton"), {u}, 2 * u.size, true);
}

}  // namespace reference
