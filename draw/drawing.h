// Decides what one gets who asks for the picture of a diagram: an SVG in which a control engineer recognizes it.
// Does not compile diagrams, nor read or write files.
#pragma once

#include <string>
#include <vector>

#include "draw/moved.h"
#include "engine/block/kernel.h"
#include "engine/program/program.h"

namespace hysteron {

struct DrawOptions {
  int depth = 0;  ///< how many levels of nested diagrams are opened; 0 = each is one box
  /// Paths of blocks that are new: set off in colour, with the word above them. One inside a closed box marks the box.
  std::vector<std::string> added{};
  draw::Places places{};  ///< where the user put blocks of the diagram itself
};

/// The picture as an SVG document that needs no other file. The same diagram gives the same text.
/// `program`: the diagram compiled; it lends the units of the signals.
/// Throws Error "unknown_block", "unknown_signal" for a diagram that does not compile, and "no_graphviz" where the
/// program dot, which orders the blocks, cannot be run.
std::string diagram_svg(const Diagram& diagram, const Program& program, const Registry& registry,
                        const DrawOptions& options = {});

}  // namespace hysteron
