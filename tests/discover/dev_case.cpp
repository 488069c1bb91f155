#include "tests/discover/dev_case.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "benchmarks/hidden_case.h"
#include "tests/io/temporary_folder.h"

namespace hysteron::testing {
namespace {

using nlohmann::json;

json read_json(const std::string& file) {
  std::ifstream in(file);
  return json::parse(in);
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
  const TemporaryFolder folder;
  return read_dataset(folder.write(name + ".json", text), {shared("")});
}

Case dev_case(const std::string& id) {
  const HiddenCase hidden = read_hidden_case(shared("hidden-effects/dev/" + id));
  return {hidden.diagram, data_from_json("dev_" + id, hidden.data_text), hidden.numbers_are_exact};
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
