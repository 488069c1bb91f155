#include "tests/reference/random_diagram.h"

#include <map>
#include <nlohmann/json.hpp>

#include "tests/reference/generator.h"

namespace reference {
namespace {

/// Names and wires of a diagram, written anew by a map of its names.
std::string renamed(const std::string& signal, const std::map<std::string, std::string>& names) {
  const auto dot = signal.find('.');
  const auto at = names.find(signal.substr(0, dot));
  if (at == names.end()) return signal;
  return dot == std::string::npos ? at->second : at->second + signal.substr(dot);
}

void in_other_order(Json& diagram, std::uint64_t seed) {
  Random random(seed + 77);
  std::vector<std::string> order;
  for (const auto& [name, block] : diagram["blocks"].items()) order.push_back(name);
  for (std::size_t i = order.size(); i > 1; --i)
    std::swap(order[i - 1], order[static_cast<std::size_t>(random.below(static_cast<int>(i)))]);
  std::map<std::string, std::string> names;
  for (std::size_t i = 0; i < order.size(); ++i)
    names[order[i]] = std::string(1, static_cast<char>('a' + i % 26)) + (i < 26 ? "_" : "__");
  Json blocks = Json::object();
  for (const auto& name : order) {
    Json block = diagram["blocks"][name];
    if (block.contains("in") && block["in"].is_string()) block["in"] = renamed(block["in"], names);
    if (block.contains("in") && block["in"].is_array())
      for (auto& wire : block["in"]) wire = renamed(wire, names);
    blocks[names[name]] = block;
  }
  diagram["blocks"] = blocks;
  for (auto& signal : diagram["record"]) signal = renamed(signal, names);
}

}  // namespace

RandomDiagram random_diagram(std::uint64_t seed, const Variant& variant) {
  RandomDiagram made = Generator(seed).make();
  Json diagram = Json::parse(made.text);
  if (variant.other_order) in_other_order(diagram, seed);
  if (variant.until > 0) diagram["simulate"]["until"] = with_unit(variant.until, "s");
  if (variant.every > 0) diagram["simulate"]["every"] = with_unit(variant.every, "s");
  Json solver = Json::object();
  if (!variant.method.empty()) solver["method"] = variant.method;
  if (variant.tolerance > 0) solver["relative_tolerance"] = variant.tolerance;
  if (!solver.empty()) diagram["simulate"]["solver"] = solver;
  made.text = diagram.dump(1);
  return made;
}

}  // namespace reference
