// Decides which kinds of places diagrams and effects may name. Where these are: discover/placement.
#pragma once

#include <string>
#include <vector>

namespace hysteron {

/// In the order in which places are looked for.
inline const std::vector<std::string> place_kinds{"command", "core", "force", "motion", "measured", "damping"};

}  // namespace hysteron
