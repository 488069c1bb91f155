// Decides how two texts are shown side by side: the lines that differ with three lines around them, as `diff -u` does.
#pragma once

#include <string>

namespace hysteron {

/// Lines that differ between two texts, as in `diff -u` without headers.
std::string text_diff(const std::string& before, const std::string& after);

}  // namespace hysteron
