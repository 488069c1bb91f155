// Decides what a diagram is made of once choices are taken and nested diagrams are put in place: leaf blocks, signals,
// wires. Does not look at units (unit_check.cpp) nor at the order of evaluation (order.cpp).
#include "engine/graph.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <map>
#include <set>

namespace hysteron {
namespace {

/// One named block of a scope: a leaf of the graph, or a nested scope.
struct Entry {
  const Node* node = nullptr;  ///< as written (a choice keeps its wires)
  const Node* body = nullptr;  ///< the block in use
  int leaf = -1;
  int scope = -1;
  std::string origin;
};

struct BuildScope {
  Scope scope;
  std::map<std::string, Entry> entries;
  std::vector<std::string> order;
  std::string origin;  ///< JSON pointer of the node that holds it, "" at the top
};

class Builder {
 public:
  Builder(const Diagram& diagram, const Registry& registry) : registry_(registry) {
    add_scope(diagram, "", -1, nullptr, "");
  }

  Graph build() {
    check_wire_names();
    collect(0);
    problems_.throw_if_any();  // names and types first: wires of unknown blocks would only repeat the message
    wire_all();
    name_outputs();
    check_unused();
    problems_.throw_if_any();
    return std::move(graph_);
  }

 private:
  int add_scope(const Diagram& diagram, const std::string& prefix, int parent, const Node* node,
                const std::string& origin) {
    BuildScope s;
    s.scope = {&diagram, prefix, parent < 0 ? nullptr : &scopes_[static_cast<std::size_t>(parent)].scope, node};
    s.origin = origin;
    parents_.push_back(parent);
    scopes_.push_back(std::move(s));
    return static_cast<int>(scopes_.size()) - 1;
  }

  // --- blocks -------------------------------------------------------------------------------------------------------

  void collect(int index) {
    const Diagram& diagram = *scopes_[static_cast<std::size_t>(index)].scope.diagram;
    if (index == 0) add_inputs(diagram);
    for (const auto& [name, node] : diagram.blocks) {
      Entry entry;
      entry.node = &node;
      entry.origin = node.origin.empty() ? "/blocks/" + name : node.origin;
      if (diagram.inputs.find(name) != nullptr)
        problems_.add("duplicate_name", entry.origin, fmt::format("\"{}\" is both an input and a block", name),
                      "rename one of them");
      entry.body = chosen(node, name, entry.origin);
      if (entry.body != nullptr) add_block(index, name, entry);
      auto& scope = scopes_[static_cast<std::size_t>(index)];
      scope.entries[name] = entry;
      scope.order.push_back(name);
    }
    if (index == 0) graph_.places = diagram.places;
  }

  void add_inputs(const Diagram& diagram) {
    const Kernel* kernel = registry_.find("input");
    for (const auto& [name, input] : diagram.inputs) {
      if (kernel == nullptr) {
        problems_.add("unknown_block", "/inputs/" + name, "the registry has no block \"input\"", "register it");
        continue;
      }
      static const Node empty;
      Entry entry{&empty, &empty, -1, -1, "/inputs/" + name};
      entry.leaf = add_leaf(0, name, *kernel, empty, entry.origin);
      graph_.inputs.emplace_back(name, graph_.blocks[static_cast<std::size_t>(entry.leaf)].first_signal);
      Unit unit;
      try {
        unit = parse_unit(input.unit, entry.origin + "/unit");
      } catch (const Error& e) {
        for (const auto& p : e.problems) problems_.add(p.code, p.path, p.what, p.cure);
      }
      graph_.input_units.push_back(unit);
      auto& signal = graph_.signals[static_cast<std::size_t>(graph_.inputs.back().second)];
      signal.dimension = unit.dimension;
      signal.unit = unit;
      inputs_[name] = entry.leaf;
    }
  }

  const Node* chosen(const Node& node, const std::string& name, const std::string& origin) {
    if (node.from.empty()) return &node;
    const Node* candidate = node.from.find(node.choose);
    if (candidate == nullptr)
      problems_.add("bad_choice", origin + "/choose",
                    fmt::format("choice \"{}\" has no candidate \"{}\"", name, node.choose),
                    did_you_mean(node.choose, node.from.names()));
    return candidate;
  }

  void add_block(int index, const std::string& name, Entry& entry) {
    const Node& body = *entry.body;
    const std::string prefix = scopes_[static_cast<std::size_t>(index)].scope.prefix;
    const std::string origin = entry.body == entry.node ? entry.origin : entry.origin + "/from/" + entry.node->choose;
    if (body.type == "diagram" || body.nested) {
      if (!body.nested) {
        problems_.add("missing_diagram", origin, fmt::format("block \"{}\" is a nested diagram without content", name),
                      "name its file: \"file\": \"...\"");
        return;
      }
      for (const auto& [key, value] : body.parameters)
        if (body.nested->parameters.find(key) == nullptr)
          problems_.add("unknown_parameter", origin + "/" + key,
                        fmt::format("the diagram of \"{}\" has no parameter \"{}\"", name, key),
                        did_you_mean(key, body.nested->parameters.names()));
      entry.scope = add_scope(*body.nested, prefix + name + "/", index, &body, origin);
      collect(entry.scope);
      return;
    }
    const Kernel* kernel = registry_.find(body.type);
    if (kernel == nullptr || body.type == "input") {
      auto types = registry_.types();
      std::erase(types, "input");
      types.push_back("diagram");
      problems_.add("unknown_block", origin + "/type", fmt::format("there is no block type \"{}\"", body.type),
                    did_you_mean(body.type, types));
      return;
    }
    entry.leaf = add_leaf(index, name, *kernel, body, origin);
  }

  int add_leaf(int index, const std::string& name, const Kernel& kernel, const Node& body, const std::string& origin) {
    const Scope& scope = scopes_[static_cast<std::size_t>(index)].scope;
    GraphBlock b;
    b.path = scope.prefix + name;
    b.origin = origin;
    b.kernel = &kernel;
    b.parameters = resolve_parameters(scope, body, kernel.declaration, origin, graph_.parameters, problems_);
    b.shape.declaration = &kernel.declaration;
    for (std::size_t i = 0; i < b.parameters.size(); ++i) {
      const auto& numbers = b.parameters[i].numbers;
      b.shape.list_lengths.push_back(static_cast<int>(numbers.size()));
      const bool text = kernel.declaration.parameters[i].kind == ParameterKind::text;
      b.shape.text_choices.push_back(text && !numbers.empty() ? static_cast<int>(numbers[0].si) : 0);
    }
    if (const Value* samples = body.parameters.find("samples"))
      if (const auto* series = std::get_if<SeriesPointer>(&samples->content)) b.series = *series;
    if (kernel.declaration.is_series && kernel.declaration.type != "input" && !b.series)
      problems_.add("missing_parameter", origin, fmt::format("\"{}\" has no recorded samples", b.path),
                    "name them: \"file\": \"x.csv\", \"column\": \"u\"");
    b.first_signal = static_cast<int>(graph_.signals.size());
    for (const auto& port : kernel.declaration.outputs) {
      SignalInfo s;
      s.path = kernel.declaration.outputs.size() == 1 ? b.path : b.path + "." + port.name;
      s.block = static_cast<int>(graph_.blocks.size());
      if (const Value* unit = kernel.declaration.is_series ? body.parameters.find("unit") : nullptr)
        if (const auto* text = std::get_if<std::string>(&unit->content)) {
          s.unit = parse_unit(*text, unit->origin);
          b.unit_known = true;
        }
      graph_.signals.push_back(std::move(s));
    }
    graph_.blocks.push_back(std::move(b));
    return static_cast<int>(graph_.blocks.size()) - 1;
  }

  // --- wires --------------------------------------------------------------------------------------------------------

  /// The signal that `name` means in a scope: "block", "block.port", an input, or "a/b.port" for a block further in. -1
  /// and a problem if none.
  int resolve(int index, const std::string& name, const std::string& place, int depth = 0) {
    if (depth > 64) {
      problems_.add("algebraic_loop", place, fmt::format("\"{}\" leads back to itself through nested diagrams", name),
                    "read from a block instead");
      return -1;
    }
    const auto slash = name.find('/');
    const std::string head = name.substr(0, slash);
    auto& scope = scopes_[static_cast<std::size_t>(index)];
    if (slash != std::string::npos) {
      const auto found = scope.entries.find(head);
      if (found != scope.entries.end() && found->second.scope >= 0)
        return resolve(found->second.scope, name.substr(slash + 1), place, depth + 1);
      problems_.add("unknown_signal", place, fmt::format("there is no nested diagram \"{}\" in \"{}\"", head, name),
                    did_you_mean(head, known_names(index)));
      return -1;
    }
    const auto dot = name.find('.');
    const std::string block = name.substr(0, dot);
    const std::string port = dot == std::string::npos ? "" : name.substr(dot + 1);
    used_.insert({index, block});
    if (scope.scope.diagram->inputs.find(block) != nullptr) return resolve_input(index, block, place, depth);
    const auto found = scope.entries.find(block);
    if (found == scope.entries.end()) {
      problems_.add("unknown_signal", place, fmt::format("there is no signal \"{}\"", name),
                    did_you_mean(block, known_names(index)));
      return -1;
    }
    const Entry& entry = found->second;
    if (entry.scope >= 0) return resolve_nested(entry, block, port, place, depth);
    if (entry.leaf < 0) return -1;
    return resolve_leaf(entry.leaf, block, port, place);
  }

  int resolve_input(int index, const std::string& name, const std::string& place, int depth) {
    if (index == 0) return graph_.blocks[static_cast<std::size_t>(inputs_.at(name))].first_signal;
    const BuildScope& scope = scopes_[static_cast<std::size_t>(index)];
    const int parent = parents_[static_cast<std::size_t>(index)];
    const Node& node = *outer_node(index);
    const auto names = scope.scope.diagram->inputs.names();
    for (std::size_t i = 0; i < node.in.size(); ++i) {
      const Wire& wire = node.in[i];
      if (wire.port.empty() ? (i < names.size() && names[i] == name) : wire.port == name)
        return resolve(parent, wire.from, scope.origin + "/in", depth + 1);
    }
    problems_.add("missing_connection", scope.origin + "/in",
                  fmt::format("input \"{}\" of the nested diagram is not connected", name),
                  fmt::format("connect it: \"in\": {{\"{}\": \"...\"}}", name));
    (void)place;
    return -1;
  }

  /// The node with the wires of a nested scope: the choice, where the nested diagram is a candidate without wires of
  /// its own.
  const Node* outer_node(int index) const {
    const auto& scope = scopes_[static_cast<std::size_t>(index)];
    const auto& parent = scopes_[static_cast<std::size_t>(parents_[static_cast<std::size_t>(index)])];
    for (const auto& [name, entry] : parent.entries)
      if (entry.body == scope.scope.node) return entry.body->in.empty() ? entry.node : entry.body;
    return scope.scope.node;
  }

  int resolve_nested(const Entry& entry, const std::string& block, const std::string& port, const std::string& place,
                     int depth) {
    const Diagram& inner = *scopes_[static_cast<std::size_t>(entry.scope)].scope.diagram;
    const std::string* target = nullptr;
    if (!port.empty())
      target = inner.outputs.find(port);
    else if (inner.outputs.size() == 1)
      target = &inner.outputs.begin()->second;
    if (target == nullptr) {
      problems_.add("unknown_signal", place,
                    port.empty() ? fmt::format("\"{}\" has {} outputs; say which", block, inner.outputs.size())
                                 : fmt::format("the nested diagram \"{}\" has no output \"{}\"", block, port),
                    did_you_mean(port, inner.outputs.names()));
      return -1;
    }
    return resolve(entry.scope, *target, place, depth + 1);
  }

  int resolve_leaf(int leaf, const std::string& block, const std::string& port, const std::string& place) {
    const GraphBlock& b = graph_.blocks[static_cast<std::size_t>(leaf)];
    const auto& outputs = b.kernel->declaration.outputs;
    for (std::size_t i = 0; i < outputs.size(); ++i)
      if (outputs[i].name == port || (port.empty() && outputs.size() == 1)) return b.first_signal + static_cast<int>(i);
    problems_.add("unknown_signal", place,
                  port.empty() ? fmt::format("\"{}\" has {} outputs; say which", block, outputs.size())
                               : fmt::format("{} \"{}\" has no output \"{}\"", b.kernel->declaration.type, block, port),
                  did_you_mean(port, b.kernel->declaration.output_names()));
    return -1;
  }

  std::vector<std::string> known_names(int index) const {
    const auto& scope = scopes_[static_cast<std::size_t>(index)];
    auto names = scope.scope.diagram->blocks.names();
    for (const auto& name : scope.scope.diagram->inputs.names()) names.push_back(name);
    return names;
  }

  void wire_all() {
    for (std::size_t s = 0; s < scopes_.size(); ++s)
      for (const auto& name : scopes_[s].order) {
        const Entry entry = scopes_[s].entries.at(name);
        const Node& wires =
            entry.body == nullptr || !entry.body->in.empty() ? (entry.body ? *entry.body : *entry.node) : *entry.node;
        if (entry.leaf >= 0) wire_leaf(static_cast<int>(s), entry, wires);
        if (entry.scope >= 0) check_nested_wires(static_cast<int>(s), entry, wires);
      }
  }

  void wire_leaf(int index, const Entry& entry, const Node& wires) {
    GraphBlock& b = graph_.blocks[static_cast<std::size_t>(entry.leaf)];
    const auto& ports = b.kernel->declaration.inputs;
    const bool is_choice = !entry.node->from.empty();
    const std::string place = entry.origin + "/in";
    std::vector<std::vector<int>> sources(ports.size());
    std::size_t next = 0;
    for (const Wire& wire : wires.in) {
      const int signal = resolve(index, wire.from, place);
      std::size_t port = ports.size();
      if (wire.port.empty()) {
        port = std::min(next, ports.empty() ? std::size_t{0} : ports.size());
        if (port < ports.size() && !ports[port].variadic) ++next;
      } else {
        for (std::size_t i = 0; i < ports.size(); ++i)
          if (ports[i].name == wire.port) port = i;
      }
      if (port >= ports.size()) {
        if (is_choice) continue;  // a choice has the union of its candidates' ports
        problems_.add("unknown_input", place,
                      wire.port.empty() ? fmt::format("{} takes {} input{}, found {}", b.kernel->declaration.type,
                                                      ports.size(), ports.size() == 1 ? "" : "s", wires.in.size())
                                        : fmt::format("{} has no input \"{}\"", b.kernel->declaration.type, wire.port),
                      ports.empty() ? "leave \"in\" out: it is a source"
                                    : did_you_mean(wire.port, b.kernel->declaration.input_names()));
        continue;
      }
      if (!sources[port].empty() && !ports[port].variadic) {
        problems_.add("double_connection", place,
                      fmt::format("input \"{}\" of \"{}\" is connected twice", ports[port].name, b.path),
                      "keep one wire, or add the signals in a sum");
        continue;
      }
      sources[port].push_back(signal);
    }
    for (std::size_t i = 0; i < ports.size(); ++i) {
      if (sources[i].empty())
        problems_.add("missing_connection", place,
                      fmt::format("input \"{}\" of {} \"{}\" is not connected", ports[i].name,
                                  b.kernel->declaration.type, b.path),
                      fmt::format("say where it comes from: \"in\": \"...\"; {}", ports[i].meaning));
      for (const int signal : sources[i]) {
        b.source.push_back(signal);
        b.port.push_back(static_cast<int>(i));
      }
    }
    b.shape.inputs = static_cast<int>(b.source.size());
    b.sizes = b.kernel->sizes(b.shape);
    if (!b.sizes.error.empty())
      problems_.add("bad_value", entry.origin, fmt::format("\"{}\": {}", b.path, b.sizes.error),
                    "make the lists and wires fit together");
    if (b.sizes.outputs != static_cast<int>(b.kernel->declaration.outputs.size()))
      problems_.add("bad_value", entry.origin,
                    fmt::format("\"{}\" declares {} outputs and has {}", b.path, b.kernel->declaration.outputs.size(),
                                b.sizes.outputs),
                    "correct the block type");
  }

  void check_nested_wires(int index, const Entry& entry, const Node& wires) {
    const auto names = scopes_[static_cast<std::size_t>(entry.scope)].scope.diagram->inputs.names();
    const std::string place = entry.origin + "/in";
    std::set<std::string> seen;
    for (std::size_t i = 0; i < wires.in.size(); ++i) {
      resolve(index, wires.in[i].from, place);
      const std::string port = wires.in[i].port.empty() ? (i < names.size() ? names[i] : "") : wires.in[i].port;
      if (std::find(names.begin(), names.end(), port) == names.end())
        problems_.add("unknown_input", place,
                      port.empty()
                          ? fmt::format("the nested diagram takes {} inputs, found {}", names.size(), wires.in.size())
                          : fmt::format("the nested diagram has no input \"{}\"", port),
                      did_you_mean(port, names));
      else if (!seen.insert(port).second)
        problems_.add("double_connection", place,
                      fmt::format("input \"{}\" of the nested diagram is connected twice", port), "keep one wire");
    }
    for (const auto& name : names)
      if (!seen.contains(name))
        problems_.add("missing_connection", place,
                      fmt::format("input \"{}\" of the nested diagram is not connected", name),
                      "say where it comes from");
  }

  void name_outputs() {
    const Diagram& top = *scopes_[0].scope.diagram;
    for (const auto& [name, signal] : top.outputs)
      graph_.outputs.emplace_back(name, resolve(0, signal, "/outputs/" + name));
    for (std::size_t i = 0; i < top.record.size(); ++i)
      graph_.record.push_back(resolve(0, top.record[i], fmt::format("/record/{}", i)));
    for (const auto& [kind, wires] : top.places)
      for (const auto& wire : wires) {
        const auto dot = wire.find('.');
        // A place may name an input port ("stage.in"): then the block itself must exist.
        if (dot != std::string::npos && (wire.substr(dot + 1) == "in" || is_input_port(wire))) continue;
        resolve(0, wire, "/places/" + kind);
      }
  }

  bool is_input_port(const std::string& wire) const {
    const auto dot = wire.find('.');
    const auto found = scopes_[0].entries.find(wire.substr(0, dot));
    if (found == scopes_[0].entries.end() || found->second.leaf < 0) return false;
    const auto names = graph_.blocks[static_cast<std::size_t>(found->second.leaf)].kernel->declaration.input_names();
    return std::find(names.begin(), names.end(), wire.substr(dot + 1)) != names.end();
  }

  // --- what nobody reads --------------------------------------------------------------------------------------------

  static void collect_references(const Node& node, std::set<std::string>& wires, std::set<std::string>& references) {
    for (const auto& wire : node.in) wires.insert(wire.from.substr(0, wire.from.find_first_of("./")));
    for (const auto& [name, value] : node.parameters)
      if (const auto* r = std::get_if<Reference>(&value.content)) references.insert(r->name);
    for (const auto& [name, value] : node.parameters_from_file)
      if (const auto* r = std::get_if<Reference>(&value.content)) references.insert(r->name);
    for (const auto& [name, candidate] : node.from) collect_references(candidate, wires, references);
  }

  void check_unused() {
    for (std::size_t s = 0; s < scopes_.size(); ++s) {
      const Diagram& diagram = *scopes_[s].scope.diagram;
      std::set<std::string> wires;
      std::set<std::string> references;
      for (const auto& [name, node] : diagram.blocks) collect_references(node, wires, references);
      for (const auto& [name, p] : diagram.parameters)
        if (const auto* r = std::get_if<Reference>(&p.value.content)) references.insert(r->name);
      const auto head = [](const std::string& text) { return text.substr(0, text.find_first_of("./")); };
      for (const auto& [name, signal] : diagram.outputs) wires.insert(head(signal));
      for (const auto& signal : diagram.record) wires.insert(head(signal));
      const std::string where = s == 0 ? "" : scopes_[s].origin;
      const bool keeps_nothing = diagram.outputs.empty() && diagram.record.empty() && s == 0;
      for (const auto& [name, node] : diagram.blocks)
        if (!keeps_nothing && !wires.contains(name) && !used_.contains({static_cast<int>(s), name}))
          problems_.add("unused_block", where + "/blocks/" + name, fmt::format("nobody reads block \"{}\"", name),
                        "wire it, record it, make it an output, or remove it");
      for (const auto& name : diagram.inputs.names())
        if (!wires.contains(name))
          problems_.add("unused_input", where + "/inputs/" + name, fmt::format("nobody reads input \"{}\"", name),
                        "wire it or remove it");
      for (const auto& name : diagram.parameters.names())
        if (!references.contains(name))
          problems_.add("unused_parameter", where + "/parameters/" + name,
                        fmt::format("nobody reads parameter \"{}\"", name),
                        fmt::format("refer to it as \"${}\" or remove it", name));
    }
  }

  void check_wire_names() {
    const Diagram& top = *scopes_[0].scope.diagram;
    if (top.blocks.empty())
      problems_.add("empty_diagram", "/blocks", "the diagram has no blocks", "add at least one block");
  }

  const Registry& registry_;
  std::deque<BuildScope> scopes_;  // a deque: scopes point at their parents
  std::vector<int> parents_;
  std::map<std::string, int> inputs_;
  std::set<std::pair<int, std::string>> used_;
  Problems problems_;
  Graph graph_;
};

}  // namespace

Graph build_graph(const Diagram& diagram, const Registry& registry) { return Builder(diagram, registry).build(); }

}  // namespace hysteron
