// Decides what memory is at the start of a run whose input has a past: a sequence of values, walked from one to the
// next before the start (ENGINE 4). Time plays no part: memory and rate-independent laws see the way only.
#pragma once

#include "engine/diagram.h"
#include "engine/program.h"

namespace hysteron {

/// The pasts that a diagram states, block by block. Throws Error with all problems: "unknown_block", "no_memory",
/// "wrong_unit".
std::vector<Past> pasts_of(const SimulateSettings& settings, const Program& program);

/// Walks the first input of a block through its past, from the state that the run has now.
void walk(const Program& program, Run& run, const Past& past);

}  // namespace hysteron
