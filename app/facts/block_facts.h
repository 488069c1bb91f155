// Decides what a block type says of itself to programs, and the shape of that. Does not know any block.
#pragma once

#include <string>
#include <vector>

#include "app/cli/shape.h"
#include "engine/block/block.h"

namespace hysteron {

/// "number", "list", "text", "matrix".
std::string kind_name(ParameterKind kind);

/// All that its declaration says.
Facts block_facts(const Declaration& d);

/// The members of block_facts().
std::vector<shape::Member> block_shape();

}  // namespace hysteron
