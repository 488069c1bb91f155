// Decides which scalar signals and blocks the vectors of a diagram become. Internal to compile().
#pragma once

#include "engine/compile/flatten.h"

namespace hysteron {

Graph scalarize_vectors(WiredDiagram diagram, const Registry& registry);

}  // namespace hysteron
