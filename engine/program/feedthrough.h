// Decides which outputs of a block depend at the same instant on which of its inputs, entry by entry. Internal to the
// engine.
#pragma once

#include <vector>

#include "engine/program/program.h"

namespace hysteron {

/// By rows, one per output, one column per input. Of a linear block the entries of its D as compiled that are not zero;
/// of any other block that feeds through, all.
std::vector<bool> feedthrough(const Program& program, int block);

/// Does some number of the loop depend on itself. Not so where it goes round by blocks alone: a state space model that
/// is closed over an output whose row of D is zero.
bool is_algebraic(const Program& program, const Loop& loop);

}  // namespace hysteron
