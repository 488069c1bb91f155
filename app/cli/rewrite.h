// Decides how a changed diagram reaches the disk: with the nested diagrams that changed, or only as text.
// Does not change diagrams.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "app/cli/verb.h"
#include "engine/diagram/diagram.h"

namespace hysteron {

/// Nested diagrams that changed: file name as written in the diagram, and content (discover/placement/add.h).
using NestedDiagrams = std::vector<std::pair<std::string, Diagram>>;

/// Writes the diagram to "-o" (and its changed nested diagrams beside it) and says so; without -o says how to write it.
void rewrite(const Arguments& arguments, const Diagram& diagram, const NestedDiagrams& nested);

/// The text of a diagram for a file inside a folder of results: its paths are seen from there.
/// Nested diagrams that changed are expected beside it, under their bare file names.
std::string text_in_folder(const Diagram& diagram, const std::string& folder, const std::string& name,
                           const NestedDiagrams& nested = {});
/// The name under which a changed nested diagram lies in a folder of results.
std::string name_in_folder(const std::string& written);

}  // namespace hysteron
