// Decides what a diagram is: named blocks and where each takes its inputs from, as a plain value without files or
// physics. C++ code can build one by hand; io reads and writes it as JSON; compile() turns it into a Program.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "engine/diagram/name_index.h"
#include "engine/diagram/series.h"

namespace hysteron {

/// A number as written: in its own unit, or (unit absent) in the declared one.
struct Number {
  double value = 0;
  std::optional<std::string> unit{};
  bool operator==(const Number&) const = default;
};

/// "$name": the value of a diagram parameter.
struct Reference {
  std::string name;
  bool operator==(const Reference&) const = default;
};

using NumberList = std::vector<Number>;

/// Rows of numbers, all of one length.
struct NumberMatrix {
  std::vector<NumberList> rows;
  bool operator==(const NumberMatrix&) const = default;
};

/// What a parameter of a block was given.
struct Value {
  std::variant<Number, NumberList, std::string, Reference, SeriesPointer, NumberMatrix> content;
  std::string origin{};  ///< where it was written: "stage.json#/blocks/a/gain", "--set a.gain=2" ("" = from C++)
  /// One standard deviation of what is known of its numbers, as a part of each: 0.02; 0 = exact; none: nobody says.
  std::optional<double> known_to{};

  Value() = default;
  Value(double number) : content(Number{number, {}}) {}  // NOLINT: implicit on purpose, so that C++ diagrams read well
  Value(Number number) : content(std::move(number)) {}   // NOLINT
  Value(NumberList list) : content(std::move(list)) {}   // NOLINT
  Value(NumberMatrix matrix) : content(std::move(matrix)) {}     // NOLINT
  Value(Reference reference) : content(std::move(reference)) {}  // NOLINT
  Value(SeriesPointer series) : content(std::move(series)) {}    // NOLINT
  /// "5 Hz" is a number with a unit, "$kp" a reference, anything else text.
  Value(const std::string& text);                        // NOLINT
  Value(const char* text) : Value(std::string(text)) {}  // NOLINT
};

/// A list that keeps the order of the file and is looked up by name, however long it is.
template <class T>
class Ordered {
 public:
  using Item = std::pair<std::string, T>;
  T* find(const std::string& name) {
    const auto place = index_.find(name, items_.size(), name_at());
    return place < 0 ? nullptr : &items_[static_cast<std::size_t>(place)].second;
  }
  const T* find(const std::string& name) const { return const_cast<Ordered*>(this)->find(name); }
  T& operator[](const std::string& name) {
    if (T* found = find(name)) return *found;
    items_.emplace_back(name, T{});
    index_.added(items_.size(), name_at());
    return items_.back().second;
  }
  bool erase(const std::string& name) {
    const auto place = index_.find(name, items_.size(), name_at());
    if (place < 0) return false;
    items_.erase(items_.begin() + place);
    index_.rebuild(items_.size(), name_at());
    return true;
  }
  /// Inserts behind `after` (at the end if `after` is not there).
  T& insert_after(const std::string& after, const std::string& name, T value) {
    const auto place = index_.find(after, items_.size(), name_at());
    const auto i = items_.insert(place < 0 ? items_.end() : items_.begin() + place + 1, {name, std::move(value)});
    index_.rebuild(items_.size(), name_at());
    return i->second;
  }
  /// Where it stands in the list; -1 if it is not there.
  std::ptrdiff_t place(const std::string& name) const { return index_.find(name, items_.size(), name_at()); }
  void reserve(std::size_t size) { items_.reserve(size); }
  bool empty() const { return items_.empty(); }
  std::size_t size() const { return items_.size(); }
  auto begin() { return items_.begin(); }
  auto end() { return items_.end(); }
  auto begin() const { return items_.begin(); }
  auto end() const { return items_.end(); }
  std::vector<std::string> names() const {
    std::vector<std::string> list;
    list.reserve(items_.size());
    for (const auto& item : items_) list.push_back(item.first);
    return list;
  }

 private:
  auto name_at() const {
    return [items = items_.data()](std::size_t place) { return std::string_view(items[place].first); };
  }

  std::vector<Item> items_;
  NameIndex index_;
};

/// Where a block takes one input from. `port` is empty where the inputs are listed by position.
struct Wire {
  std::string port;
  std::string from;  ///< "block", "block.port", the name of an input of the diagram, or an element: "block.port[1]"
};

struct Diagram;

/// When a nested diagram runs that does not always: while a signal is true, when it becomes so, or both.
struct RunsWhen {
  std::string enable{};         ///< signal: runs while it is true; "" = always
  bool resets_states = false;   ///< begins anew whenever it is enabled; else it goes on where it stopped
  bool zeroes_outputs = false;  ///< its signals are zero while it is not enabled; else they stay as they were
  std::string trigger{};        ///< signal: runs once at each of its edges; "" = all the time
  std::string edge = "rising";  ///< "rising", "falling" or "either"
};

/// One block as written. Exactly one of: a type, a choice (`from` not empty), a nested diagram (type "diagram").
struct Node {
  std::string type{};
  Ordered<Value> parameters{};
  std::vector<Wire> in{};
  std::string origin{};  ///< JSON pointer of the block ("" = from C++)

  std::string choose{};  ///< name of the candidate in use
  Ordered<Node> from{};  ///< the candidates of a choice; their inputs are the choice's own
  std::string effect{};  ///< id of the effect that put this choice or this candidate here ("" = the user's own)
  std::string upon{};    ///< of a candidate that an effect put here: the one that it is with that effect besides

  std::string file{};                       ///< nested diagram: the file as written
  std::shared_ptr<const Diagram> nested{};  ///< nested diagram: its content
  std::optional<RunsWhen> runs{};           ///< nested diagram: when it runs; absent = always
  std::string parameter_file{};  ///< "parameters": the set as written; its values stand in `parameters_from_file`
  Ordered<Value> parameters_from_file{};
};

/// A named number of the diagram, to which blocks refer by "$name".
struct DiagramParameter {
  Value value;
  std::optional<Number> lower{}, upper{};  ///< bounds for fits
  std::optional<bool> free{};              ///< may a fit change it (default: no)
  std::string remark{};
};

struct DiagramInput {
  std::string unit{};
  std::string remark{};
  int length = 0;  ///< elements; 0 = not stated: what its readers need, else one. Longer ones bind as u[0], u[1], ...
};

/// Solver and recording settings, as written; numbers in s unless they carry a unit.
struct SimulateSettings {
  std::optional<Number> until{}, every{};
  std::optional<std::string> method{};  ///< one of method_names()
  std::optional<double> relative_tolerance{},
      absolute_tolerance{};                  ///< absolute: in units of each state's nominal size
  std::optional<Number> max_step{}, step{};  ///< step: of the methods with fixed steps
  std::optional<std::string> loops{};        ///< what an algebraic loop is: "solve" (solved, the default), or "error"
  std::optional<std::string> start{};        ///< "given" (default: states as declared) or "steady" (equilibrium)
  Ordered<NumberList> past{};                ///< block -> what its input has been before the start
  Ordered<NumberList> memory{};              ///< block -> what it remembers at the start, number after number
  Ordered<Number> guess{};                   ///< signal -> where the search for the loop that it stands in begins
};

struct Diagram {
  std::string schema{}, title{}, source{}, remark{};
  Ordered<DiagramParameter> parameters{};
  Ordered<DiagramInput> inputs{};
  Ordered<Node> blocks{};
  Ordered<std::string> outputs{};  ///< output name -> signal
  std::vector<std::string> record{};
  Ordered<std::vector<std::string>> places{};  ///< kind of place ("command", "core" ...) -> wires
  SimulateSettings simulate{};
  std::string file{};  ///< where it was read from ("" = from C++)
};

/// A change of one value from outside: "controller.kp" = "0.5 V/um" (--set), or of a choice (--choose).
struct Override {
  std::string path, value;
};

/// Was a value with this origin given from outside?
bool was_set(const std::string& origin);

/// Applies `--set` and `--choose`. Throws Error naming the nearest valid path.
void apply_settings(Diagram& diagram, const std::vector<Override>& set, const std::vector<Override>& choose);

}  // namespace hysteron
