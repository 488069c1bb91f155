#include "engine/block/port_names.h"

namespace hysteron {

std::vector<std::string> output_names(const Declaration& declaration, const Node& node) {
  if (declaration.outputs.empty() || !declaration.outputs.front().variadic) return declaration.output_names();
  std::size_t count = 1;
  for (const auto& p : declaration.parameters)
    if (const Value* value = p.is_structural ? node.parameters.find(p.name) : nullptr)
      if (const auto* list = std::get_if<NumberList>(&value->content)) count = list->size();
  std::vector<std::string> names;
  for (std::size_t i = 0; i < count; ++i) names.push_back(declaration.outputs.front().name + std::to_string(i));
  return names;
}

}  // namespace hysteron
