// Decides which block types can be written in C: those whose source defines `CLaw name_c() {`. Does not write them
// (export/).
#pragma once

#include <vector>

#include "engine/block/c_law.h"

namespace hysteron {

/// What a block type is in C; null where its source says nothing of it.
const CLaw* find_c_law(const std::string& type);

namespace blocks {
/// The build writes this list (blocks/CMakeLists.txt).
std::vector<CLaw (*)()> c_law_functions();
}  // namespace blocks

}  // namespace hysteron
