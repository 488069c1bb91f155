// Decides on what and with which signals an effect is shown. See demo_rig.h.
#include "discover/demonstration/demo_rig.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "discover/hypotheses/effect_terms.h"
#include "engine/block/instance.h"

namespace hysteron {
namespace {

constexpr int rows_per_stimulus = 10000;  // four decades of time between a row and the whole
constexpr int levels_of_reading = 32;

/// True if `is` holds for the block of a law, or for one inside it.
bool any_block(const Node& node, const Registry& registry, const std::function<bool(const Kernel&)>& is) {
  if (node.nested)
    return std::any_of(node.nested->blocks.begin(), node.nested->blocks.end(),
                       [&](const auto& inner) { return any_block(inner.second, registry, is); });
  const KernelPointer k = kernel_of(registry, node);
  return k != nullptr && is(*k);
}

Node node(const std::string& type, const std::vector<std::pair<std::string, Value>>& parameters) {
  Node n;
  n.type = type;
  for (const auto& [name, value] : parameters) n.parameters[name] = value;
  return n;
}

/// Said by the declaration, not by the diagram.
bool has_own_unit(const UnitExpression& unit) { return unit.find('$') == std::string::npos; }

/// A device that lacks what varies it: a mass or an inertia that rings at a third of a hertz, a tank that fills in five
/// seconds, a hysteresis as the effect of that block puts it in; of any other type one with a unit of everything.
Node usual_device(const Declaration& d, const Effects& library) {
  if (d.type == "mass_spring_damper")
    return node(d.type, {{"mass", "1 kg"}, {"stiffness", "4 N/m"}, {"damping", "0.4 N*s/m"}});
  if (d.type == "inertia")
    return node(d.type, {{"inertia", "1 kg m^2"}, {"stiffness", "4 N m/rad"}, {"damping", "0.4 N m s/rad"}});
  if (d.type == "tank") return node(d.type, {{"area", "0.5 m^2"}, {"outlet", "0.1 m^3/s"}, {"reference", "1 m"}});
  Excitation at;
  at.unit = parse_unit("V");
  at.highest = 100;
  for (const auto& effect : library.list())
    if (effect.way == Way::insert && effect.block_type == d.type) return effect.laws(at).front().block;
  Node n;
  n.type = d.type;
  for (const auto& p : d.parameters) {
    if (p.default_text || p.kind == ParameterKind::text || p.kind == ParameterKind::matrix) continue;
    const Number one{1, has_own_unit(p.unit) ? p.unit : ""};
    n.parameters[p.name] = p.kind == ParameterKind::list ? Value(NumberList{one}) : Value(one);
  }
  return n;
}

void put_device(DemoRig& demo_rig, const Declaration& d, Node device) {
  demo_rig.device = d.type;
  device.in = {{"", "in"}};
  for (std::size_t i = 1; i < d.inputs.size(); ++i) {  // what else it reads is at rest
    const PortDeclaration& port = d.inputs[i];
    device.in.push_back({"", "rest_of_" + port.name});
    demo_rig.diagram.blocks[device.in.back().from] =
        node("constant", {{"value", Value(Number{0, has_own_unit(port.unit) ? port.unit : ""})}});
  }
  demo_rig.diagram.blocks["device"] = std::move(device);
  demo_rig.diagram.outputs["out"] = d.outputs.size() > 1 ? "device." + d.outputs.front().name : "device";
  demo_rig.place.at = "device";
  demo_rig.place.wire = "in";
}

DemoRig wire_in(const Unit& unit, double top) {
  DemoRig demo_rig;
  demo_rig.unit = unit;
  demo_rig.top = top;
  demo_rig.diagram.inputs["in"].unit = effects::unit_text(unit);
  return demo_rig;
}

/// A wire in the unit of the device's first input. A force of 4 N on a spring of 4 N/m moves it by a metre; 0.1 m^3/s
/// fill the tank to a metre; a device with a unit of everything gets one of its unit, any unit being volts.
DemoRig rig_of(const Declaration& d) {
  if (d.type == "mass_spring_damper" || d.type == "inertia") return wire_in(parse_unit(d.inputs.front().unit), 4);
  if (d.type == "tank") return wire_in(parse_unit("m^3/s"), 0.1);
  if (has_own_unit(d.inputs.front().unit)) return wire_in(parse_unit(d.inputs.front().unit), 1);
  return wire_in(parse_unit("V"), 100);
}

/// Devices of the registry that offer the variation, or have the parameter, by which the effect enters.
std::vector<DemoRig> device_rigs(const Effect& effect, const Effects& library, const Registry& registry) {
  std::vector<DemoRig> list;
  for (const auto& type : registry.types()) {
    const Declaration& d = registry.find(type)->declaration;
    if (d.inputs.empty() || d.group == "internal") continue;
    const VariationDeclaration* v = varied_by(effect, d);
    const std::string by = v == nullptr ? "" : v->type;
    const bool has = !effect.parameter.empty() && !d.memory_port.empty() &&
                     std::any_of(d.parameters.begin(), d.parameters.end(),
                                 [&](const ParameterDeclaration& p) { return p.name == effect.parameter; });
    if (by.empty() && !(effect.variation.empty() && has)) continue;
    DemoRig demo_rig = rig_of(d);
    put_device(demo_rig, d, usual_device(d, library));
    demo_rig.place.by = by;
    list.push_back(std::move(demo_rig));
  }
  // Those that become what the effect's own equation speaks of show it in its own units.
  const std::string own =
      effect.way == Way::vary && !effect.variation.empty() ? effect.laws(Excitation{}).front().block.type : "";
  std::stable_partition(list.begin(), list.end(), [&](const DemoRig& b) { return b.place.by == own; });
  // Devices that an effect of the library makes are better known than any other.
  std::stable_partition(list.begin(), list.end(), [&](const DemoRig& b) {
    return std::any_of(library.list().begin(), library.list().end(),
                       [&](const Effect& e) { return e.way == Way::insert && e.block_type == b.device; });
  });
  return list;
}

/// The second signal of an effect, with a name and a size that are usual for it.
void put_side(DemoRig& demo_rig, const Effect& effect, const Law& law) {
  switch (effect.side) {
    case Side::none:
      return;
    case Side::temperature:
      demo_rig.side = "temperature";
      demo_rig.side_unit = parse_unit("degC");
      demo_rig.side_from = demo_rig.side_unit.to_si(20);
      demo_rig.side_to = demo_rig.side_unit.to_si(40);
      break;
    case Side::force:
      demo_rig.side = "force";
      demo_rig.side_unit = parse_unit("N");
      demo_rig.side_to = 100;
      break;
    case Side::use:
      demo_rig.side = column_of_cycles;
      demo_rig.side_to = 1e6;
      break;
    case Side::other_axis:
      demo_rig.side = "other_axis";
      demo_rig.side_unit = demo_rig.unit;
      demo_rig.side_to = demo_rig.top;
      break;
  }
  if (law.block.nested) {
    const auto& inputs = law.block.nested->inputs;
    if (const auto& unit = (inputs.end() - 1)->second.unit; !unit.empty() && effect.side != Side::temperature)
      demo_rig.side_unit = parse_unit(unit);
  }
  demo_rig.place.side = demo_rig.side;
  demo_rig.place.side_unit = demo_rig.side_unit;
}

Series sampled(double length, int rows, const std::function<double(double)>& f) {
  Series s;
  for (int k = 0; k <= rows; ++k) {
    s.t.push_back(length * k / rows);
    s.v.push_back(f(static_cast<double>(k) / rows));
  }
  return s;
}

/// Levels one after the other, each for the same time; a change takes a thousandth of a row.
Series staircase(const std::vector<double>& levels, double length, double row) {
  Series s{{0.0}, {levels.front()}, Between::linear};
  for (std::size_t k = 1; k < levels.size(); ++k) {
    const double at = length * static_cast<double>(k) / static_cast<double>(levels.size());
    s.t.insert(s.t.end(), {at, at + 1e-3 * row});
    s.v.insert(s.v.end(), {levels[k - 1], levels[k]});
  }
  return s;
}

/// Swings that shrink to a quarter: from `foot` times the top upwards.
Series shrinking(double top, double foot, double length) {
  constexpr int swings = 4;
  Series s{{0.0}, {0.0}, Between::linear};
  for (int k = 0; k < swings; ++k) {
    const double size = top * (1 - 0.25 * k), begin = length * k / swings, each = length / swings;
    s.t.insert(s.t.end(), {begin + each / 2, begin + each});
    s.v.insert(s.v.end(), {size, foot * size});
  }
  return s;
}

}  // namespace

Nature nature_of(const Effect& effect, const Registry& registry) {
  if (effect.side != Side::none) return Nature::beside;
  if (effect.is_memory) return Nature::memory;
  Excitation at;
  at.unit = parse_unit("V");
  const Node block = effect.laws(at).front().block;
  const auto is_delay = [](const Kernel& k) { return k.reach_back != nullptr; };
  if (any_block(block, registry, [&](const Kernel& k) { return k.uses_time && !is_delay(k); })) return Nature::clock;
  if (!any_block(block, registry, [&](const Kernel& k) { return k.derivative != nullptr || is_delay(k); }))
    return Nature::curve;
  return effect.way == Way::insert ? Nature::settling : Nature::dynamic;
}

std::vector<DemoRig> demo_rigs(const Effect& effect, const Effects& library, const Registry& registry) {
  if (effect.way != Way::insert) return device_rigs(effect, library, registry);
  Excitation at;
  at.unit = parse_unit("V");
  const Law law = effect.laws(at).front();
  std::vector<std::string> units{"V", "um", "mm/s", "N"};
  if (std::find(effect.places.begin(), effect.places.end(), "command") == effect.places.end())
    std::swap(units[0], units[1]);  // behind the drive it is a motion that is looked at
  if (law.block.nested)
    if (const auto* in = law.block.nested->inputs.find("in"); in != nullptr && !in->unit.empty())
      units.insert(units.begin(), in->unit);
  std::vector<DemoRig> list;
  for (const auto& text : units) {
    const Unit unit = parse_unit(text);
    DemoRig demo_rig = wire_in(unit, unit.to_si(100));
    demo_rig.diagram.blocks["wire"].type = "pass";  // no diagram is without blocks
    demo_rig.diagram.blocks["wire"].in = {{"", "in"}};
    demo_rig.diagram.outputs["out"] = demo_rig.place.at = demo_rig.place.wire = "wire";
    put_side(demo_rig, effect, law);
    list.push_back(std::move(demo_rig));
  }
  return list;
}

std::vector<Waveform> waveforms_for(Nature nature) {
  using enum Waveform;
  const std::vector<Waveform> all{shrinking, shrinking_about_zero, step, levels, sine, sine_about_zero, waves};
  std::vector<Waveform> list;
  switch (nature) {
    case Nature::beside:
      return {waves};
    case Nature::memory:
      list = {shrinking, shrinking_about_zero};
      break;
    case Nature::settling:
      list = {step, levels};
      break;
    case Nature::dynamic:
      list = {levels, sine_about_zero};
      break;
    case Nature::clock:
      list = {sine, step};
      break;
    case Nature::curve:
      list = {sine, sine_about_zero};
  }
  for (const Waveform w : all)  // what an effect of a user's own may need besides
    if (std::find(list.begin(), list.end(), w) == list.end()) list.push_back(w);
  return list;
}

Stimulus stimulus(Waveform waveform, const DemoRig& demo_rig, double length) {
  using std::numbers::pi;
  Stimulus s;

  s.length = length;
  s.row = length / rows_per_stimulus;
  const double top = demo_rig.top;
  switch (waveform) {
    case Waveform::shrinking:
    case Waveform::shrinking_about_zero:
      s.text = waveform == Waveform::shrinking ? "a triangle that shrinks" : "a triangle about zero that shrinks";
      s.in = shrinking(top, waveform == Waveform::shrinking ? 0 : -1, length);
      break;
    case Waveform::step:
      s.text = "a step and a hold";
      s.in = staircase({0, top, top, top, top, top, top, top, top, top}, length, s.row);
      s.step_at = 0.1 * length;
      break;
    case Waveform::levels:
      s.text = "levels, each held";
      s.in = staircase({0, top / 3, top, top / 3}, length, s.row);
      s.step_at = 0.25 * length;
      break;
    case Waveform::sine:
      s.text = "a slow sine";
      s.in = sampled(length, 2000, [&](double part) { return top / 2 * (1 - std::cos(4 * pi * part)); });
      break;
    case Waveform::sine_about_zero:
      s.text = "a slow sine about zero";
      s.in = sampled(length, 2000, [&](double part) { return top * std::sin(4 * pi * part); });
      break;
    case Waveform::waves:
      s.text = demo_rig.side.empty() ? "waves" : "waves, while " + demo_rig.side + " rises in the middle third";
      s.in = sampled(length, 2400, [&](double part) { return top / 2 * (1 - std::cos(24 * pi * part)); });
      break;
  }
  if (!demo_rig.side.empty())
    s.side = {
        {0, length / 3, 2 * length / 3}, {demo_rig.side_from, demo_rig.side_from, demo_rig.side_to}, Between::linear};
  return s;
}

DataSet recorded(const Stimulus& stimulus, const DemoRig& demo_rig) {
  Recording r;
  r.name = r.file = "standard signal";
  const double step = demo_rig.top / levels_of_reading;
  for (int k = 0; k <= rows_per_stimulus; ++k) {
    const double t = stimulus.row * k;
    r.t.push_back(t);
    r.columns["in"].push_back(stimulus.in.value(t, t));
    r.columns["out"].push_back(step * std::round(r.columns["in"].back() / step));
    if (!demo_rig.side.empty()) r.columns[demo_rig.side].push_back(stimulus.side.value(t, t));
  }
  r.last = r.t.size();
  r.units = {{"in", demo_rig.unit}, {"out", demo_rig.unit}};
  if (!demo_rig.side.empty()) r.units[demo_rig.side] = demo_rig.side_unit;
  DataSet data;
  for (const auto& [name, unit] : r.units) data.notes[name].to = name;
  data.recordings.push_back(std::move(r));
  return data;
}

}  // namespace hysteron
