// Decides how many elements every port carries, by unification over the wires: nobody has to state a length twice.
//
// Every length begins at one and grows until nothing changes:
//   input of the diagram   as stated; open: what its readers need, else one
//   elementwise block      the length of its vectors; single numbers go to every element
//   block with vectors     what its Sizes say for the lengths of its inputs
//   any other block        one
// A need goes back over a wire only where it leaves no choice: through elementwise blocks with one wire. Then every
// wire is held against its reader; a mismatch names both ends, both lengths and what fixed them.
#include "engine/compile/lengths.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <set>

#include "engine/diagram/index.h"

namespace hysteron {
namespace {

constexpr int longest = 10'000;  // elements; a length that grows around a loop ends here

class Lengths {
 public:
  explicit Lengths(WiredDiagram& diagram) : d_(diagram), readers_(diagram.blocks.size()) {}

  void run() {
    start();
    while (!todo_.empty() && !endless_) {
      const int b = todo_.front();
      todo_.pop_front();
      waiting_[at(b)] = false;
      update(b);
    }
    if (!endless_) check();
    problems_.throw_if_any();
  }

 private:
  WiredBlock& block(int b) { return d_.blocks[at(b)]; }
  const WiredBlock& block(int b) const { return d_.blocks[at(b)]; }

  void start() {
    waiting_.assign(d_.blocks.size(), true);
    for (std::size_t b = 0; b < d_.blocks.size(); ++b) {
      auto& own = d_.blocks[b];
      own.lengths.assign(own.kernel->declaration.outputs.size(), std::max(own.stated_length, 1));
      if (own.has_vector_ports()) own.lengths.assign(own.lengths.size(), 1);
      if (own.has_vector_ports() && own.kernel->declaration.outputs.front().variadic)
        own.lengths = own.kernel->sizes(own.shape).output_lengths;
      for (const auto& wire : own.wires) readers_[at(wire.block)].push_back(static_cast<int>(b));
      todo_.push_back(static_cast<int>(b));
    }
  }

  void set(int b, int port, int length) {
    int& own = block(b).lengths[at(port)];
    if (own == length) return;
    if (length > longest) return tell_endless(b);
    own = length;
    for (const int reader : readers_[at(b)])
      if (!waiting_[at(reader)]) {
        waiting_[at(reader)] = true;
        todo_.push_back(reader);
      }
  }

  void update(int b) {
    WiredBlock& own = block(b);
    if (own.has_vector_ports()) {
      own.shape.input_lengths.clear();
      for (const auto& wire : own.wires) own.shape.input_lengths.push_back(d_.length(wire));
      own.sizes = own.kernel->sizes(own.shape);
      for (std::size_t o = 0; o < own.lengths.size() && o < own.sizes.output_lengths.size(); ++o)
        set(b, static_cast<int>(o), own.sizes.output_lengths[o]);
      for (std::size_t w = 0; w < own.wires.size() && w < own.sizes.input_lengths.size(); ++w)
        need(own.wires[w], own.sizes.input_lengths[w]);
    } else if (own.is_elementwise()) {
      int n = 1;
      for (const auto& wire : own.wires) n = std::max(n, d_.length(wire));
      for (std::size_t o = 0; o < own.lengths.size(); ++o) set(b, static_cast<int>(o), n);
    }
  }

  /// A reader wants `length` elements of `end`.
  void need(const PortEnd& end, int length) {
    const PortEnd* to = &end;
    for (std::size_t hops = 0; hops <= d_.blocks.size() && to->element < 0 && length > 1; ++hops) {
      const WiredBlock& own = block(to->block);
      if (own.is_input() && own.stated_length == 0 && own.lengths[0] == 1) return set(to->block, 0, length);
      if (!own.is_elementwise() || own.wires.size() != 1) return;
      to = &own.wires.front();
    }
  }

  void tell_endless(int b) {
    endless_ = true;
    problems_.add("wrong_length", block(b).place,
                  fmt::format("{} \"{}\" would grow without end: its length depends on itself, around a loop",
                              block(b).kernel->declaration.type, block(b).path),
                  "join single elements in the loop, such as \"block[0]\", or take the loop out");
  }

  // --- is every wire as long as its reader wants? -------------------------------------------------------------------

  void check() {
    for (std::size_t b = 0; b < d_.blocks.size(); ++b) {
      WiredBlock& own = d_.blocks[b];
      for (const auto& wire : own.wires) check_index(wire);
      if (!own.has_vector_ports()) own.sizes = own.kernel->sizes(own.shape);
      if (!own.sizes.error.empty()) {
        problems_.add("bad_value", own.origin, fmt::format("\"{}\": {}", own.path, own.sizes.error),
                      "make the lists and wires fit together");
        continue;
      }
      check_outputs(own);
      if (own.has_vector_ports())
        check_vector_wires(own);
      else if (own.is_elementwise())
        check_elementwise(static_cast<int>(b));
      else
        check_scalar(own);
    }
    for (const auto& [name, end] : d_.outputs) check_index(end);
    for (const auto& end : d_.record) check_index(end);
    for (const auto& end : d_.places_read) check_index(end);
    for (const auto& stated : d_.stated) {
      check_index(stated.end);
      if (const int n = d_.length(stated.end); n != stated.length)
        problems_.add(
            "wrong_length", stated.end.place,
            fmt::format("input \"{}\" states \"length\": {}, but {}", stated.name, stated.length, told(stated.end)),
            "wire a signal of that length, or leave \"length\" out of the nested diagram: it then takes any");
    }
  }

  /// "drive" has length 2 (mux "drive": it joins 1 + 1 elements)
  std::string told(const PortEnd& end) const {
    const std::string why = reason(end);
    return fmt::format("\"{}\" has length {} ({})", end.name, d_.length(end), why);
  }

  std::string reason(const PortEnd& end) const {
    const PortEnd* to = &end;
    std::string how;
    for (std::set<int> seen; seen.insert(to->block).second;) {
      const WiredBlock& own = block(to->block);
      const std::string named = fmt::format("{} \"{}\"", own.kernel->declaration.type, own.path);
      if (to->element >= 0) return fmt::format("one element of \"{}\"", own.path);
      if (own.is_input())
        return own.stated_length > 0 ? fmt::format("{}: \"length\": {}", named, own.stated_length)
               : own.lengths[0] > 1  ? fmt::format("{} states none; another reader needs {}", named, own.lengths[0])
                                     : fmt::format("{} states none", named);
      if (own.has_vector_ports()) return named + (own.sizes.lengths_from.empty() ? "" : ": " + own.sizes.lengths_from);
      if (!own.is_elementwise() || own.wires.empty()) return named + " gives single numbers";
      const int n = own.lengths[at(to->port)];
      const auto from =
          std::find_if(own.wires.begin(), own.wires.end(), [&](const PortEnd& wire) { return d_.length(wire) == n; });
      if (from == own.wires.end()) return named;
      to = &*from;
    }
    return "in a loop of elementwise blocks";
  }

  void check_index(const PortEnd& end) {
    if (end.element < 0) return;
    const PortEnd whole{end.block, end.port, -1, {}, {}};
    const int n = d_.length(whole);
    if (end.element < n) return;
    problems_.add("bad_index", end.place,
                  fmt::format("\"{}\" does not exist: the signal has length {} ({})", end.name, n, reason(whole)),
                  n == 1 ? "write [0], or leave the index out" : fmt::format("elements are [0] ... [{}]", n - 1));
  }

  void check_outputs(const WiredBlock& own) {
    int elements = static_cast<int>(own.lengths.size());
    if (own.has_vector_ports()) {
      elements = 0;
      for (const int n : own.lengths) elements += n;
    }
    if (own.sizes.outputs != elements)
      problems_.add("bad_value", own.origin,
                    fmt::format("\"{}\" declares {} outputs and has {}", own.path, elements, own.sizes.outputs),
                    "correct the block type");
  }

  void check_vector_wires(const WiredBlock& own) {
    for (std::size_t w = 0; w < own.wires.size(); ++w) {
      const auto& port = own.kernel->declaration.inputs[at(own.port[w])];
      if (w < own.sizes.shortest.size() && d_.length(own.wires[w]) < own.sizes.shortest[w])
        problems_.add(
            "wrong_length", own.place,
            fmt::format("{} \"{}\" needs at least length {} at input {} ({}), but {}", own.kernel->declaration.type,
                        own.path, own.sizes.shortest[w], port.name, own.sizes.lengths_from, told(own.wires[w])),
            fmt::format("elements are 0 ... {}", d_.length(own.wires[w]) - 1));
      const int wanted = w < own.sizes.input_lengths.size() ? own.sizes.input_lengths[w] : port.is_vector ? 0 : 1;
      if (wanted == 0 || d_.length(own.wires[w]) == wanted) continue;
      problems_.add(
          "wrong_length", own.place,
          fmt::format("{} \"{}\" takes length {} at input {} ({}), but {}", own.kernel->declaration.type, own.path,
                      wanted, port.name, own.sizes.lengths_from.empty() ? "as declared" : own.sizes.lengths_from,
                      told(own.wires[w])),
          "wire a signal of that length (mux joins, select picks elements), or correct what fixes it");
    }
  }

  void check_elementwise(int b) {
    const WiredBlock& own = block(b);
    const PortEnd* longest_wire = nullptr;
    for (const auto& wire : own.wires)
      if (longest_wire == nullptr || d_.length(wire) > d_.length(*longest_wire)) longest_wire = &wire;
    for (const auto& wire : own.wires) {
      const int n = d_.length(wire);
      if (n == 1 || n == d_.length(*longest_wire)) continue;
      problems_.add("wrong_length", own.place,
                    fmt::format("{} \"{}\" works element by element, but {} and {}", own.kernel->declaration.type,
                                own.path, told(*longest_wire), told(wire)),
                    "give both the same length (select picks elements); a single number goes to every element");
    }
  }

  void check_scalar(const WiredBlock& own) {
    for (std::size_t w = 0; w < own.wires.size(); ++w) {
      if (d_.length(own.wires[w]) == 1) continue;
      problems_.add(
          "wrong_length", own.place,
          fmt::format("{} \"{}\" takes length 1 at input {} (it works on single numbers), but {}",
                      own.kernel->declaration.type, own.path, own.kernel->declaration.inputs[at(own.port[w])].name,
                      told(own.wires[w])),
          fmt::format("take one element, such as \"{}[0]\", or write one block per element", own.wires[w].name));
    }
  }

  WiredDiagram& d_;
  std::vector<std::vector<int>> readers_;
  std::deque<int> todo_;
  std::vector<bool> waiting_;
  bool endless_ = false;
  Problems problems_;
};

}  // namespace

void infer_lengths(WiredDiagram& diagram) { Lengths(diagram).run(); }

}  // namespace hysteron
