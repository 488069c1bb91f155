// Decides how a case of hidden effects becomes a diagram and a data set. See hidden_case.h.
#include "benchmarks/hidden_case.h"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "engine/diagram/error.h"
#include "io/files/atomic_file.h"

namespace hysteron {
namespace {

using nlohmann::json;

NumberList list_of(const json& values, const char* unit) {
  NumberList list;
  for (const auto& v : values) {
    Number n;
    n.value = v.get<double>();
    if (*unit != 0) n.unit = unit;
    list.push_back(n);
  }
  return list;
}

Number in(double value, const char* unit) {
  Number n;
  n.value = value;
  n.unit = unit;
  return n;
}

Node& block(Diagram& d, const std::string& name, const std::string& type, const std::vector<std::string>& in) {
  Node& node = d.blocks[name];
  node.type = type;
  for (const auto& wire : in) node.in.push_back({"", wire});
  return node;
}

void plays(Diagram& d, const std::string& name, const json& p, const std::string& from) {
  Node& stage = block(d, name, "prandtl_ishlinskii", {from});
  stage.parameters["thresholds"] = Value(list_of(p.at("thresholds_V"), "V"));
  stage.parameters["weights"] = Value(list_of(p.at("weights_um_per_V"), "um/V"));
}

void sensor(Diagram& d, const std::string& name, const json& p, const std::string& from) {
  Node& made = block(d, name, "calibration", {from});
  made.parameters["gain"] = Value(1.0);
  made.parameters["offset"] = Value(in(p.at("offset_um"), "um"));
}

/// B1: a gain with dynamics.
void dynamic_stage(Diagram& d, const json& p) {
  Node& plant = block(d, "stage", "transfer_function", {"u"});
  plant.parameters["gain"] = Value(in(p.at("gain_um_per_V"), "um/V"));
  plant.parameters["num"] = Value(list_of(p.at("dynamics").at("num"), ""));
  plant.parameters["den"] = Value(list_of(p.at("dynamics").at("den"), ""));
  sensor(d, "sensor", p, "stage");
  d.outputs["y"] = "sensor";
}

/// B2: play operators.
void hysteretic_stage(Diagram& d, const json& p) {
  plays(d, "stage", p, "u");
  sensor(d, "sensor", p, "stage");
  d.outputs["y"] = "sensor";
}

/// B3: two of these.
void two_axes(Diagram& d, const json& p) {
  d.inputs["u2"].unit = "V";
  plays(d, "stage", p.at("axes")[0], "u");
  plays(d, "stage2", p.at("axes")[1], "u2");
  sensor(d, "sensor", p.at("axes")[0], "stage");
  sensor(d, "sensor2", p.at("axes")[1], "stage2");
  d.outputs["y"] = "sensor";
  d.outputs["y2"] = "sensor2";
}

/// B4: a mass on a spring.
void mass_on_spring(Diagram& d, const json& p) {
  block(d, "force", "gain", {"u"}).parameters["gain"] = Value(in(p.at("force_per_volt_N"), "N/V"));
  Node& stage = block(d, "stage", "mass_spring_damper", {"force"});
  stage.parameters["mass"] = Value(in(p.at("mass_kg"), "kg"));
  stage.parameters["damping"] = Value(in(p.at("damping_Ns_per_m"), "N*s/m"));
  stage.parameters["stiffness"] = Value(in(p.at("stiffness_N_per_m"), "N/m"));
  sensor(d, "sensor", p, "stage.position");
  d.outputs["y"] = "sensor";
}

/// B5: two thermal masses.
void heater_and_mass(Diagram& d, const json& p) {
  d.inputs["Ta"].unit = "degC";
  block(d, "heater", "gain", {"u"}).parameters["gain"] = Value(in(p.at("power_per_volt_W"), "W/V"));
  const double c1 = p.at("C1_J_per_K"), c2 = p.at("C2_J_per_K"), r12 = p.at("R12_K_per_W"), r2a = p.at("R2a_K_per_W");
  // T above ambient per watt: 1 / (C1 C2 R12 s^2 + (C1 (1 + R12/R2a) + C2) s + 1/R2a) for power into C1, and ambient
  // alike, with both masses at ambient before.
  const double a2 = c1 * c2 * r12 * r2a, a1 = (c1 * (r2a + r12) + c2 * r2a);
  Node& heat = block(d, "stage", "transfer_function", {"heater"});
  heat.parameters["gain"] = Value(in(r2a, "K/W"));
  heat.parameters["num"] = Value(NumberList{Number{1, {}}});
  heat.parameters["den"] = Value(NumberList{Number{a2, {}}, Number{a1, {}}, Number{1, {}}});
  // What ambient does: Ta - its own rate through the masses, (C1 R12 s + 1)/(...).
  Node& room = block(d, "room", "transfer_function", {"Ta"});
  room.parameters["gain"] = Value(1.0);
  room.parameters["num"] = Value(NumberList{Number{c1 * r12, {}}, Number{1, {}}});
  room.parameters["den"] = Value(NumberList{Number{a2, {}}, Number{a1, {}}, Number{1, {}}});
  block(d, "sensor", "sum", {"stage", "room"});
  d.outputs["T"] = "sensor";
}

void base_of(Diagram& d, const json& task) {
  const auto& p = task.at("base_parameters");
  const std::string base = task.at("base");
  if (base == "B1") return dynamic_stage(d, p);
  if (base == "B2") return hysteretic_stage(d, p);
  if (base == "B3") return two_axes(d, p);
  if (base == "B4") return mass_on_spring(d, p);
  if (base == "B5") return heater_and_mass(d, p);
  fail("bad_case", d.title, "there is no base model " + base, "B1, B2, B3, B4 and B5 are known");
}

/// Where a number of the task stands in the diagram.
struct Stands {
  const char *key, *block, *parameter;
};
constexpr Stands stands[] = {{"gain_um_per_V", "stage", "gain"},        {"weights_um_per_V", "stage", "weights"},
                             {"weights_um_per_V", "stage2", "weights"}, {"force_per_volt_N", "force", "gain"},
                             {"damping_Ns_per_m", "stage", "damping"},  {"power_per_volt_W", "heater", "gain"}};

/// "base_parameters_free": numbers that the user knows to a few per cent only, and leaves free.
std::vector<std::string> free_paths(const Diagram& d, const json& task) {
  std::vector<std::string> paths;
  for (const auto& wish : task.value("base_parameters_free", json::array())) {
    const std::string key = wish.get<std::string>();
    const std::size_t before = paths.size();
    for (const auto& s : stands)
      if (const Node* node = key == s.key ? d.blocks.find(s.block) : nullptr;
          node && node->parameters.find(s.parameter))
        paths.push_back(fmt::format("{}.{}", s.block, s.parameter));
    if (paths.size() == before)
      fail("bad_case", d.title, "base_parameters_free: this base model has no \"" + key + "\" that could be free",
           "gains, weights and a damping can be, named as in base_parameters");
  }
  return paths;
}

/// The data sheet's noise; quantised on top.
json output_column(const json& task, const std::string& name, const char* unit, Noise noise) {
  if (noise == Noise::unstated) return {{"to", name}};
  const auto& sensor = task.at("sensor");
  return {{"to", name},
          {"noise",
           {{"white", fmt::format("{} {}", sensor.at("datasheet_noise_rms").get<double>(), unit)},
            {"resolution", fmt::format("{} {}", sensor.at("lsb").get<double>(), unit)}}}};
}

std::string data_text(const Diagram& d, const json& task, const std::filesystem::path& folder, Noise noise) {
  const bool thermal = task.at("base") == "B5";
  json data;
  data["format"] = 1;
  for (const auto& name : d.inputs.names()) data["columns"][name] = {{"to", name}};
  if (!thermal) data["columns"]["T"] = {{"to", "T"}, {"optional", true}};  // not every rig logs it
  for (const auto& name : d.outputs.names())
    data["columns"][name] = output_column(task, name, thermal ? "K" : "um", noise);
  for (const auto& f : task.at("files"))
    data["recordings"].push_back({{"file", (folder / f.at("file").get<std::string>()).string()},
                                  {"role", f.at("role")},
                                  {"start", fmt::format("{} h", f.at("start_h").get<double>())},
                                  {"cycles_before", f.at("cycles_before")}});
  return data.dump(1);
}

}  // namespace

HiddenCase read_hidden_case(const std::string& folder, Noise noise) {
  const auto path = std::filesystem::absolute(folder).lexically_normal();
  const std::string file = (path / "task.json").string();
  const std::string text = read_file(file);
  try {
    const json task = json::parse(text);
    HiddenCase c;
    c.id = task.at("id").get<std::string>();
    c.base = task.at("base").get<std::string>();
    c.outputs = task.at("outputs").get<std::vector<std::string>>();
    c.diagram.title = "case " + c.id;
    c.diagram.inputs["u"].unit = "V";
    base_of(c.diagram, task);
    c.numbers_are_exact = task.value("base_parameters_exact", true);
    c.free_paths = free_paths(c.diagram, task);
    c.data_text = data_text(c.diagram, task, path, noise);
    return c;
  } catch (const json::exception& e) {
    fail("bad_case", file, fmt::format("this is no case of hidden effects: {}", e.what()),
         "compare it with the layout in the README of the set");
  }
}

const std::vector<std::string>& hidden_effect_names() {
  static const std::vector<std::string> names{
      "hysteresis",          "asymmetry",  "creep",     "rate_dependence",  "structural_resonance", "amplifier_lag",
      "slew_limit",          "saturation", "dead_time", "temperature_gain", "thermal_expansion",    "cross_coupling",
      "sensor_nonlinearity", "friction",   "backlash",  "stiffening",       "mains_interference",   "ageing",
      "initial_remanence",   "calibration"};
  return names;
}

}  // namespace hysteron
