// Decides what may stand in a nested diagram that is switched off and on, or triggered. Internal to compile().
#pragma once

#include "engine/compile/graph.h"

namespace hysteron {

/// Throws Error "cannot_be_switched" that names every block whose law has no meaning there, with what to do instead.
void check_enabled(const Graph& graph);

}  // namespace hysteron
