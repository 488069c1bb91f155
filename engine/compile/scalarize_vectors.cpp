// Decides which scalar signals and blocks the vectors of a diagram become. Element k of the signal "tilt" is the signal
// "tilt[k]", element k of an elementwise block "lag" the block "lag[k]" with the parameters of "lag". A rewiring (mux,
// demux, select) becomes one pass per element: each keeps its own unit and smoothness, and a loop through one element
// is no loop through the others.
#include "engine/compile/scalarize_vectors.h"

#include <fmt/format.h>

#include "engine/diagram/index.h"

namespace hysteron {
namespace {

std::string indexed(const std::string& path, int length, int element) {
  return length == 1 ? path : fmt::format("{}[{}]", path, element);
}

class Apart {
 public:
  Apart(WiredDiagram diagram, const Registry& registry) : d_(std::move(diagram)), pass_(registry.find("pass")) {}

  Graph run() {
    graph_.blocks.reserve(d_.blocks.size());
    graph_.signals.reserve(d_.blocks.size());
    first_.reserve(d_.blocks.size());
    for (std::size_t b = 0; b < d_.blocks.size(); ++b) add_signals(static_cast<int>(b));
    for (std::size_t b = 0; b < d_.blocks.size(); ++b) wire(static_cast<int>(b));
    for (const auto& [name, b] : d_.inputs) {
      name_elements(name, b, graph_.inputs);
      graph_.input_units.resize(graph_.inputs.size(), d_.blocks[at(b)].unit);
    }
    for (const auto& [name, b] : d_.open) name_elements(name, b, graph_.open);
    for (const auto& [name, end] : d_.outputs)
      for (int k = 0; k < d_.length(end); ++k)
        graph_.outputs.emplace_back(indexed(name, d_.length(end), k), element(end, k));
    for (const auto& end : d_.record)
      for (int k = 0; k < d_.length(end); ++k) graph_.record.push_back(element(end, k));
    graph_.enablings = d_.enablings;
    for (auto& enabling : graph_.enablings) enabling.block = graph_.signals[at(signal(enabling.block, 0, 0))].block;
    graph_.kernels = d_.kernels;
    for (const auto& [path, parameter] : d_.parameters) graph_.parameters.push_back(parameter);
    graph_.places = d_.places;
    return std::move(graph_);
  }

 private:
  void name_elements(const std::string& name, int input, std::vector<std::pair<std::string, int>>& list) const {
    const int n = d_.blocks[at(input)].lengths[0];
    for (int k = 0; k < n; ++k) list.emplace_back(indexed(name, n, k), signal(input, 0, k));
  }
  int signal(int block, int port, int element) const { return first_[at(block)][at(port)][at(element)]; }
  int element(const PortEnd& end, int k) const {
    return signal(end.block, end.port, end.element >= 0 ? end.element : k);
  }

  /// "stage" where there is one output, "stage.y" where there are several.
  static std::string port_path(const WiredBlock& own, int port, bool always) {
    const auto& declared = own.kernel->declaration.outputs;
    if (declared.front().variadic) return fmt::format("{}.{}{}", own.path, declared.front().name, port);
    return always || declared.size() > 1 ? own.path + "." + declared[at(port)].name : own.path;
  }

  /// `own` hands over its values where it becomes one block.
  GraphBlock block_of(WiredBlock& own, const std::string& path, bool one) const {
    GraphBlock b;
    b.path = path;
    b.owner = own.path;
    b.origin = own.origin;
    b.kernel = own.kernel;
    b.shape = one ? std::move(own.shape) : own.shape;
    b.sizes = one ? std::move(own.sizes) : own.sizes;
    b.parameters = one ? std::move(own.parameters) : own.parameters;
    b.series = own.series;
    b.enabling = own.enabling;
    b.unit_known = own.unit_known;
    b.first_signal = static_cast<int>(graph_.signals.size());
    return b;
  }

  void add_signal(const WiredBlock& own, int port, int element) {
    const int n = own.lengths[at(port)];
    SignalInfo s;
    s.path = indexed(port_path(own, port, false), n, element);
    s.port_path = indexed(port_path(own, port, true), n, element);
    s.block = static_cast<int>(graph_.blocks.size());
    s.unit = own.unit;
    if (own.is_input()) s.dimension = own.unit.dimension;
    first_.back()[at(port)].push_back(static_cast<int>(graph_.signals.size()));
    graph_.signals.push_back(std::move(s));
  }

  /// Blocks and signals, in the order of the diagram; wires come when all signals are known.
  void add_signals(int b) {
    WiredBlock& own = d_.blocks[at(b)];
    const int ports = static_cast<int>(own.lengths.size());
    first_.emplace_back(own.lengths.size());
    if (!own.sizes.route.empty()) {
      for (int p = 0; p < ports; ++p)
        for (int k = 0; k < own.lengths[at(p)]; ++k) {
          GraphBlock one = block_of(own, indexed(port_path(own, p, false), own.lengths[at(p)], k), false);
          one.kernel = pass_;
          one.parameters.clear();
          one.shape = Shape{};
          one.shape.declaration = &pass_->declaration;
          one.shape.inputs = 1;
          one.sizes = pass_->sizes(one.shape);
          one.output = {{0, -1}};
          add_signal(own, p, k);
          graph_.blocks.push_back(std::move(one));
        }
    } else if (own.has_vector_ports()) {
      GraphBlock whole = block_of(own, own.path, true);
      for (int p = 0; p < ports; ++p)
        for (int k = 0; k < own.lengths[at(p)]; ++k) {
          whole.output.push_back({p, own.kernel->declaration.outputs[at(p)].is_vector ? k : -1});
          add_signal(own, p, k);
        }
      graph_.blocks.push_back(std::move(whole));
    } else {
      const int n = own.lengths.front();  // more than one: elementwise, or an input of the diagram
      for (int k = 0; k < n; ++k) {
        GraphBlock one = block_of(own, indexed(own.path, n, k), n == 1);
        for (int p = 0; p < ports; ++p) {
          one.output.push_back({p, -1});
          add_signal(own, p, k);
        }
        graph_.blocks.push_back(std::move(one));
      }
    }
  }

  GraphBlock& made(int b, int port, int k) { return graph_.blocks[at(graph_.signals[at(signal(b, port, k))].block)]; }

  void wire(int b) {
    const WiredBlock& own = d_.blocks[at(b)];
    if (!own.sizes.route.empty()) return wire_routes(b);
    if (own.has_vector_ports()) {
      GraphBlock& whole = made(b, 0, 0);
      for (std::size_t w = 0; w < own.wires.size(); ++w)
        for (int k = 0; k < d_.length(own.wires[w]); ++k) {
          whole.source.push_back(element(own.wires[w], k));
          whole.input.push_back({own.port[w], own.kernel->declaration.inputs[at(own.port[w])].is_vector ? k : -1});
        }
      return;
    }
    for (int k = 0; k < own.lengths.front(); ++k) {
      GraphBlock& one = made(b, 0, k);
      for (std::size_t w = 0; w < own.wires.size(); ++w) {
        one.source.push_back(element(own.wires[w], d_.length(own.wires[w]) == 1 ? 0 : k));
        one.input.push_back({own.port[w], -1});
      }
    }
  }

  void wire_routes(int b) {
    const WiredBlock& own = d_.blocks[at(b)];
    std::vector<int> sources;
    for (const auto& end : own.wires)
      for (int k = 0; k < d_.length(end); ++k) sources.push_back(element(end, k));
    std::size_t next = 0;
    for (int p = 0; p < static_cast<int>(own.lengths.size()); ++p)
      for (int k = 0; k < own.lengths[at(p)]; ++k) {
        GraphBlock& one = made(b, p, k);
        one.source = {sources[at(own.sizes.route[next++])]};
        one.input = {{0, -1}};
      }
  }

  WiredDiagram d_;  ///< blocks that become one block each give it what they have
  const Kernel* pass_;
  Graph graph_;
  std::vector<std::vector<std::vector<int>>> first_;  ///< per block, port and element: signal
};

}  // namespace

Graph scalarize_vectors(WiredDiagram diagram, const Registry& registry) {
  return Apart(std::move(diagram), registry).run();
}

}  // namespace hysteron
