// Decides where everything stands on a sheet: columns from left to right, rows, wires.
// The order within the columns is Graphviz's; columns, straight lines and wires are ours, so that a loop looks like a
// loop: feedback returns below, a sum takes it from below, and arrows end on the borders of the symbols.
#pragma once

#include "draw/sheet.h"

namespace hysteron::draw {

/// All of it, for the sheet and the open diagrams in it.
void lay_out(Sheet& sheet);

}  // namespace hysteron::draw
