// Decides how wide columns are, and which ways the wires go. Internal to lay_out (layout.h).
#pragma once

#include <vector>

#include "draw/place.h"

namespace hysteron::draw {

/// The widths of columns and of the channels between them, places of items, paths of wires.
void route(Sheet& sheet, const std::vector<Net>& nets, const std::vector<std::vector<Cell>>& columns);

/// A way without points that stand twice or on a straight piece.
std::vector<Point> simplified(const std::vector<Point>& path);

}  // namespace hysteron::draw
