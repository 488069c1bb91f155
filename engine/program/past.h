// Decides what memory is at the start of a run where it is not virgin: given number by number, or left behind by a past
// of the input, a sequence of values that is walked from one to the next before the start. Time plays no
// part: memory and rate-independent laws see the way only.
#pragma once

#include "engine/diagram/diagram.h"
#include "engine/program/program.h"

namespace hysteron {

/// The memories and pasts that a diagram states, one entry per block. Throws Error with all problems: "unknown_block",
/// "no_memory", "wrong_unit", "wrong_length".
std::vector<Past> pasts_of(const SimulateSettings& settings, const Program& program);

/// Throws Error "bad_value" with all given memories that no past of the input could have left behind, for the
/// parameters of `run`.
void check_memories(const Program& program, const Run& run);

/// Gives a block its memory, if the past has one, then walks its first input through the values, from there.
void walk(const Program& program, Run& run, const Past& past);

}  // namespace hysteron
