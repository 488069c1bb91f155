// Decides how a diagram stands in one text with everything that it is made of - nested diagrams, parameter sets,
// recorded series -, bit for bit: for a program that is given no files (interop/fmi). Not for people: diagram_file.h.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/block/kernel.h"
#include "engine/diagram/diagram.h"
#include "engine/diagram/units.h"

namespace hysteron {

struct PackedDiagram {
  Diagram diagram{};
  std::vector<Unit> units{};  ///< that are not known without the table of units (engine/diagram/unit_table.h)
};

/// As JSON on one line. Where it was read from is left out; what --set gave stays known as such.
std::string packed_diagram(const PackedDiagram& packed);

/// What packed_diagram() wrote. Throws Error "damaged_file".
PackedDiagram unpacked_diagram(std::string_view text);

/// The diagram with all that it needs on a machine that has nothing of it. `blocks` makes the registry: what it reads
/// of units is packed, too.
std::string exported_program(const Diagram& diagram, Registry (*blocks)());

/// By this a packed text is known again.
std::string packed_token(std::string_view text);

}  // namespace hysteron
