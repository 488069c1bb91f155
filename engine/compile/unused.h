// Decides what in a diagram nobody reads. Internal to compile().
#pragma once

#include <string>
#include <vector>

#include "engine/diagram/diagram.h"
#include "engine/diagram/error.h"

namespace hysteron {

struct ScopeOfNames {
  const Diagram* diagram = nullptr;
  std::string origin;             ///< JSON pointer of the block that holds it, "" at the top
  std::vector<std::string> used;  ///< blocks that a wire from elsewhere reads
};
/// Problems name blocks, inputs and parameters that no wire, output or other text names.
void check_unused(const std::vector<ScopeOfNames>& scopes, Problems& problems);

/// The name of a block or input at the head of a wire: "stage" of "stage.y[1]", "stage/play".
std::string head_of_wire(const std::string& wire);

}  // namespace hysteron
