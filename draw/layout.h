// Decides where everything stands on a sheet: columns from left to right, rows, wires.
// The order within the columns is Graphviz's; columns, straight lines and wires are ours, so that a loop looks like a
// loop: feedback returns below, a sum takes it from below, and arrows end on the borders of the symbols.
#pragma once

#include <vector>

#include "draw/sheet.h"

namespace hysteron::draw {

/// What carries one signal: all wires from one output.
struct Net {
  int item = 0, out = 0;
  std::vector<int> wires{};
};

/// What stands in a column: an item, or the passage of a net on its way to a later column.
struct Cell {
  int item = -1;
  int net = -1;
  int column = 0;
  double y = 0;             ///< its line: middle of the symbol, or the wire
  double up = 0, down = 0;  ///< room above and below that line
};

/// columns.cpp: which wires are feedback, and the column of each item.
void find_feedback(Sheet& sheet);
void assign_columns(Sheet& sheet);
std::vector<Net> nets_of(const Sheet& sheet);

/// place.cpp: the cells of all columns, from top to bottom, with their heights.
std::vector<std::vector<Cell>> place_rows(const Sheet& sheet, const std::vector<Net>& nets);

/// route.cpp: the widths of columns and of the channels between them, places of items, paths of wires.
void route(Sheet& sheet, const std::vector<Net>& nets, const std::vector<std::vector<Cell>>& columns);

/// All of it, for the sheet and the open diagrams in it.
void lay_out(Sheet& sheet);

}  // namespace hysteron::draw
