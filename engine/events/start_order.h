// Decides in which order blocks that switch settle at the start: each once those have settled that stand before it
// along the wires. Hysteresis would else keep what it saw of a signal that was not settled yet.
#pragma once

#include <vector>

#include "engine/program/program.h"

namespace hysteron {

/// Per block of program.modal_blocks: how many blocks with modes or a past stand before it at most, on wires through
/// blocks whose outputs follow their inputs at the start. Loops count up to a hundred times.
std::vector<int> start_ranks(const Program& program);

}  // namespace hysteron
