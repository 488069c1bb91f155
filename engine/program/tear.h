// Decides at which nodes the cycles of a strongly connected graph are cut, and in what order its nodes then follow each
// other. Does not know what the nodes are.
#pragma once

#include <vector>

namespace hysteron {

struct Torn {
  std::vector<int> tears;  ///< nodes that are guessed, increasing
  std::vector<int> order;  ///< all nodes, each behind what it needs but for tears; the tears themselves last
};

/// `needs[i]`: the nodes that node i needs, itself perhaps among them. `cost[i]`: how many numbers a cut at i guesses.
/// `preferred[i]`: the user wants a cut there, and gets it. Few and cheap cuts by a greedy rule: strip what stands in
/// no cycle, cut the node with the most ways through it per number, begin again; last, take back every cut that turned
/// out not to be needed. Ties go to the smaller index, so the caller's order of nodes decides alone.
Torn tear(const std::vector<std::vector<int>>& needs, const std::vector<int>& cost, const std::vector<bool>& preferred);

}  // namespace hysteron
