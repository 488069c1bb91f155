// Decides nothing: lets a test read a unit from the whole of udunits2's table, where parse_unit() would know it
// without.
#pragma once

#include <string_view>
#include <vector>

#include "engine/diagram/units.h"

namespace hysteron {

/// Scale 0 if the text is no unit.
Unit parse_unit_in_full_table(std::string_view text);

/// Symbols and prefixes that are known without the table.
std::vector<std::string> common_unit_symbols();
std::vector<std::string> common_unit_prefixes();

}  // namespace hysteron
