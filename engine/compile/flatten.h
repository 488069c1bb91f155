// Decides what stands between the names of a diagram and its scalar signals: leaf blocks whose ports carry vectors.
// A scalar is a vector of length 1. Internal to the engine; build_graph() calls the stages one after the other.
//
//   wire_diagram   choices, nested diagrams, names: which port reads which
//   infer_lengths  how many elements every port carries
//   scalarize_vectors     one scalar signal per element: elementwise blocks become one block per element, rewirings
//   become
//                  one pass per element, so that an element depends on what it is made of and on nothing else
#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "engine/compile/graph.h"

namespace hysteron {

/// What a wire reads: an output port, or one element of it.
struct PortEnd {
  int block = -1, port = 0;
  int element = -1;             ///< -1 = all of them
  std::string name{}, place{};  ///< as written, and where (JSON pointer)
};

/// A leaf block before its vectors are taken apart.
struct WiredBlock {
  std::string path, origin;
  std::string place{};  ///< of its wires ("/blocks/a/in")
  const Kernel* kernel = nullptr;
  Shape shape{};
  Sizes sizes{};
  std::vector<ResolvedParameter> parameters{};
  SeriesPointer series{};
  int enabling = -1;  ///< into WiredDiagram::enablings
  Unit unit{};        ///< recorded: of the column; input of the diagram: as stated
  bool unit_known = false;
  int stated_length = 0;         ///< input of the diagram (0 = open)
  std::vector<PortEnd> wires{};  ///< in the order of the ports
  std::vector<int> port{};       ///< per wire: index of the declared port
  std::vector<int> lengths{};    ///< per output port, once inferred

  bool is_input() const { return kernel->declaration.type == "input"; }
  bool has_vector_ports() const { return kernel->declaration.has_vector_ports(); }
  bool is_elementwise() const { return kernel->declaration.is_elementwise; }
};

/// An input of a nested diagram that states its length: what is wired to it must have it.
struct StatedLength {
  PortEnd end;
  int length = 0;
  std::string name{};  ///< "stage/u"
};

struct WiredDiagram {
  std::vector<WiredBlock> blocks;
  std::vector<Enabling> enablings;                  ///< blocks: those above
  std::vector<KernelPointer> kernels;               ///< those that blocks have of their own
  std::vector<std::pair<std::string, int>> inputs;  ///< name, block
  std::vector<std::pair<std::string, int>> open;    ///< the same of the ends that a draft leaves open
  std::vector<std::string> left_out;                ///< of a draft: paths of blocks
  std::vector<std::pair<std::string, PortEnd>> outputs;
  std::vector<PortEnd> record, places_read;
  std::vector<StatedLength> stated;
  Ordered<GraphParameter> parameters;  ///< by their paths
  Ordered<std::vector<std::string>> places;

  /// Elements that a wire carries, once inferred.
  int length(const PortEnd& end) const {
    if (end.element >= 0) return 1;
    return blocks[static_cast<std::size_t>(end.block)].lengths[static_cast<std::size_t>(end.port)];
  }
};

/// flatten.cpp. Throws all problems of names, types, values and wires.
WiredDiagram wire_diagram(const Diagram& diagram, const Registry& registry);

/// What a draft lacks (draft.h).
struct Gaps {
  std::set<std::string> left_out;  ///< places of blocks (JSON pointers) that are not compiled
  std::set<std::string> open;  ///< ends that nothing is wired to, or a block that is left out: inputs of the program
  std::size_t size() const { return left_out.size() + open.size(); }
};

/// flatten.cpp. Wires what can be wired; what it finds to be missing beyond that goes into `gaps`, and then is only
/// whole when it is called again. Problems go into `problems`.
WiredDiagram wire_draft(const Diagram& diagram, const Registry& registry, Gaps& gaps, Problems& problems);

}  // namespace hysteron
