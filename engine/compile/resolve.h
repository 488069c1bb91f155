// Decides which number each parameter of a block gets. Internal to compile().
#pragma once

#include <string>
#include <vector>

#include "engine/compile/graph.h"

namespace hysteron {

/// The values of one block's parameters. Problems go to `problems` at `origin`.
std::vector<ResolvedParameter> resolve_parameters(const Scope& scope, const Node& node, const Declaration& declaration,
                                                  const std::string& origin, Ordered<GraphParameter>& parameters,
                                                  Problems& problems);

}  // namespace hysteron
