// Decides how Graphviz is asked: its program dot, as a child process, for the order and the heights of cells.
// Does not route: wires are ours (route.cpp), so that arrows end where a port is.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace hysteron::draw {

struct DotEdge {
  int from = 0, to = 0;
  int weight = 1;
};

/// Heights [px, downwards, middle of each cell] for cells of these heights in a layered drawing from left to right.
/// What was asked before is answered without dot. Throws Error "no_graphviz" if dot cannot be run, "graphviz_failed" if
/// it refuses.
std::vector<double> heights_by_dot(const std::vector<double>& cell_heights, const std::vector<DotEdge>& edges);

}  // namespace hysteron::draw
