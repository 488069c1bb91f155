// Decides how variables of MATLAB go from the child process that read them to its parent (child_read.h).
// Internal to io.
#pragma once

#include "io/files/child_pipe.h"
#include "io/formats/mat_value.h"

namespace hysteron {

void put(PipeWriter& to, const MatVariables& variables);
void take(PipeReader& from, MatVariables& variables);

}  // namespace hysteron
