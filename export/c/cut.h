// Decides which part of a diagram becomes a diagram of its own: what leads from some of its signals to others. Does not
// decide what is done with it.
#pragma once

#include <string>
#include <vector>

#include "engine/block/kernel.h"
#include "engine/diagram/diagram.h"
#include "engine/program/program.h"

namespace hysteron {

/// The part of a diagram between signals.
struct CutDiagram {
  Diagram diagram;
  /// Per input: the signal that it was ("reference", "stage.y"), or the input of the whole diagram that it is.
  std::vector<std::string> inputs;
};

/// A diagram whose inputs are the signals `from` and those inputs of `whole` that are still needed, and whose outputs
/// are the signals or outputs `to`; none: those that `whole` has. Signals are those of the outermost level. `program`:
/// `whole`, compiled. Throws Error "unknown_signal", "no_output", "nothing_between".
CutDiagram cut_diagram(const Diagram& whole, const Program& program, const std::vector<std::string>& from,
                       const std::vector<std::string>& to);

}  // namespace hysteron
