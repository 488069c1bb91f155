// Decides in which order a diagram becomes a graph of scalar signals: names and wires, lengths, elements.
// Does not look at units (unit_check.cpp) nor at the order of evaluation (order.cpp).
#include "engine/compile/graph.h"

#include "engine/compile/lengths.h"
#include "engine/compile/scalarize_vectors.h"

namespace hysteron {

Graph build_graph(const Diagram& diagram, const Registry& registry) {
  WiredDiagram flattened = wire_diagram(diagram, registry);
  infer_lengths(flattened);
  return scalarize_vectors(std::move(flattened), registry);
}

}  // namespace hysteron
