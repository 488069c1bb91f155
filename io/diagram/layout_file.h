// Decides how the places stand in a file to which blocks were moved by hand: beside the diagram, stage.layout.json for
// stage.json, so that moving one changes no line of the diagram. Does not draw.
#pragma once

#include <array>
#include <map>
#include <string>

namespace hysteron {

/// Upper left corners of blocks by their names, in steps of the grid of draw/moved.h.
using BlockPlaces = std::map<std::string, std::array<int, 2>>;

/// "stage.layout.json" of "stage.json".
std::string layout_file_of(const std::string& diagram_file);

/// {"format": 1, "blocks": {"motor": [12, -4]}}; none where there is no such file. Throws Error "bad_json",
/// "wrong_type".
BlockPlaces read_layout(const std::string& diagram_file);

/// The text of such a file, a line per block.
std::string layout_text(const BlockPlaces& places);

}  // namespace hysteron
