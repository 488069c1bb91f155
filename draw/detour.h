// Decides the way of a wire between blocks that stand anywhere: level and upright pieces around all blocks, short, with
// few bends, not along other wires and across few of them. Does not move blocks.
#pragma once

#include <set>

#include "draw/sheet.h"

namespace hysteron::draw {

/// New ways for these wires of the sheet; those of one output may share pieces.
void lead_anew(Sheet& sheet, const std::set<int>& wires);

}  // namespace hysteron::draw
