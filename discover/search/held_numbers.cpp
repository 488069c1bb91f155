#include "discover/search/held_numbers.h"

#include <algorithm>
#include <vector>

#include "discover/models/parts.h"
#include "discover/search/search_state.h"
#include "discover/wiring/wiring.h"

namespace hysteron {
namespace {

/// "weights[2]" -> "weights".
std::string without_index(const std::string& name) { return name.substr(0, name.find('[')); }

/// Numbers of one block that have a size: not where a zero lies, not what cuts a range into parts, no clock.
bool has_a_size(const Declaration& d, const std::string& name) {
  const int i = d.parameter_index(name);
  if (i < 0 || (d.is_sampled && (name == "period" || name == "offset"))) return false;
  const ParameterDeclaration& p = d.parameters[static_cast<std::size_t>(i)];
  return !p.is_offset && !p.is_increasing && !p.is_structural;
}

/// Is it written, not a default, at this level of the diagram or of one inside it; numbers of effects were fitted, or
/// are the user's guess: the user is told that they are held.
bool is_written(const Diagram& diagram, const Registry& registry, const std::string& block, const std::string& name) {
  const auto slash = block.find('/');
  const std::string here = block.substr(0, slash);
  const Node* node = diagram.blocks.find(here);
  const Node* body = Wiring(diagram, registry).body(here);
  if (node == nullptr || body == nullptr) return false;
  if (!node->effect.empty()) body = node->from.find("off");  // what it varies is the user's
  if (body == nullptr) return false;
  if (slash != std::string::npos)
    return body->nested && is_written(*body->nested, registry, block.substr(slash + 1), name);
  return body->parameters.find(name) != nullptr || body->parameters_from_file.find(name) != nullptr;
}

bool is_measured(const SearchState& state, int block) {
  const Program& program = state.base_model->program();
  const auto& judged = state.base_model->outputs();
  const auto behind = outputs_behind(program, block);
  return std::any_of(behind.begin(), behind.end(), [&](int o) {
    return std::find(judged.begin(), judged.end(), program.output_names[static_cast<std::size_t>(o)]) != judged.end();
  });
}

}  // namespace

std::map<std::string, double> held_numbers(const SearchState& state) {
  std::map<std::string, double> numbers;
  const Program& program = state.base_model->program();
  const auto free = free_parameters(program, state.context.free_paths);
  for (std::size_t i = 0; i < program.parameters.size(); ++i) {
    const ParameterInfo& p = program.parameters[i];
    const bool is_free = std::any_of(free.begin(), free.end(),
                                     [&](const FreeParameter& f) { return f.parameter == static_cast<int>(i); });
    const bool from_elsewhere = p.offset || (!p.difference && p.unit.to_si(0) != 0);  // a zero, a temperature
    const bool is_exact = p.known_to && *p.known_to == 0;
    if (is_free || is_exact || p.value == 0 || p.block < 0 || from_elsewhere || !is_measured(state, p.block)) continue;
    const auto& block = program.blocks[static_cast<std::size_t>(p.block)];
    const Declaration& d = block.kernel->declaration;
    if (d.inputs.empty()) continue;
    const auto dot = p.path.rfind('.');
    if (dot != std::string::npos) {
      const std::string name = without_index(p.path.substr(dot + 1));
      if (!has_a_size(d, name) || !is_written(state.user, state.registry, block.path, name)) continue;
    }
    numbers[p.path] = p.value;
  }
  return numbers;
}

}  // namespace hysteron
