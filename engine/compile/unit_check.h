// Decides the dimension of every signal. Internal to compile().
#pragma once

#include "engine/compile/graph.h"

namespace hysteron {

/// Dimensions and units of all signals. Throws Error "wrong_unit" naming both ends.
void check_units(Graph& graph);

}  // namespace hysteron
