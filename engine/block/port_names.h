// Decides what the output ports of a block as written are called: as declared, or y0, y1, ... where its parameters say
// how many there are (demux).
#pragma once

#include <string>
#include <vector>

#include "engine/block/declaration.h"
#include "engine/diagram/diagram.h"

namespace hysteron {

/// Names of the output ports of `node`, whose type is declared so. Where the number of ports cannot be read off (a
/// reference, nothing written), those of one.
std::vector<std::string> output_names(const Declaration& declaration, const Node& node);

}  // namespace hysteron
