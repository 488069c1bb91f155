// Decides whether a verb may write one file where the user says: a recording or any other file that is not of the kind
// is never written over. Does not write it.
#pragma once

#include <string>
#include <vector>

#include "engine/diagram/diagram.h"

namespace hysteron {

/// Throws where `file`, named by `option`, has none of these endings. `what`: "an SVG file, e.g. -o stage.svg".
void need_ending(const std::string& option, const std::string& file, const std::vector<std::string>& endings,
                 const std::string& what);

/// Makes a folder for files; `cure`: what to do where that cannot be. Throws Error "cannot_write".
void make_folder(const std::string& folder, const std::string& cure);

/// Throws where a diagram must not go to `file`, named by `option`: another kind of file lies there, or one that
/// `diagram` is made of.
void check_diagram_target(const std::string& option, const std::string& file, const Diagram& diagram);

}  // namespace hysteron
