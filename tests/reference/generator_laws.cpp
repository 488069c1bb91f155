// The generator: laws without memory.
#include <algorithm>
#include <cmath>

#include "tests/reference/generator.h"

namespace reference {

Wire Generator::gain(const Wire& u) {
  const double g = (random.chance(0.3) ? -1 : 1) * random.spread(0.3, 3);
  return add({{"type", "gain"}, {"gain", g}}, {u}, std::abs(g) * u.size, u.smooth);
}

Wire Generator::sum(const Wire& u) {
  const Wire v = any();
  return add({{"type", "sum"}, {"signs", random.chance(0.5) ? "+-" : "++"}}, {u, v}, u.size + v.size,
             u.smooth && v.smooth);
}

Wire Generator::product(const Wire& u) {
  const Wire v = any();
  return add({{"type", "product"}}, {u, v}, u.size * v.size, u.smooth && v.smooth);
}

Wire Generator::saturation(const Wire& u) {
  const double a = around(u.size), b = a + random.between(0.1, 1) * u.size;
  return add({{"type", "saturation"}, {"lower", a}, {"upper", b}}, {u}, std::max(std::abs(a), std::abs(b)), u.smooth);
}

Wire Generator::dead_zone(const Wire& u) {
  const double a = random.between(0.1, 0.8) * u.size;
  const Wire inner = put({{"type", "saturation"}, {"lower", -a}, {"upper", a}}, {u}, a, u.smooth);
  return add({{"type", "sum"}, {"signs", "+-"}}, {u, inner}, u.size, u.smooth);
}

Wire Generator::rectifier(const Wire& u) {
  return add({{"type", "rectifier"}, {"mix", random.chance(0.5) ? 0.5 : random.between(0, 1)}}, {u}, u.size, u.smooth);
}

Wire Generator::rounding(const Wire& u) {
  return add({{"type", "rounding"}, {"step", random.between(0.1, 0.7) * u.size}}, {u}, u.size, false);
}

Wire Generator::expression(const Wire& u) {
  const double a = around(u.size), b = random.between(0.3, 1) * u.size;
  Json block = {{"type", "expression"}, {"a", a}, {"b", b}};
  switch (random.below(3)) {
    case 0:
      block["y"] = "a*sin(u/b) + u^2/sqrt(b^2 + u^2)";
      return add(block, {u}, 2 * u.size, u.smooth);
    case 1:
      block["y"] = "max(u, a) - 0.5*min(u, b) + abs(u)";
      return add(block, {u}, 3 * u.size, u.smooth);
    default:
      block["y"] = "if(u > a, b, c)";
      block["c"] = around(u.size);
      return add(block, {u}, u.size, false);
  }
}

Wire Generator::table(const Wire& u) {
  Json block = {{"type", "lookup"}, {"at", Json::array()}, {"values", Json::array()}};
  double at = random.between(-1, -0.4) * u.size;
  for (int i = 2 + random.below(4); i > 0; --i, at += random.between(0.2, 0.6) * u.size) {
    block["at"].push_back(at);
    block["values"].push_back(around(u.size));
  }
  if (random.chance(0.4)) block["outside"] = "extrapolate";
  return add(block, {u}, 4 * u.size, u.smooth);
}

Wire Generator::level(const Wire& u) {
  Json block = {{"type", "comparator"}, {"level", around(u.size)}};
  block["above"] = random.between(-2, 2);
  block["below"] = random.between(-2, 2);
  return add(block, {u}, 2, false);
}

Wire Generator::of_two(const Wire& u) {
  const Wire v = any();
  if (random.chance(0.5))
    return add({{"type", "min_max"}, {"is", random.chance(0.5) ? "max" : "min"}}, {u, v}, u.size + v.size,
               u.smooth && v.smooth);
  const Wire control = any();
  return add({{"type", "switch"}, {"level", around(control.size)}}, {u, control, v}, u.size + v.size, false);
}

Wire Generator::smooth_curve(const Wire& u) {
  if (random.chance(0.5))
    return add({{"type", "soft_saturation"}, {"limit", random.between(0.3, 1.5) * u.size}}, {u}, u.size, u.smooth);
  Json block = {{"type", "polynomial"}, {"coefficients", {around(u.size), u.size, around(0.5 * u.size)}}};
  block["reference"] = u.size;
  block["lower"] = -random.between(0.5, 1.2) * u.size;
  block["upper"] = random.between(0.5, 1.2) * u.size;
  return add(block, {u}, 2 * u.size, u.smooth);
}

}  // namespace reference
