// Decides what becomes of a sheet whose blocks were moved by hand: these stand where they were put, all others where
// the layout has them, and wires that a moved block concerns find a new way around the blocks (detour.h).
#pragma once

#include <array>
#include <map>
#include <string>

#include "draw/sheet.h"

namespace hysteron::draw {

/// Positions by hand are multiples of it [px].
inline constexpr int grid = 4;

/// Upper left corners of symbols by the names of their items, in steps of the grid.
using Places = std::map<std::string, std::array<int, 2>>;

/// Moves the items of a sheet that lay_out() has laid out; names that are not there are left out. Wires of which an end
/// moved, or over which a block was moved, are led anew. A block comes down or up by less than half a step of the grid
/// where that makes a wire straight. The sheet may then reach to the left of 0 or above it.
void move_items(Sheet& sheet, const Places& places);

/// Everything so far to the right and down that the sheet begins at its margin; its size.
void shift_to_corner(Sheet& sheet);

}  // namespace hysteron::draw
