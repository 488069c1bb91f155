#include "studio/palette.h"

#include <nlohmann/json.hpp>

#include "draw/sheet.h"
#include "studio/mathml.h"
#include "studio/sheet_json.h"

namespace hysteron::studio {

nlohmann::ordered_json palette_symbols(const Registry& registry) {
  nlohmann::ordered_json symbols;
  for (const auto& type : registry.types()) {
    Diagram diagram;
    diagram.blocks[type].type = type;
    symbols[type] = item_json(draw::draft_sheet(diagram, nullptr, registry, 0).items.front());
  }
  return symbols;
}

nlohmann::ordered_json palette_laws(const Registry& registry) {
  nlohmann::ordered_json laws;
  for (const auto& type : registry.types()) {
    const Declaration& declaration = registry.find(type)->declaration;
    std::set<std::string> names;
    for (const auto* ports : {&declaration.inputs, &declaration.outputs})
      for (const auto& port : *ports) names.insert(port.name);
    for (const auto& parameter : declaration.parameters) names.insert(parameter.name);
    laws[type] = mathml_of(declaration.equation, names);
  }
  return laws;
}

}  // namespace hysteron::studio
