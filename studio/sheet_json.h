// Decides how a sheet of draw/ stands in JSON for the page: items with their symbols and ports, wires with their ways.
// Does not lay anything out.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "draw/sheet.h"

namespace hysteron::studio {

/// {"width", "height", "items", "wires", "dots"}; the sheets of open diagrams stand in their items as "inside".
nlohmann::ordered_json sheet_json(const draw::Sheet& sheet);

/// {"path", "name", "type", "x", "y", "width", "height", "symbol", "in", "out", "caption", "tip", "choice", "inside"}
nlohmann::ordered_json item_json(const draw::Item& item);

}  // namespace hysteron::studio
