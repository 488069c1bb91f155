// Decides what in a diagram nobody reads: blocks, inputs, parameters. What an unchosen candidate of a choice names
// counts as read.
#include "engine/compile/unused.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace hysteron {
namespace {

void collect_references(const Node& node, std::set<std::string>& wires, std::set<std::string>& references) {
  for (const auto& wire : node.in) wires.insert(head_of_wire(wire.from));
  if (node.runs)
    for (const auto& wire : {node.runs->enable, node.runs->trigger}) wires.insert(head_of_wire(wire));
  for (const auto* values : {&node.parameters, &node.parameters_from_file})
    for (const auto& [name, value] : *values)
      if (const auto* r = std::get_if<Reference>(&value.content)) references.insert(r->name);
  for (const auto& [name, candidate] : node.from) collect_references(candidate, wires, references);
}

void check_scope(const ScopeOfNames& scope, bool is_top, Problems& problems) {
  const Diagram& diagram = *scope.diagram;
  const std::set<std::string> used(scope.used.begin(), scope.used.end());
  std::set<std::string> wires;
  std::set<std::string> references;
  for (const auto& [name, node] : diagram.blocks) collect_references(node, wires, references);
  for (const auto& [name, p] : diagram.parameters)
    if (const auto* r = std::get_if<Reference>(&p.value.content)) references.insert(r->name);
  for (const auto& [name, signal] : diagram.outputs) wires.insert(head_of_wire(signal));
  for (const auto& signal : diagram.record) wires.insert(head_of_wire(signal));
  const bool keeps_nothing = diagram.outputs.empty() && diagram.record.empty() && is_top;
  for (const auto& name : diagram.blocks.names())
    if (!keeps_nothing && !wires.contains(name) && !used.contains(name))
      problems.add("unused_block", scope.origin + "/blocks/" + name,
                   fmt::format("block \"{}\" is not used: nothing reads its outputs", name),
                   "wire it, record it, make it an output, or remove it");
  for (const auto& name : diagram.inputs.names())
    if (!wires.contains(name))
      problems.add("unused_input", scope.origin + "/inputs/" + name, fmt::format("input \"{}\" is not used", name),
                   "wire it or remove it");
  for (const auto& name : diagram.parameters.names())
    if (!references.contains(name))
      problems.add("unused_parameter", scope.origin + "/parameters/" + name,
                   fmt::format("parameter \"{}\" is not used", name),
                   fmt::format("refer to it as \"${}\" or remove it", name));
}

}  // namespace

std::string head_of_wire(const std::string& wire) { return wire.substr(0, wire.find_first_of("./[")); }

void check_unused(const std::vector<ScopeOfNames>& scopes, Problems& problems) {
  for (std::size_t s = 0; s < scopes.size(); ++s) check_scope(scopes[s], s == 0, problems);
}

}  // namespace hysteron
