#include "tests/discover/dev_case.h"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

namespace hysteron::testing {
namespace {

using nlohmann::json;

json read_json(const std::string& file) {
  std::ifstream in(file);
  return json::parse(in);
}

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

}  // namespace

std::string shared(const std::string& path) { return std::string(HYSTERON_SHARED_DIR) + "/" + path; }
bool shared_is_there() { return std::filesystem::is_directory(shared("hidden-effects/dev")); }

DataSet data_from_json(const std::string& name, const std::string& text) {
  const auto folder = std::filesystem::temp_directory_path() / fmt::format("hysteron_discover_{}", getpid());
  std::filesystem::create_directories(folder);
  const auto file = folder / (name + ".json");
  std::ofstream(file) << text;
  return read_dataset(file.string(), {shared("")});
}

namespace {

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
  heater_and_mass(d, p);
}

}  // namespace

Case dev_case(const std::string& id) {
  const std::string folder = shared("hidden-effects/dev/" + id);
  const json task = read_json(folder + "/task.json");
  Case c;
  c.diagram.title = "case " + id;
  c.diagram.inputs["u"].unit = "V";
  base_of(c.diagram, task);
  json data;
  data["format"] = 1;
  const auto& names = c.diagram.outputs.names();
  for (const auto& name : c.diagram.inputs.names()) data["columns"][name] = {{"to", name}};
  if (task.at("base") != "B5") data["columns"]["T"] = {{"to", "T"}};
  const std::string unit = task.at("base") == "B5" ? "K" : "um";
  for (const auto& name : names)
    data["columns"][name] = {
        {"to", name},
        {"noise",
         {{"white", fmt::format("{} {}", task.at("sensor").at("datasheet_noise_rms").get<double>(), unit)},
          {"resolution", fmt::format("{} {}", task.at("sensor").at("lsb").get<double>(), unit)}}}};
  for (const auto& f : task.at("files")) {
    json r;
    r["file"] = folder + "/" + f.at("file").get<std::string>();
    r["role"] = f.at("role");
    r["start"] = fmt::format("{} h", f.at("start_h").get<double>());
    r["cycles_before"] = f.at("cycles_before");
    data["recordings"].push_back(r);
  }
  c.data = data_from_json("dev_" + id, data.dump(1));
  return c;
}

double noise_floor(const std::string& id) {
  const json known = read_json(shared("hidden-effects/dev/" + id + "/case.json"));
  const double si = known.at("base") == "B5" ? 1 : 1e-6;  // K, um
  return known.at("expected").at("noise_floor_rms").get<double>() * si;
}

Case piezo_stack() {
  Case c;
  Diagram& d = c.diagram;
  d.title = "piezo stack P-885.91, gain and offset";
  d.inputs["u"].unit = "V";
  DiagramParameter gain;
  gain.value = Value(in(12, "um/V"));
  gain.free = true;
  d.parameters["gain"] = gain;
  Node& stack = d.blocks["stack"];
  stack.type = "gain";
  stack.parameters["gain"] = Value(Reference{"gain"});
  stack.in = {{"", "u"}};
  d.outputs["y"] = "stack";
  const std::string folder = shared("measured/piezo-stack-p885");
  c.data = data_from_json("piezo_stack", fmt::format(R"({{"format": 1,
  "columns": {{"u": {{"to": "u"}}, "y": {{"to": "y", "zero": "per_recording", "delay": "1 sample"}}}},
  "recordings": [{{"file": "{0}/train_sine_1Hz.csv", "role": "train", "skip": "2 s"}},
                 {{"file": "{0}/test_varying_amplitude.csv", "role": "validate", "skip": "2 s", "until": "37 s"}}]}})",
                                                     folder));
  return c;
}

Case heater() {
  Case c;
  Diagram& d = c.diagram;
  d.title = "one heater, first order";
  d.inputs["u1"].unit = "%";
  const auto parameter = [&](const char* name, Number value, std::optional<Number> low, std::optional<Number> high) {
    DiagramParameter p;
    p.value = Value(std::move(value));
    p.lower = std::move(low);
    p.upper = std::move(high);
    p.free = true;
    d.parameters[name] = p;
  };
  parameter("gain", in(0.5, "K/%"), {}, {});
  parameter("time_constant", in(100, "s"), in(5, "s"), in(2000, "s"));
  parameter("ambient", in(26, "degC"), {}, {});
  // K, not degC: what the heater adds is a difference.
  Node& heater = d.blocks["heater"];
  heater.type = "gain";
  heater.parameters["gain"] = Value(Reference{"gain"});
  heater.in = {{"", "u1"}};
  Node& plant = d.blocks["plant"];
  plant.type = "lag";
  plant.parameters["times"] = Value(Reference{"time_constant"});
  plant.in = {{"", "heater"}};
  Node& room = d.blocks["room"];
  room.type = "constant";
  room.parameters["value"] = Value(Reference{"ambient"});
  Node& sensor = d.blocks["sensor"];
  sensor.type = "sum";
  sensor.in = {{"", "plant"}, {"", "room"}};
  d.outputs["T1"] = "sensor";
  c.data = data_from_json(
      "heater",
      fmt::format(
          R"({{"format": 1, "columns": {{"u1": {{"to": "u1", "between_samples": "hold"}}, "T1": {{"to": "T1"}}}},
  "recordings": [{{"file": "{}/one_heater_steps.csv", "role": "train"}}]}})",
          shared("measured/thermal-tclab")));
  return c;
}

}  // namespace hysteron::testing
