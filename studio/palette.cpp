#include "studio/palette.h"

#include <nlohmann/json.hpp>

#include "draw/sheet.h"
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

}  // namespace hysteron::studio
