// The generator: ways to write the same diagram.
#include <algorithm>
#include <cmath>

#include "tests/reference/generator.h"

namespace reference {

void Generator::choose_something() {
  if (!random.chance(0.25)) return;
  const std::string name = block_of_one_wire();
  if (name.empty()) return;
  const Json block = blocks[name];
  Json used = block;
  used.erase("in");
  blocks[name] = {{"choose", "used"}, {"in", block["in"]}, {"from", {{"other", used}, {"used", used}}}};
}

std::string Generator::block_of_one_wire() {
  std::vector<std::string> names;
  for (const auto& [name, block] : blocks.items())
    if (block.contains("type") && block.contains("in") && block["in"].is_string() && block["type"] != "diagram")
      names.push_back(name);
  return names.empty() ? "" : random.one_of(names);
}

void Generator::name_a_parameter() {
  parameters = Json::object();
  for (auto& [name, block] : blocks.items())
    for (auto& [key, value] : block.items()) {
      if (!value.is_number_float() || !random.chance(0.15)) continue;
      const std::string parameter = name + "_" + key;
      parameters[parameter] = {{"value", value}};
      value = "$" + parameter;
    }
}

void Generator::nest_something() {
  if (!random.chance(0.25)) return;
  const std::string name = block_of_one_wire();
  if (name.empty() || dimensioned.contains(name)) return;
  if (blocks[name]["type"].get<std::string>().starts_with("mass")) return;
  if (blocks[name]["type"].get<std::string>().starts_with("inertia")) return;
  Json inner = blocks[name];
  for (const auto& [key, value] : inner.items())
    if (value.is_string() && value.get<std::string>().starts_with("$")) return;
  const auto has_unit = [](const Json& value) {
    return value.is_string() && value.get<std::string>().find("1/s") != std::string::npos;
  };
  if (inner["type"] == "gain" && inner["gain"].is_string()) return;
  if (inner["type"] == "integrator" || std::any_of(inner.begin(), inner.end(), has_unit)) return;
  const Json in = inner["in"];
  if (blocks.contains(in.get<std::string>()) == false) return;
  inner["in"] = "u";
  const Json nested = {
      {"format", 1}, {"inputs", {{"u", Json::object()}}}, {"blocks", {{"law", inner}}}, {"outputs", {{"y", "law"}}}};
  files["inner.json"] = nested.dump(1);
  blocks[name] = {{"type", "diagram"}, {"file", "inner.json"}, {"in", in}};
}

RandomDiagram Generator::written() {
  Json diagram = {{"format", 1}};
  if (!parameters.empty()) diagram["parameters"] = parameters;
  diagram["blocks"] = blocks;
  diagram["record"] = Json::array();
  for (const auto& wire : wires) diagram["record"].push_back(wire.name);
  diagram["simulate"] = {{"until", with_unit(random.one_of<double>({1, 2, 3, 4}), "s")}, {"every", "10 ms"}};
  return {diagram.dump(1), files};
}

}  // namespace reference
