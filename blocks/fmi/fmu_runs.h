// Decides how the hidden state of an FMU goes along with runs that can be copied and begun again: every state that was
// reached is a node, told by the inputs that led to it; who goes on from a node that no instance stands at has a new
// one go the way from the start. Where there are too many nodes, whole runs that nobody has asked for in a long while
// are forgotten. Does not load binaries (native_fmu.h).
#pragma once

#include <cstddef>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "blocks/fmi/native_fmu.h"
#include "engine/block/foreign_interface.h"

namespace hysteron::blocks {

class FmuRuns {
 public:
  /// A number for this interface, the same whenever it is asked for; and what stands behind it. Any thread.
  static int number_of(const std::string& interface_text);
  static FmuRuns& at_number(int number);

  const ForeignInterface& interface() const { return interface_; }

  /// The node at the start [s]: initialized with these parameters (places in interface().parameters, values in the
  /// FMU's units). A node is a positive number that a double holds.
  long root(double start, const std::vector<std::pair<int, double>>& parameters);
  /// The node behind a step with these inputs (the FMU's units), held. Throws Error "fmu_forgotten" where the run of
  /// the node was begun so many others ago that it is no more known.
  long advanced(long node, std::span<const double> inputs, double from, double size);
  /// Outputs at a node, in the FMU's units. Throws likewise.
  std::vector<double> outputs(long node);

 private:
  struct Node {
    long parent = 0;  ///< 0: a root
    double from = 0, size = 0;
    std::vector<double> inputs{}, outputs{};
    std::vector<std::pair<int, double>> parameters{};  ///< of a root
    std::vector<long> children{};
  };
  using Root = std::pair<double, std::vector<std::pair<int, double>>>;  // start [s], parameters
  /// All that was reached from one root.
  struct Tree {
    Root root;
    std::vector<Node> nodes{};  // place 0: the root
    long used = 0;              // the larger the later
  };
  struct Instance {
    std::unique_ptr<NativeFmu> fmu;
    long node = 0;
  };

  explicit FmuRuns(ForeignInterface interface) : interface_(std::move(interface)) {}
  Tree& tree_of(long node);
  Node& node(long number);
  long added(long tree, Node node);
  void forget();
  Instance fresh(const Node& root);
  Instance taken(long node);
  void step(Instance& instance, const Node& to);
  std::vector<double> read(Instance& instance);
  void keep(Instance instance);

  ForeignInterface interface_;
  std::mutex mutex_;
  std::map<long, Tree> trees_;  // by numbers that are given once
  std::map<Root, long> roots_;  // -> node
  std::size_t nodes_ = 0;       // of all trees
  long last_tree_ = 0, uses_ = 0;
  std::list<Instance> live_;  // the one that was used last first
};

}  // namespace hysteron::blocks
