// Decides what is told of a diagram that is still being written: what of it can be compiled, and all that is wrong,
// whatever the stage. compile() ends with the first stage that fails, since later ones build on it; here what is wrong
// is left out, and the stages go on with the rest.
#pragma once

#include <string>
#include <vector>

#include "engine/program/program.h"

namespace hysteron {

struct DraftProgram {
  /// Of the blocks in which nothing is wrong; null where there are none. An input that nothing is wired to ("lag.in"),
  /// or that reads a block which is left out ("lag"), is an input of the program, in the unit that its readers expect.
  ProgramPointer program{};
  std::vector<Problem> problems{};      ///< what is wrong, in the order of the stages
  std::vector<Problem> warnings{};      ///< what is unfinished: inputs that are not wired, blocks that nobody reads
  std::vector<std::string> left_out{};  ///< paths of blocks
};

/// The same program as compile() gives, with no problems and no warnings, where that does not throw.
DraftProgram compile_draft(const Diagram& diagram, const Registry& registry);
DraftProgram compile_draft(const Diagram& diagram,
                           Registry&& registry) = delete;  ///< a program does not keep its blocks

}  // namespace hysteron
