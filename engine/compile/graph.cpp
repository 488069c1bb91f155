// Decides in which order a diagram becomes a graph of scalar signals: names and wires, lengths, elements.
// Does not look at units (unit_check.cpp) nor at the order of evaluation (order.cpp).
#include "engine/compile/graph.h"

#include "engine/compile/wired.h"

namespace hysteron {

Graph build_graph(const Diagram& diagram, const Registry& registry) {
  WiredDiagram wired = wire_diagram(diagram, registry);
  infer_lengths(wired);
  return take_apart(wired, registry);
}

}  // namespace hysteron
