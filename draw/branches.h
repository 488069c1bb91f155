// Decides where a dot says that wires are joined. Does not draw it.
#pragma once

#include <vector>

#include "draw/sheet.h"

namespace hysteron::draw {

/// Points at which wires of one signal part: three or more directions lead away from there. From left to right.
std::vector<Point> branches_of(const Sheet& sheet);

}  // namespace hysteron::draw
