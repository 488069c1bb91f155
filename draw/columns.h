// Decides in which column of a sheet each item stands. Internal to lay_out (layout.h).
#pragma once

#include <vector>

#include "draw/sheet.h"

namespace hysteron::draw {

/// What carries one signal: all wires from one output.
struct Net {
  int item = 0, out = 0;
  std::vector<int> wires{};
};

/// Marks the wires that are feedback.
void find_feedback(Sheet& sheet);
/// The column of each item: behind all that it reads but for feedback.
void assign_columns(Sheet& sheet);
std::vector<Net> nets_of(const Sheet& sheet);

}  // namespace hysteron::draw
