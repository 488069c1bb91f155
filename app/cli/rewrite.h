// Decides how a changed diagram reaches the disk: with the nested diagrams that changed, or only as text.
// Does not change diagrams.
#pragma once

#include "app/cli/verb.h"
#include "io/results/result_diagram.h"

namespace hysteron {

/// Writes the diagram to "-o" (and its changed nested diagrams beside it) and says so; without -o says how to write it.
void rewrite(const Arguments& arguments, const Diagram& diagram, const NestedDiagrams& nested);

}  // namespace hysteron
