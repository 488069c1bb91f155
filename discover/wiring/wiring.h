// Decides how the wires of a diagram are followed before it is compiled: who reads a signal, what lies between two of
// them. Internal to discover; works on one level of a diagram, nested diagrams count as one block.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "discover/wiring/commutes.h"
#include "engine/block/instance.h"
#include "engine/block/kernel.h"
#include "engine/diagram/diagram.h"

namespace hysteron {

/// One place where a signal is read: wire `index` of a block, or an output of the diagram.
struct Reader {
  std::string block;  ///< "" where it is an output
  int index = 0;      ///< into Node::in
  std::string output;
  std::string element{};  ///< "[1]" where only that element of the signal is read
};

/// The path under which the compiled program knows a signal of the diagram: what a nested diagram hands on is a signal
/// of a block inside it.
std::string program_signal(const Diagram& diagram, const Registry& registry, const std::string& signal);

/// The compiled program's output `name` is this output of the diagram, or an element of it: "y[1]" of "y".
bool is_of_output(const std::string& name, const std::string& output);

/// A candidate of a choice and the effect that put it there; "" = it is the user's own, or the block as it was.
struct Layer {
  std::string candidate, effect;
};
/// What the candidate in use is made of: the first is a block as it is, each further one that with one effect more.
std::vector<Layer> layers(const Node& choice);
/// Some candidate of the choice, in use or not, is there for this effect.
bool has_effect(const Node& choice, const std::string& effect);

class Wiring {
 public:
  Wiring(const Diagram& diagram, const Registry& registry);

  const Diagram& diagram() const { return diagram_; }
  /// The block in use: the chosen candidate of a choice, else the node itself.
  const Node* body(const std::string& block) const;
  bool is_input(const std::string& name) const { return diagram_.inputs.find(name) != nullptr; }
  /// One spelling for every signal: "block" where the block has one output, else "block.port". "" if there is none
  /// such.
  std::string signal(const std::string& text) const;
  /// The block that makes a signal; "" for an input of the diagram.
  std::string source(const std::string& signal) const;
  std::vector<Reader> readers(const std::string& signal) const;
  /// The readers through which the signal goes on: without the effects on other wires that only have it beside them (a
  /// temperature, the drive of another axis).
  std::vector<Reader> followers(const std::string& signal) const;
  /// Every signal of this level: inputs first, then blocks in the order of the file.
  std::vector<std::string> signals() const;
  std::vector<std::string> outputs_of(const std::string& block) const;  ///< signals that a block makes
  /// Input ports by name, one per wire of `in` (a variadic port repeats).
  std::vector<std::string> ports(const std::string& block) const;

  bool is_inserted(const std::string& block) const;  ///< an effect that was put on a wire
  bool has_memory(const std::string& block) const;
  /// The same of the user's own block, before an effect that was found gave it another law.
  bool had_memory(const std::string& block) const;
  bool is_linear(const std::string& block) const;     ///< declared so, nested diagrams block by block
  bool has_states(const std::string& block) const;    ///< states or a remembered past
  bool is_constant(const std::string& signal) const;  ///< made by a block without inputs whose signal never moves
  bool reaches_output(const std::string& signal) const;
  /// Outputs of the diagram to which a signal goes on (see followers), in their order.
  std::vector<std::string> outputs_on_the_way(const std::string& signal) const;

  /// Effects that stand on this wire one after the other, each the only follower of the one before: names of the
  /// choices.
  std::vector<std::string> chain(const std::string& signal) const;
  /// The signal at the beginning of a chain of blocks, with one moving input each, that commute with such a law.
  std::string root(const std::string& signal, Commutes law) const { return root(signal, law, 0); }

 private:
  std::string root(const std::string& signal, Commutes law, int depth) const;
  /// Outputs that a signal moves; `beside`: also where another wire's effect only has it beside that wire.
  std::vector<std::string> outputs_behind(const std::string& signal, bool beside) const;
  bool passes(const std::string& block, Commutes law) const;
  bool remembers(const Node* node) const;

  const Diagram& diagram_;
  const Registry& registry_;
};

}  // namespace hysteron
