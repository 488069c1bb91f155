#include "engine/compile/scopes.h"

#include <fmt/format.h>

#include <charconv>

#include "engine/compile/unused.h"

namespace hysteron {
namespace {

/// 12 of "[12]"; -1 if it is anything else.
int index_in(const std::string& text) {
  int number = -1;
  const char* last = text.data() + text.size() - 1;
  if (text.size() < 3 || text.size() > 9 || *last != ']') return -1;
  const auto end = std::from_chars(text.data() + 1, last, number);
  return end.ec == std::errc{} && end.ptr == last ? number : -1;
}

/// Declared, or y0, y1, ... where the parameters say how many there are.
std::vector<std::string> output_names(const WiredBlock& b) {
  const Declaration& d = b.kernel->declaration;
  if (d.outputs.empty() || !d.outputs.front().variadic) return d.output_names();
  std::vector<std::string> names;
  for (std::size_t i = 0; i < b.kernel->sizes(b.shape).output_lengths.size(); ++i)
    names.push_back(fmt::format("{}{}", d.outputs.front().name, i));
  return names;
}

}  // namespace

int Scopes::add(const Diagram& diagram, const std::string& prefix, int parent, const Node* node, const Node* written,
                const std::string& origin) {
  ScopeOfBlocks s;
  s.scope = {&diagram, prefix, parent < 0 ? nullptr : &(*this)[parent].scope, node};
  s.origin = origin;
  s.outer = node != nullptr && node->in.empty() ? written : node;  // a candidate without wires has those of the choice
  s.blocks.reserve(diagram.blocks.size());
  if (parent >= 0) s.enabling = (*this)[parent].enabling;
  parents_.push_back(parent);
  scopes_.push_back(std::move(s));
  return static_cast<int>(scopes_.size()) - 1;
}

PortEnd Scopes::input(const std::string& name) const {
  const auto found = inputs_.find(name);
  return found == inputs_.end() ? PortEnd{} : PortEnd{found->second, 0, -1, name, {}};
}

PortEnd Scopes::resolve(int index, const std::string& name, const std::string& place) {
  PortEnd end = resolve(index, name, place, 0);
  end.name = name;
  end.place = place;
  return end;
}

PortEnd Scopes::resolve(int index, const std::string& name, const std::string& place, int depth) {
  if (const auto open = name.find('['); open != std::string::npos) {
    const int element = index_in(name.substr(open));
    if (element < 0) {
      problems_.add("bad_index", place, fmt::format("\"{}\" is no element of a signal", name),
                    "count from 0: \"block[0]\", \"block.port[1]\"");
      return {};
    }
    PortEnd end = resolve(index, name.substr(0, open), place, depth);
    if (end.block < 0) return end;
    if (end.element < 0) {
      end.element = element;
    } else if (element != 0) {
      problems_.add("bad_index", place, fmt::format("\"{}\" takes an element of a single number", name),
                    "leave the index out");
    }
    return end;
  }
  return resolve_whole(index, name, place, depth);
}

PortEnd Scopes::resolve_whole(int index, const std::string& name, const std::string& place, int depth) {
  if (depth > 64) {
    problems_.add("algebraic_loop", place, fmt::format("\"{}\" leads back to itself through nested diagrams", name),
                  "read from a block instead");
    return {};
  }
  const auto slash = name.find('/');
  const std::string head = name.substr(0, slash);
  auto& scope = (*this)[index];
  if (slash != std::string::npos) {
    const auto found = scope.blocks.find(head);
    if (found != scope.blocks.end() && found->second.scope >= 0)
      return resolve(found->second.scope, name.substr(slash + 1), place, depth + 1);
    if (found != scope.blocks.end() && found->second.leaf < 0) return {};
    problems_.add("unknown_signal", place, fmt::format("there is no nested diagram \"{}\" in \"{}\"", head, name),
                  cure_for(head, index));
    return {};
  }
  const auto dot = name.find('.');
  const std::string block = name.substr(0, dot);
  const std::string port = dot == std::string::npos ? "" : name.substr(dot + 1);
  used_.insert({index, block});
  if (scope.scope.diagram->inputs.find(block) != nullptr) return resolve_input(index, block, depth);
  const auto found = scope.blocks.find(block);
  if (found == scope.blocks.end()) {
    problems_.add("unknown_signal", place, fmt::format("there is no signal \"{}\"", name), cure_for(block, index));
    return {};
  }
  const BlockOfScope& entry = found->second;
  if (entry.scope >= 0) return resolve_nested(entry, block, port, place, depth);
  if (entry.leaf < 0) return {};  // a problem of the block itself
  return resolve_leaf(entry.leaf, block, port, place);
}

PortEnd Scopes::resolve_input(int index, const std::string& name, int depth) {
  if (index == 0) return {inputs_.at(name), 0, -1, {}, {}};
  const ScopeOfBlocks& scope = (*this)[index];
  const int parent = parents_[static_cast<std::size_t>(index)];
  const Node& node = *scope.outer;
  const auto position = scope.scope.diagram->inputs.place(name);
  for (std::size_t i = 0; i < node.in.size(); ++i) {
    const Wire& wire = node.in[i];
    if (wire.port.empty() ? static_cast<std::ptrdiff_t>(i) == position : wire.port == name)
      return resolve(parent, wire.from, scope.origin + "/in", depth + 1);
  }
  problems_.add("missing_connection", scope.origin + "/in",
                fmt::format("input \"{}\" of the nested diagram is not connected", name),
                fmt::format("connect it: \"in\": {{\"{}\": \"...\"}}", name));
  return {};
}

PortEnd Scopes::resolve_nested(const BlockOfScope& entry, const std::string& block, const std::string& port,
                               const std::string& place, int depth) {
  const Diagram& inner = *(*this)[entry.scope].scope.diagram;
  const std::string* target = nullptr;
  if (!port.empty())
    target = inner.outputs.find(port);
  else if (inner.outputs.size() == 1)
    target = &inner.outputs.begin()->second;
  if (target == nullptr && port == "enabled" && entry.enabled >= 0) return {entry.enabled, 0, -1, {}, {}};
  if (target == nullptr && port == "triggered" && entry.triggered >= 0) return {entry.triggered, 0, -1, {}, {}};
  if (target == nullptr) {
    problems_.add("unknown_signal", place,
                  port.empty() ? fmt::format("\"{}\" has {} outputs; say which", block, inner.outputs.size())
                               : fmt::format("the nested diagram \"{}\" has no output \"{}\"", block, port),
                  did_you_mean(port, inner.outputs.names()));
    return {};
  }
  return resolve(entry.scope, *target, place, depth + 1);
}

PortEnd Scopes::resolve_leaf(int leaf, const std::string& block, const std::string& port, const std::string& place) {
  const WiredBlock& b = leaves_[static_cast<std::size_t>(leaf)];
  const auto names = output_names(b);
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] == port || (port.empty() && names.size() == 1)) return {leaf, static_cast<int>(i), -1, {}, {}};
  problems_.add("unknown_signal", place,
                port.empty() ? fmt::format("\"{}\" has {} outputs; say which", block, names.size())
                             : fmt::format("{} \"{}\" has no output \"{}\"", b.kernel->declaration.type, block, port),
                did_you_mean(port, names));
  return {};
}

/// The nearest names; where most wires are wrong nobody reads them, and they would take longest of all.
std::string Scopes::cure_for(const std::string& name, int index) const {
  constexpr std::size_t most_looked_up = 100;
  if (problems_.list().size() >= most_looked_up) return "name a block, or an input of the diagram";
  const auto& scope = (*this)[index];
  auto names = scope.scope.diagram->blocks.names();
  for (const auto& input : scope.scope.diagram->inputs.names()) names.push_back(input);
  return did_you_mean(name, names);
}

void Scopes::check_unused() const {
  std::vector<ScopeOfNames> list;
  for (const auto& scope : scopes_) list.push_back({scope.scope.diagram, scope.origin, {}});
  for (const auto& [scope, name] : used_) list[static_cast<std::size_t>(scope)].used.push_back(name);
  hysteron::check_unused(list, problems_);
}

}  // namespace hysteron
