// Decides whether the sizes that stand in a MAT file of level 4 or 5 fit into it and into each other, so that no
// library is sent beyond its end or asks for memory that the file cannot fill. Does not read variables. Internal to io.
#pragma once

#include <string>

namespace hysteron {

bool mat4_fits(const std::string& file);
bool mat5_fits(const std::string& file);

}  // namespace hysteron
