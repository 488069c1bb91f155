// Decides what a name in a diagram means where it stands: the scopes of nested diagrams, the blocks in them, and which
// output of which leaf a wire reads. Does not decide what is connected (connect.h). Internal to wire_diagram().
#pragma once

#include <deque>
#include <map>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "engine/compile/flatten.h"

namespace hysteron {

/// One named block of a scope: a leaf of the graph, or a nested scope.
struct BlockOfScope {
  const Node* node = nullptr;  ///< as written (a choice keeps its wires)
  const Node* body = nullptr;  ///< the block in use
  int leaf = -1;
  int scope = -1;
  std::string origin;
  int enabled = -1, triggered = -1;  ///< of a nested diagram that does not always run: the blocks that tell
};

struct ScopeOfBlocks {
  Scope scope;
  std::unordered_map<std::string, BlockOfScope> blocks;
  std::vector<std::string> order;
  std::string origin;           ///< JSON pointer of the node that holds it, "" at the top
  int enabling = -1;            ///< into WiredDiagram::enablings: the innermost that it is inside of
  const Node* outer = nullptr;  ///< with the wires to its inputs; null at the top
};

/// The diagram and every diagram in it, by index; 0 is the diagram itself.
class Scopes {
 public:
  /// `leaves`: what BlockOfScope::leaf counts. Problems of names go to `problems`.
  Scopes(const std::vector<WiredBlock>& leaves, Problems& problems) : leaves_(leaves), problems_(problems) {}

  /// The index of a new one, behind all others. `node`: the block in use that holds it, `written`: the same or the
  /// choice around it; both null at the top.
  int add(const Diagram& diagram, const std::string& prefix, int parent, const Node* node, const Node* written,
          const std::string& origin);
  std::size_t size() const { return scopes_.size(); }
  ScopeOfBlocks& operator[](int index) { return scopes_[static_cast<std::size_t>(index)]; }
  const ScopeOfBlocks& operator[](int index) const { return scopes_[static_cast<std::size_t>(index)]; }

  /// `leaf` is the input `name` of the diagram itself.
  void add_input(const std::string& name, int leaf) { inputs_[name] = leaf; }
  bool has_input(const std::string& name) const { return inputs_.contains(name); }
  /// Its output; block -1 if there is none.
  PortEnd input(const std::string& name) const;

  /// What `name` means in a scope: "block", "block.port", an input, or "a/b.port" for a block further in, each perhaps
  /// with the index of an element. Block -1 and a problem if none.
  PortEnd resolve(int index, const std::string& name, const std::string& place);

  /// Problems for what no name that was resolved has meant.
  void check_unused() const;

 private:
  PortEnd resolve(int index, const std::string& name, const std::string& place, int depth);
  PortEnd resolve_whole(int index, const std::string& name, const std::string& place, int depth);
  PortEnd resolve_input(int index, const std::string& name, int depth);
  PortEnd resolve_nested(const BlockOfScope& entry, const std::string& block, const std::string& port,
                         const std::string& place, int depth);
  PortEnd resolve_leaf(int leaf, const std::string& block, const std::string& port, const std::string& place);
  std::string cure_for(const std::string& name, int index) const;

  const std::vector<WiredBlock>& leaves_;
  Problems& problems_;
  std::deque<ScopeOfBlocks> scopes_;  // a deque: scopes point at their parents
  std::vector<int> parents_;
  std::map<std::string, int> inputs_;
  std::set<std::pair<int, std::string>> used_;
};

}  // namespace hysteron
