// Decides how a diagram stands in a folder of results: its paths are seen from there, nested diagrams that changed lie
// beside it.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "engine/diagram/diagram.h"

namespace hysteron {

/// Nested diagrams that changed: file name as written in the diagram, and content (discover/placement/add.h).
using NestedDiagrams = std::vector<std::pair<std::string, Diagram>>;

/// The text of a diagram for a file inside a folder of results: its paths are seen from there.
/// Nested diagrams that changed are expected beside it, under their bare file names.
std::string text_in_folder(const Diagram& diagram, const std::string& folder, const std::string& name,
                           const NestedDiagrams& nested = {});
/// The name under which a changed nested diagram lies in a folder of results.
std::string name_in_folder(const std::string& written);

}  // namespace hysteron
