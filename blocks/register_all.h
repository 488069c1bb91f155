// Decides which block types there are: those that a header of blocks/ROOM declares. Does not decide what they do.
#pragma once

#include <vector>

#include "engine/block/kernel.h"

namespace hysteron {

/// Every block type, in the order in which the documentation shows them; "input" is for inputs of a diagram.
Registry all_blocks();

namespace blocks {
/// The functions that make them, each declared as `Kernel name_block();`. The build writes this list
/// (blocks/CMakeLists.txt).
std::vector<Kernel (*)()> block_functions();
}  // namespace blocks

}  // namespace hysteron
