#include "tests/reference/generator.h"

#include <algorithm>
#include <cmath>

namespace reference {
namespace {

/// Numbers with four digits: what stands in the file is what is meant.
void shorten(Json& block) {
  for (auto& [key, value] : block.items()) {
    if (value.is_number_float()) value = Random::four_digits(value);
    if (value.is_array())
      for (auto& one : value)
        if (one.is_number_float()) one = Random::four_digits(one);
  }
}

}  // namespace

std::string with_unit(double value, const std::string& unit) {
  return Json(Random::four_digits(value)).dump() + " " + unit;
}

RandomDiagram Generator::make() {
  const int count = 2 + random.below(11);
  source();
  if (count > 4 && random.chance(0.5)) source();
  if (count > 3 && random.chance(0.35)) loop();
  while (static_cast<int>(blocks.size()) < count) grow(any());
  choose_something();
  name_a_parameter();
  nest_something();
  return written();
}

Wire Generator::put(Json block, const std::vector<Wire>& in, double size, bool smooth, const std::string& port) {
  const std::string name = fresh();
  shorten(block);
  if (in.size() == 1) block["in"] = in[0].name;
  if (in.size() > 1) {
    block["in"] = Json::array();
    for (const auto& wire : in) block["in"].push_back(wire.name);
  }
  blocks[name] = std::move(block);
  return {port.empty() ? name : name + "." + port, size, smooth};
}

Wire Generator::add(Json block, const std::vector<Wire>& in, double size, bool smooth) {
  wires.push_back(put(std::move(block), in, size, smooth));
  return wires.back();
}

Wire Generator::any() {
  const int n = static_cast<int>(wires.size());
  return wires[static_cast<std::size_t>(std::max(random.below(n), random.below(n)))];
}

Wire Generator::grow(const Wire& u) {
  if (draws_machines && random.chance(0.6)) return grow_machine(u);
  if (draws_drives && random.chance(0.4)) return grow_drive(u);
  static const std::vector<Maker> makers = {&Generator::gain,         &Generator::sum,
                                            &Generator::sum,          &Generator::product,
                                            &Generator::saturation,   &Generator::dead_zone,
                                            &Generator::rectifier,    &Generator::rounding,
                                            &Generator::relay,        &Generator::relay,
                                            &Generator::play,         &Generator::play,
                                            &Generator::plays,        &Generator::preisach,
                                            &Generator::bouc_wen,     &Generator::jiles_atherton,
                                            &Generator::inverse,      &Generator::lag,
                                            &Generator::lag,          &Generator::integrator,
                                            &Generator::resonance,    &Generator::transfer,
                                            &Generator::dead_time,    &Generator::dead_time,
                                            &Generator::hold,         &Generator::quantizer,
                                            &Generator::delay_line,   &Generator::filter,
                                            &Generator::pid,          &Generator::limiter,
                                            &Generator::body,         &Generator::body,
                                            &Generator::smooth_curve, &Generator::creep,
                                            &Generator::modes,        &Generator::backlash,
                                            &Generator::section,      &Generator::sampled_filter,
                                            &Generator::expression,   &Generator::table,
                                            &Generator::level,        &Generator::of_two};
  return (this->*random.one_of(makers))(u);
}

void Generator::loop() {
  const Wire reference = any();
  const std::string error = fresh();
  blocks[error] = Json::object();  // its place in the file; the wires are known later
  Wire forward{error, 1.5 * reference.size, reference.smooth};
  const int kind = random.below(6);
  if (kind == 5) forward.smooth = false;
  for (int i = 1 + random.below(2); i > 0; --i) forward = grow_monotone(forward);
  if (kind <= 1) forward = lag(forward);
  if (kind == 2) forward = integrator(forward);
  if (kind == 3) forward = resonance(gain_of(forward, 0.3));
  if (kind == 4) forward = lag(dead_time(gain_of(forward, 0.6)));
  const Wire back = gain_of(forward, kind == 5 ? random.between(0.1, 0.6) : random.between(0.3, 1.5));
  blocks[error] = {{"type", "sum"}, {"signs", "+-"}, {"in", {reference.name, back.name}}};
  wires.push_back({error, 1.5 * reference.size, forward.smooth && reference.smooth});
}

Wire Generator::gain_of(const Wire& u, double g) {
  return add({{"type", "gain"}, {"gain", g}}, {u}, std::abs(g) * u.size, u.smooth);
}

Wire Generator::grow_monotone(const Wire& u) {
  if (draws_drives && random.chance(0.3)) return controller(u);
  static const std::vector<Maker> makers = {&Generator::saturation, &Generator::play,
                                            &Generator::plays,      &Generator::lag,
                                            &Generator::relay,      &Generator::pid,
                                            &Generator::hold,       &Generator::limiter,
                                            &Generator::backlash,   &Generator::smooth_saturation};
  const auto make = random.one_of(makers);
  return (this->*make)(u);
}

Wire Generator::smooth_saturation(const Wire& u) {
  return add({{"type", "soft_saturation"}, {"limit", random.between(0.3, 1.5) * u.size}}, {u}, u.size, u.smooth);
}

}  // namespace reference
