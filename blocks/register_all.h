// Decides which block types there are. Does not decide what they do.
#pragma once

#include "engine/block/kernel.h"

namespace hysteron {

/// Every block type, in the order in which the documentation shows them; "input" is for inputs of a diagram.
Registry all_blocks();

}  // namespace hysteron
