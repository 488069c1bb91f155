// Variations that block types offer: the same ports, and with their neutral values nothing changes.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using namespace tools;

struct Offered {
  std::string type;
  VariationDeclaration variation;
};
void PrintTo(const Offered& o, std::ostream* out) { *out << o.type << " " << o.variation.name; }

std::vector<Offered> all_offered() {
  std::vector<Offered> list;
  for (const auto& type : registry().types())
    for (const auto& variation : registry().find(type)->declaration.variations) list.push_back({type, variation});
  return list;
}

/// A block of each type that offers variations, and the unit of what drives it.
struct Example {
  std::string unit;
  Parameters parameters;
};
/// The same mass with what else it needs.
Example mass_with(Parameters more) {
  more.insert(more.begin(), {{"mass", "0.2 kg"},
                             {"damping", "0.8 N s/m"},
                             {"stiffness", "50 N/m"},
                             {"initial_position", "0.03 m"},
                             {"initial_velocity", "-0.2 m/s"}});
  return {"N", std::move(more)};
}

/// The same inertia with what else it needs.
Example inertia_with(Parameters more) {
  more.insert(more.begin(), {{"inertia", "0.2 kg m^2"},
                             {"damping", "0.8 N m s/rad"},
                             {"stiffness", "50 N m/rad"},
                             {"initial_angle", "0.03 rad"},
                             {"initial_velocity", "-0.2 rad/s"}});
  return {"N m", std::move(more)};
}

/// A block and what would take its place, their first input driven by a sine, the others at zero.
Diagram old_and_new(const Declaration& own, const Example& example, const std::string& type, const Parameters& varied) {
  Diagram d = diagram({{"u", block("sine", {{"amplitude", "3 " + example.unit}, {"frequency", "3 Hz"}})}}, {});
  std::vector<std::string> wires{"u"};
  for (std::size_t i = 1; i < own.inputs.size(); ++i) {
    wires.push_back("zero_" + std::to_string(i));
    d.blocks[wires.back()] = block("constant", {{"value", "0 " + own.inputs[i].unit}});
  }
  d.blocks["old"] = block(own.type, example.parameters, wires);
  d.blocks["new"] = block(type, varied, wires);
  return d;
}

const std::map<std::string, Example>& examples() {
  const std::pair<std::string, Value> stiff{"contact_stiffness", list({20, 9}, "N/m")},
      slip{"slip_distance", list({10, 40}, "mm")};
  static const std::map<std::string, Example> all{
      {"integrator", {"V", {{"initial", "0.3 V s"}}}},
      {"gain", {"V", {{"gain", "-1.7 um/V"}}}},
      {"resonance", {"V", {{"frequency", "2 Hz"}, {"damping", 0.1}}}},
      {"mass_spring_damper", mass_with({})},
      {"mass_on_stiffening_spring", mass_with({{"stiffening", "700 N/m^3"}, {"quadratic", "30 N/m^2"}})},
      {"mass_with_drag", mass_with({{"drag", "0.6 N s^2/m^2"}})},
      {"mass_with_presliding", mass_with({stiff, slip})},
      {"mass_with_friction", mass_with({{"coulomb", "0.2 N"}, {"excess", 0.5}, {"stribeck_velocity", "0.1 m/s"}})},
      {"mass_on_hysteretic_spring", mass_with({stiff, slip})},
      {"inertia", inertia_with({})},
      {"gear", {"rad", {{"ratio", 3.0}, {"stiffness", "40 N m/rad"}, {"damping", "0.5 N m s/rad"}}}},
      {"belt", {"rad", {{"radius", "30 mm"}, {"stiffness", "40 N/mm"}, {"damping", "50 N s/m"}}}},
      {"ball_screw", {"rad", {{"pitch", "5 mm"}, {"stiffness", "40 N/um"}, {"damping", "500 N s/m"}}}},
      {"dc_motor",
       {"V",
        {{"resistance", "2 Ohm"},
         {"inductance", "20 mH"},
         {"torque_constant", "0.3 N m/A"},
         {"inertia", "0.02 kg m^2"},
         {"damping", "0.01 N m s/rad"},
         {"initial_angle", "0.03 rad"},
         {"initial_velocity", "-0.2 rad/s"}}}},
      {"pendulum",
       {"N m",
        {{"mass", "2 kg"},
         {"length", "0.5 m"},
         {"damping", "0.3 N m s/rad"},
         {"initial_angle", "0.3 rad"},
         {"initial_speed", "-0.2 rad/s"}}}},
      {"inertia_with_drag", inertia_with({{"drag", "0.6 N m s^2/rad^2"}})},
      {"inertia_with_friction", inertia_with({{"coulomb", "0.2 N m"}, {"breakaway", "0.3 N m"}})},
      {"inertia_with_presliding",
       inertia_with({{"contact_stiffness", list({20, 9}, "N m/rad")}, {"slip_distance", list({10, 40}, "mrad")}})},
      {"mass_on_bouc_wen_spring", mass_with({{"hysteretic_share", 0.4}, {"beta", "7 1/m"}, {"gamma", "-3 1/m"}})},
      {"mass_on_spring_of_plays", mass_with({{"thresholds", list({10, 40}, "mm")},
                                             {"at_lower", list({4, 2}, "N/m")},
                                             {"in_middle", list({1, 3}, "N/m")},
                                             {"at_upper", list({5, 1}, "N/m")},
                                             {"lower", "-0.1 m"},
                                             {"upper", "0.1 m"}})},
      {"prandtl_ishlinskii",
       {"V", {{"thresholds", list({0, 0.8, 2}, "V")}, {"weights", list({1, 0.3, 0.2}, "um/V")}, {"before", "2 V"}}}},
      {"tank", {"l/min", {{"area", "2 m^2"}, {"outlet", "0.2 l/min"}, {"reference", "1 m"}, {"initial", "1.5 m"}}}},
      {"bouc_wen", {"V", {{"alpha", "0.6 um/V"}, {"beta", "0.24 1/V"}, {"gamma", "0.02 1/V"}, {"d_p", "1.6 um/V"}}}},
      {"jiles_atherton",
       {"V", {{"p_s", "56 um"}, {"a", "48.6 V"}, {"alpha", "0.25 V/um"}, {"k", "3.9 V"}, {"c", 0.69}}}},
      {"encoder", {"rad", {{"lines", 40.0}}}},
      {"linear_encoder", {"m", {{"pitch", "0.2 m"}}}},
      {"sample_hold", {"V", {{"period", "10 ms"}, {"offset", "3 ms"}}}},
  };
  return all;
}

class Variations : public testing::TestWithParam<Offered> {
 protected:
  const Declaration& own() const { return registry().find(GetParam().type)->declaration; }
  const Declaration& other() const {
    const Kernel* kernel = registry().find(GetParam().variation.type);
    if (kernel == nullptr) throw std::logic_error("no block type " + GetParam().variation.type);
    return kernel->declaration;
  }
  bool is_own() const { return GetParam().type == GetParam().variation.type; }
};

TEST_P(Variations, HaveTheSamePorts) {
  const auto expect_same = [](const std::vector<PortDeclaration>& a, const std::vector<PortDeclaration>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      EXPECT_EQ(a[i].name, b[i].name);
      EXPECT_EQ(a[i].variadic, b[i].variadic);
      EXPECT_EQ(a[i].is_vector, b[i].is_vector);
      if (a[i].unit.find('$') == std::string::npos) {
        EXPECT_EQ(a[i].unit, b[i].unit);
      }
    }
  };
  expect_same(own().inputs, other().inputs);
  expect_same(own().outputs, other().outputs);
  EXPECT_EQ(own().is_elementwise, other().is_elementwise);
}

TEST_P(Variations, KeepEveryParameterAndNameTheNeutralValueOfEachThatMattersMore) {
  for (const auto& p : own().parameters) {
    const int i = other().parameter_index(p.name);
    ASSERT_GE(i, 0) << p.name;
    const auto& q = other().parameters[static_cast<std::size_t>(i)];
    EXPECT_EQ(p.kind, q.kind) << p.name;
    EXPECT_EQ(p.minimum, q.minimum) << p.name;
    EXPECT_EQ(p.maximum, q.maximum) << p.name;
  }
  const auto& null_value = GetParam().variation.null_value;
  EXPECT_FALSE(null_value.empty());
  const auto is_neutral = [&](const std::string& name) {
    return std::any_of(null_value.begin(), null_value.end(), [&](const auto& n) { return n.parameter == name; });
  };
  for (const auto& n : null_value) {
    const int i = other().parameter_index(n.parameter);
    ASSERT_GE(i, 0) << n.parameter;
    const auto& q = other().parameters[static_cast<std::size_t>(i)];
    if (is_own()) {
      EXPECT_EQ(q.default_text.value_or("none"), n.value) << "a block that does not state it is the old one";
    } else {
      EXPECT_LT(own().parameter_index(n.parameter), 0) << n.parameter << " is no further parameter";
    }
  }
  if (is_own()) return;
  for (const auto& q : other().parameters) {
    if (own().parameter_index(q.name) >= 0) continue;
    EXPECT_TRUE(is_neutral(q.name) || q.default_text) << q.name << " has neither a neutral value nor a default";
  }
}

TEST_P(Variations, WithNeutralValuesGiveTheSameTracesToRounding) {
  const auto example = examples().find(GetParam().type);
  ASSERT_NE(example, examples().end()) << "add an example for " << GetParam().type;
  auto varied = example->second.parameters;
  for (const auto& n : GetParam().variation.null_value) varied.emplace_back(n.parameter, n.value);
  const auto d = old_and_new(own(), example->second, GetParam().variation.type, varied);
  const auto p = compiled(d);
  // A common step for both: an integrator would choose its steps for the two together as well.
  const auto traces = simulate(*p, start(*p), {.until = 1, .every = 1e-2, .method = Method::rk4, .step = 1e-3});
  int compared = 0;
  for (std::size_t i = 0; i < traces.signals.size(); ++i) {
    const std::string& path = p->signals[static_cast<std::size_t>(traces.signals[i])].path;
    if (!path.starts_with("old")) continue;
    const auto& old = traces.values[i];
    const int same = p->signal("new" + path.substr(3));
    const auto j = std::find(traces.signals.begin(), traces.signals.end(), same) - traces.signals.begin();
    // A thousand steps, each with a few roundings.
    EXPECT_LE(distance(old, traces.values[static_cast<std::size_t>(j)]), 1e-13 * largest(old)) << path;
    if (path != "old.spilled") {
      EXPECT_GT(largest(old), 0) << path;
    }
    ++compared;
  }
  EXPECT_EQ(compared, static_cast<int>(own().outputs.size()));
}

TEST_P(Variations, WithOtherValuesGiveOtherTraces) {
  // What is varied can act: a hypothesis that changes nothing could not be tested.
  static const std::map<std::string, Parameters> active{
      {"offset", {{"offset", "1 um"}}},
      {"drag", {{"drag", "3 N*s^2/m^2"}}},
      {"late", {{"share", 1.0}, {"time", "10 ms"}}},
      {"stiffening", {{"stiffening", "1e5 N/m^3"}}},
      {"friction", {{"coulomb", "0.5 N"}, {"breakaway", "1 N"}}},
      {"resonance", {{"share", 0.1}, {"frequency", "3 Hz"}}},
      {"presliding", {{"contact_stiffness", "30 N/m"}, {"slip_distance", "0.02 m"}}},
      {"hysteretic_spring", {{"contact_stiffness", "30 N/m"}, {"slip_distance", "0.02 m"}}},
      {"stops", {{"lower", "-0.04 m"}, {"upper", "0.035 m"}}},
      {"square_root_outflow", {{"law", "square_root"}}},
      {"overflow", {{"brim", "1.500001 m"}}},
      {"sharpness", {{"exponent", 2.0}, {"scale", "1 um"}}},
      {"scale", {{"scale", 1.2}}},
      {"noise", {{"rms", "0.1 V"}}},
      {"computing_time", {{"samples", 1.0}}},
      {"cogging", {{"cosine", "0.1 N"}, {"sine", "0.2 N"}, {"period", "10 mm"}}},
      {"interpolation_error", {{"error_sine", "0.01 rad"}}},
      {"periodic_error", {{"error_sine", "10 mm"}}},
      {"angle_in backlash", {{"gap", "0.2 rad"}}},
      {"angle backlash", {{"gap", "0.2 mm"}}},
      {"voltage presliding", {{"contact_stiffness", "30 N m/rad"}, {"slip_distance", "0.02 rad"}}},
      {"torque cogging", {{"cosine", "0.1 N m"}, {"sine", "0.2 N m"}, {"periods", 7.0}}},
      {"torque drag", {{"drag", "3 N m s^2/rad^2"}}},
      {"torque stiffening", {{"stiffening", "1e5 N m/rad^3"}}},
      {"u friction", {{"level", "0.1 V"}}},
      {"u stiffening", {{"stiffening", "0.3 1/V^2"}}},
      {"torque friction", {{"coulomb", "0.5 N m"}, {"breakaway", "1 N m"}}},
      {"torque presliding", {{"contact_stiffness", "30 N m/rad"}, {"slip_distance", "0.02 rad"}}}};
  const std::string& hypothesis = GetParam().variation.name;
  auto found = active.find(own().inputs.front().name + " " + hypothesis);
  if (found == active.end()) found = active.find(hypothesis);
  ASSERT_NE(found, active.end()) << "add values for " << hypothesis;
  const auto& example = examples().at(GetParam().type);
  auto varied = example.parameters;
  for (const auto& [name, value] : found->second) varied.emplace_back(name, value);
  const auto d = old_and_new(own(), example, GetParam().variation.type, varied);
  const auto p = compiled(d);
  const auto traces = simulate(*p, start(*p), {.until = 1, .every = 1e-2, .method = Method::rk4, .step = 1e-3});
  const auto at = [&](const std::string& block) {
    const int s = p->blocks[static_cast<std::size_t>(p->block_index(block))].y_begin;
    return traces.values[static_cast<std::size_t>(std::find(traces.signals.begin(), traces.signals.end(), s) -
                                                  traces.signals.begin())];
  };
  EXPECT_GT(distance(at("old"), at("new")), 1e-7 * largest(at("old")));
}

INSTANTIATE_TEST_SUITE_P(All, Variations, testing::ValuesIn(all_offered()),
                         [](const auto& tested) { return tested.param.type + "_" + tested.param.variation.name; });

}  // namespace
}  // namespace hysteron
