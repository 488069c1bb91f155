// Decides where a parameter may be infinite: where its block has finite values nevertheless, as one without a limit
// has. Does not decide ranges: those stand in the declarations. A stage of compile().
#pragma once

#include "engine/program/program.h"

namespace hysteron {

/// Throws Error "bad_value" for every infinite parameter (and any behind a dead time) with which outputs or derivatives
/// of its block are not finite at the start: an amplitude, a gain, but no limit of a saturation.
void check_infinite(const Program& program, const Run& run);

}  // namespace hysteron
