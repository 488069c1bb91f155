// Decides how a changed diagram reaches the disk: with the nested diagrams that changed, or only as text.
// Does not change diagrams.
#pragma once

#include "app/cli/answer.h"
#include "io/results/result_diagram.h"

namespace hysteron {

/// A diagram as the file that an answer writes: its relative paths are seen from there.
WrittenFile diagram_file(const std::string& file, const Diagram& diagram);

/// Adds to the answer what "-o" asks for: the diagram, and its changed nested diagrams beside it; without -o how to
/// write it.
void rewrite(Answer& answer, const Arguments& arguments, const Diagram& diagram, const NestedDiagrams& nested);

}  // namespace hysteron
