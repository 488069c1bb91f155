// Decides the diagram that undoes another one: from the wanted output back to the input, block after block. Does not
// write C.
#pragma once

#include <string>
#include <vector>

#include "engine/diagram/diagram.h"
#include "engine/program/program.h"

namespace hysteron {

struct InverseDiagram {
  Diagram diagram;
  std::vector<std::string> inputs;  ///< per input: the signal or input of the model that it is
  std::vector<std::string> told;    ///< what the inverse leaves to others: "mechanics: only its gain at rest is undone"
};

/// The inverse of `model` between its one output and the input `input` ("": its only one); other inputs stay inputs.
/// Along the way laws of hysteresis become the blocks that their sources name (CLaw::inverse_type), gains and offsets
/// their reciprocals, linear laws with a direct path (creep) the linear laws that undo them, others (a resonance, a
/// lag) their gain at rest, which is told. `program`: `model`, compiled. `period` [s]: of the sampled inverses; 0: not
/// said. Throws Error "no_inverse" with every block that has none, "no_rate".
InverseDiagram inverse_diagram(const Diagram& model, const Program& program, const Registry& registry,
                               const std::string& input, double period);

}  // namespace hysteron
