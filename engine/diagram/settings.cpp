#include "engine/diagram/settings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>

#include "engine/diagram/error.h"
#include "engine/diagram/units.h"

namespace hysteron {
namespace {

/// A diagram on the way to a block, and the node of the diagram around it that holds it (none at the top).
struct Level {
  Diagram* diagram = nullptr;
  Node* holder = nullptr;
};

/// The block in use: of a choice the chosen candidate.
Node* body_of(Node& node) { return node.from.empty() ? &node : node.from.find(node.choose); }

/// Goes into a nested diagram; it is copied, so that the change stays in this value.
Level enter(Node& holder) {
  auto copy = std::make_shared<Diagram>(*holder.nested);
  const Level level{copy.get(), &holder};
  holder.nested = std::move(copy);
  return level;
}

/// Follows "axis/stage" to the node; a candidate of a choice may be named ("axis/stage/straight"). `levels` gets the
/// diagrams on the way.
Node& find_node(Diagram& diagram, const std::string& path, const std::string& option, std::vector<Level>& levels) {
  levels = {{&diagram, nullptr}};
  std::string rest = path;
  for (;;) {
    const auto slash = rest.find('/');
    const std::string name = rest.substr(0, slash);
    Diagram& scope = *levels.back().diagram;
    Node* node = scope.blocks.find(name);
    if (node == nullptr)
      fail("unknown_block", option, fmt::format("there is no block \"{}\"", name),
           did_you_mean(name, scope.blocks.names()) +
               " What lies inside a nested diagram is written with a slash: "
               "axis/stage");
    if (slash == std::string::npos) return *node;
    rest = rest.substr(slash + 1);
    Node* body = node;
    if (!node->from.empty()) {
      body = node->from.find(rest.substr(0, rest.find('/')));
      if (body != nullptr && rest.find('/') == std::string::npos) return *body;
      if (body != nullptr)
        rest = rest.substr(rest.find('/') + 1);
      else
        body = node->from.find(node->choose);
    }
    if (body == nullptr || !body->nested)
      fail("unknown_block", option, fmt::format("\"{}\" is not a nested diagram", name),
           "name a block of this diagram");
    levels.push_back(enter(*body));
  }
}

/// The unit that a value was written with; nothing where it has none, or where its numbers differ in it.
std::optional<std::string> written_unit(const Value& value) {
  if (const auto* number = std::get_if<Number>(&value.content)) return number->unit;
  const auto* list = std::get_if<NumberList>(&value.content);
  if (list == nullptr || list->empty()) return {};
  for (const auto& number : *list)
    if (number.unit != list->front().unit) return {};
  return list->front().unit;
}

/// A plain bound is in the unit of the value beside it. Another value, in another unit, must not move it.
void keep_unit_of_bounds(DiagramParameter& parameter) {
  if (was_set(parameter.value.origin)) return;  // the second setting: the bounds have got their unit
  for (auto* bound : {&parameter.lower, &parameter.upper})
    if (*bound && !(*bound)->unit) (*bound)->unit = written_unit(parameter.value);
}

/// "stage.gain" of each block of the diagram that reads "$name"; candidates that are not in use count.
void add_readers(const Node& node, const std::string& path, const std::string& name,
                 std::vector<std::string>& readers) {
  for (const auto* values : {&node.parameters, &node.parameters_from_file})
    for (const auto& [parameter, value] : *values)
      if (const auto* r = std::get_if<Reference>(&value.content); r != nullptr && r->name == name)
        readers.push_back(path + "." + parameter);
  for (const auto& [candidate, body] : node.from) add_readers(body, path + "/" + candidate, name, readers);
}

/// One setting of a number.
class Setting {
 public:
  Setting(Diagram& diagram, const Override& set) : diagram_(diagram), set_(set), name_(number_name(set.path)) {
    option_ = fmt::format("--set {}={}", set.path, set.value);
    value_ = Value(set.value);
    value_.origin = option_;
  }

  /// "", or what else it changes.
  std::string apply() {
    if (name_.block.empty()) {
      levels_ = {{&diagram_, nullptr}};
      if (diagram_.parameters.find(name_.parameter) == nullptr) fail_without_parameter(diagram_, "the diagram");
      return put_referred(name_.parameter, true);
    }
    Node* node = body_of(find_node(diagram_, name_.block, option_, levels_));
    if (node == nullptr) return "";  // a choice of a candidate that is not there: told when the diagram is compiled
    if (node->nested) {
      if (node->nested->parameters.find(name_.parameter) == nullptr)
        fail_without_parameter(*node->nested, fmt::format("the diagram of \"{}\"", name_.block));
      levels_.push_back(enter(*node));
      return put_referred(name_.parameter, true);
    }
    const Value* written = node->parameters.find(name_.parameter);
    if (written == nullptr) written = node->parameters_from_file.find(name_.parameter);
    if (written != nullptr)
      if (const auto* r = std::get_if<Reference>(&written->content);
          r != nullptr && levels_.back().diagram->parameters.find(r->name) != nullptr)
        return put_referred(std::string(r->name), false);
    put(written != nullptr ? *written : Value(), node->parameters[name_.parameter], written != nullptr);
    return "";
  }

 private:
  [[noreturn]] void fail_without_parameter(const Diagram& diagram, const std::string& of) const {
    fail("unknown_parameter", option_, fmt::format("{} has no parameter \"{}\"", of, name_.parameter),
         did_you_mean(name_.parameter, diagram.parameters.names()) +
             " A parameter of a block is written block.parameter");
  }

  /// Sets the parameter `name` of the innermost diagram where its value stands: there, at the block that holds the
  /// diagram, or further out and up along "$name". `named`: it is this one that the setting names.
  std::string put_referred(std::string name, bool named) {
    for (int links = 0; links < 32; ++links) {  // as many as resolve.cpp follows
      auto [diagram, holder] = levels_.back();
      DiagramParameter* own = diagram->parameters.find(name);
      if (own == nullptr) break;
      Value* given = holder == nullptr ? nullptr : holder->parameters.find(name);
      if (const auto* next = std::get_if<Reference>(&(given != nullptr ? *given : own->value).content)) {
        name = std::string(next->name);
        named = false;
        if (given != nullptr) levels_.pop_back();
        continue;
      }
      if (holder != nullptr) {  // the file of a nested diagram stays as it is
        put(given != nullptr ? *given : own->value, holder->parameters[name], true);
      } else {
        keep_unit_of_bounds(*own);
        put(own->value, own->value, true);
      }
      return named ? "" : shared_text(*diagram, name);
    }
    fail("unknown_reference", option_, fmt::format("the diagram has no parameter \"{}\"", name),
         fmt::format("correct \"${}\" in the diagram", name));
  }

  std::string shared_text(const Diagram& diagram, const std::string& name) const {
    std::vector<std::string> readers;
    for (const auto& [block, node] : diagram.blocks) add_readers(node, block, name, readers);
    if (readers.size() < 2) return "";
    return fmt::format("{} is the number \"{}\" of the diagram; what reads it changes with it: {}", set_.path, name,
                       fmt::join(readers, ", "));
  }

  /// Writes the new value, or one element of the old one. `written`: is there an old one.
  void put(const Value& old, Value& to, bool written) {
    if (name_.column < 0) {
      const auto known_to = to.known_to;  // said of what stands at that place
      to = value_;
      to.known_to = known_to;
      return;
    }
    const auto* number = std::get_if<Number>(&value_.content);
    if (number == nullptr)
      fail("wrong_type", option_, fmt::format("an element is a number, found \"{}\"", set_.value),
           "write a number, or a number with a unit such as \"5 Hz\"");
    if (!written)
      fail("no_element", option_, fmt::format("\"{}\" is not written in the diagram", name_.parameter),
           "write the whole list at the block first");
    Value next = old;
    element_of(next) = *number;
    next.origin = option_;
    to = std::move(next);
  }

  Number& element_of(Value& value) const {
    const auto column = static_cast<std::size_t>(name_.column);
    if (auto* list = std::get_if<NumberList>(&value.content); list != nullptr && name_.row < 0) {
      if (column >= list->size()) fail_outside(list->size());
      return (*list)[column];
    }
    if (auto* matrix = std::get_if<NumberMatrix>(&value.content); matrix != nullptr && name_.row >= 0) {
      const auto row = static_cast<std::size_t>(name_.row);
      if (row >= matrix->rows.size()) fail_outside(matrix->rows.size());
      if (column >= matrix->rows[row].size()) fail_outside(matrix->rows[row].size());
      return matrix->rows[row][column];
    }
    if (auto* number = std::get_if<Number>(&value.content); number != nullptr && name_.row < 0) {
      if (column > 0) fail_outside(1);
      return *number;
    }
    fail("no_element", option_, fmt::format("\"{}\" has no such element", name_.parameter),
         std::holds_alternative<NumberMatrix>(value.content) ? "of a matrix name row and column: matrix[0][1]"
                                                             : "leave the index out");
  }

  [[noreturn]] void fail_outside(std::size_t n) const {
    fail("no_element", option_, fmt::format("\"{}\" has {} element{} there", name_.parameter, n, n == 1 ? "" : "s"),
         fmt::format("count from 0 to {}", n - 1));
  }

  Diagram& diagram_;
  const Override& set_;
  NumberName name_;
  std::string option_;
  Value value_;
  std::vector<Level> levels_;
};

void choose_candidate(Diagram& diagram, const Override& c) {
  const std::string option = fmt::format("--choose {}={}", c.path, c.value);
  std::vector<Level> levels;
  Node& node = find_node(diagram, c.path, option, levels);
  if (node.from.empty())
    fail("bad_choice", option, fmt::format("block \"{}\" is not a choice", c.path),
         "choices are blocks with \"choose\" and \"from\"");
  if (node.from.find(c.value) == nullptr)
    fail("bad_choice", option, fmt::format("\"{}\" has no candidate \"{}\"", c.path, c.value),
         did_you_mean(c.value, node.from.names()));
  node.choose = c.value;
}

/// Cuts "[12]" off the end of `text`; -1 if it does not end so.
int cut_index(std::string& text) {
  const auto open = text.rfind('[');
  if (!text.ends_with(']') || open == std::string::npos || open == 0) return -1;
  int number = -1;
  const char *begin = text.data() + open + 1, *end = text.data() + text.size() - 1;
  const auto read = std::from_chars(begin, end, number);
  if (read.ec != std::errc{} || read.ptr != end || number < 0) return -1;
  text.resize(open);
  return number;
}

}  // namespace

NumberName number_name(const std::string& name) {
  NumberName n;
  std::string rest = name;
  n.column = cut_index(rest);
  if (n.column >= 0) n.row = cut_index(rest);
  // The last dot parts block and parameter; of what was given to a nested diagram ("axis/mass") the last slash.
  const auto cut = rest.find_last_of("./");
  n.parameter = cut == std::string::npos ? rest : rest.substr(cut + 1);
  if (cut != std::string::npos) n.block = rest.substr(0, cut);
  return n;
}

std::vector<std::string> settings_applied(Diagram& diagram, const std::vector<Override>& set,
                                          const std::vector<Override>& choose) {
  std::vector<std::string> notes;
  for (const auto& c : choose) choose_candidate(diagram, c);
  for (const auto& s : set)
    if (auto note = Setting(diagram, s).apply(); !note.empty()) notes.push_back(std::move(note));
  return notes;
}

void apply_settings(Diagram& diagram, const std::vector<Override>& set, const std::vector<Override>& choose) {
  settings_applied(diagram, set, choose);
}

}  // namespace hysteron
