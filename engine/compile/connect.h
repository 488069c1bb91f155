// Decides which output every input of the leaf blocks reads, and what the names of outputs, records and places mean.
// Does not decide what a name means (scopes.h). Internal to wire_diagram().
#pragma once

#include <string>
#include <vector>

#include "engine/compile/flatten.h"
#include "engine/compile/scopes.h"

namespace hysteron {

/// A signal that enables or triggers, read where the nested diagram stands.
struct EnablingWire {
  int leaf = -1, scope = -1;
  std::string from, place;
  int outer = -1;  ///< the block that enables the diagram around it, if any
};

/// Fills in the wires of the blocks of `wired`, its outputs, record and places. `gaps`: of a draft, which gets the ends
/// that are missing, else null. Problems go to `problems`.
void connect(Scopes& scopes, const std::vector<EnablingWire>& enabling_wires, Gaps* gaps, WiredDiagram& wired,
             Problems& problems);

}  // namespace hysteron
