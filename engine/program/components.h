// Decides which nodes of a directed graph need each other: its strongly connected components, by Tarjan's algorithm
// (SIAM J. Comput. 1 (1972) 146-160). Does not know what the nodes are.
#pragma once

#include <vector>

namespace hysteron {

/// The components, each behind all that its nodes need; a node that needs no other is one of its own. needs[i]: the
/// nodes that node i needs (itself and repetitions allowed). Iterative: a chain of 100 000 nodes does not overflow the
/// stack.
std::vector<std::vector<int>> strong_components(const std::vector<std::vector<int>>& needs);

}  // namespace hysteron
