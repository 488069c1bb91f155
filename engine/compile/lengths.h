// Decides how many elements every port carries. Internal to compile().
#pragma once

#include "engine/compile/flatten.h"

namespace hysteron {

/// Throws Error "wrong_length", "bad_index" or "bad_value" naming both ends, both lengths and what fixed them.
void infer_lengths(WiredDiagram& diagram);

}  // namespace hysteron
