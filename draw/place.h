// Decides what stands in each column of a sheet, from top to bottom. Internal to lay_out (layout.h).
#pragma once

#include <vector>

#include "draw/columns.h"

namespace hysteron::draw {

/// What stands in a column: an item, or the passage of a net on its way to a later column.
struct Cell {
  int item = -1;
  int net = -1;
  int column = 0;
  double y = 0;             ///< its line: middle of the symbol, or the wire
  double up = 0, down = 0;  ///< room above and below that line
};

/// The cells of all columns with their heights.
std::vector<std::vector<Cell>> place_rows(const Sheet& sheet, const std::vector<Net>& nets);

}  // namespace hysteron::draw
