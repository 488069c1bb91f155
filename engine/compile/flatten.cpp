// Decides what a diagram is made of once choices are taken and nested diagrams are put in place: leaf blocks and wires.
// Does not look at lengths (lengths.cpp), units (unit_check.cpp) nor the order of evaluation (order.cpp).
#include "engine/compile/flatten.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <deque>
#include <map>
#include <set>

#include "engine/block/instance.h"
#include "engine/compile/resolve.h"
#include "engine/compile/unused.h"

namespace hysteron {
namespace {

/// One named block of a scope: a leaf of the graph, or a nested scope.
struct Entry {
  const Node* node = nullptr;  ///< as written (a choice keeps its wires)
  const Node* body = nullptr;  ///< the block in use
  int leaf = -1;
  int scope = -1;
  std::string origin;
  int enabled = -1, triggered = -1;  ///< of a nested diagram that does not always run: the blocks that tell
};

struct BuildScope {
  Scope scope;
  std::map<std::string, Entry> entries;
  std::vector<std::string> order;
  std::string origin;  ///< JSON pointer of the node that holds it, "" at the top
  int enabling = -1;   ///< into WiredDiagram::enablings: the innermost that it is inside of
};

/// A signal that enables or triggers, read where the nested diagram stands.
struct EnablingWire {
  int leaf = -1, scope = -1;
  std::string from, place;
  int outer = -1;  ///< the block that enables the diagram around it, if any
};

class Builder {
 public:
  /// `gaps`: of a draft, else null.
  Builder(const Diagram& diagram, const Registry& registry, Gaps* gaps) : registry_(registry), gaps_(gaps) {
    add_scope(diagram, "", -1, nullptr, "");
  }

  WiredDiagram build() {
    check_wire_names();
    collect(0);
    stop_if_wrong();  // names and types first: wires of unknown blocks would only repeat the message
    wire_all();
    wire_enablings();
    name_outputs();
    find_unused();
    stop_if_wrong();
    return std::move(wired_);
  }

  const Problems& problems() const { return problems_; }

 private:
  void stop_if_wrong() const {
    if (gaps_ == nullptr) problems_.throw_if_any();
  }

  // --- drafts -------------------------------------------------------------------------------------------------------

  bool is_left_out(const std::string& origin) const { return gaps_ != nullptr && gaps_->left_out.contains(origin); }

  /// The end in place of one that is missing; of a finished diagram there is none.
  PortEnd open_end(const std::string& name) {
    if (gaps_ == nullptr) return {};
    gaps_->open.insert(name);
    const auto found = inputs_.find(name);
    return found == inputs_.end() ? PortEnd{} : PortEnd{found->second, 0, -1, name, {}};
  }

  void add_open_ends() {
    const Kernel* kernel = registry_.find("input");
    if (gaps_ == nullptr || kernel == nullptr) return;
    static const Node empty;
    for (const auto& name : gaps_->open) {
      if (inputs_.contains(name)) continue;  // an input of the diagram whose unit is not known
      inputs_[name] = add_leaf(0, name, *kernel, empty, "");
      wired_.open.emplace_back(name, inputs_[name]);
    }
  }

  // --- scopes -------------------------------------------------------------------------------------------------------

  int add_scope(const Diagram& diagram, const std::string& prefix, int parent, const Node* node,
                const std::string& origin) {
    BuildScope s;
    s.scope = {&diagram, prefix, parent < 0 ? nullptr : &scopes_[static_cast<std::size_t>(parent)].scope, node};
    s.origin = origin;
    if (parent >= 0) s.enabling = scopes_[static_cast<std::size_t>(parent)].enabling;
    parents_.push_back(parent);
    scopes_.push_back(std::move(s));
    return static_cast<int>(scopes_.size()) - 1;
  }

  // --- blocks -------------------------------------------------------------------------------------------------------

  void collect(int index) {
    const Diagram& diagram = *scopes_[static_cast<std::size_t>(index)].scope.diagram;
    if (index == 0) {
      add_inputs(diagram);
      add_open_ends();
    }
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
    if (index == 0) wired_.places = diagram.places;
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
      WiredBlock& block = wired_.blocks.back();
      block.stated_length = input.length;
      if (input.length < 0)
        problems_.add("bad_value", entry.origin + "/length",
                      fmt::format("input \"{}\" cannot have {} elements", name, input.length),
                      "write how many numbers it carries, or leave it out");
      try {
        block.unit = parse_unit(input.unit, entry.origin + "/unit");
      } catch (const Error& e) {
        for (const auto& p : e.problems) problems_.add(p.code, p.path, p.what, p.cure);
        if (gaps_ != nullptr) gaps_->open.insert(name);
      }
      const bool unit_is_open = gaps_ != nullptr && gaps_->open.contains(name);
      (unit_is_open ? wired_.open : wired_.inputs).emplace_back(name, entry.leaf);
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
      if (body.runs) enable(index, name, origin, entry);
      collect(entry.scope);
      return;
    }
    const Kernel* kernel = registry_.find(body.type);
    if (kernel == nullptr || kernel->declaration.group == "internal") {
      auto types = registry_.types();
      std::erase_if(types, [&](const auto& type) { return registry_.find(type)->declaration.group == "internal"; });
      types.push_back("diagram");
      problems_.add("unknown_block", origin + "/type", fmt::format("there is no block type \"{}\"", body.type),
                    did_you_mean(body.type, types));
      return;
    }
    if (is_left_out(origin)) return;
    if (kernel->instance != nullptr) {
      KernelPointer own = own_kernel(*kernel, body, origin);
      if (own == nullptr) return;
      kernel = wired_.kernels.emplace_back(std::move(own)).get();
    }
    entry.leaf = add_leaf(index, name, *kernel, body, origin);
  }

  /// A block for the signal that enables a nested diagram, and one for the signal that triggers it.
  void enable(int index, const std::string& name, const std::string& origin, Entry& entry) {
    const RunsWhen& runs = *entry.body->runs;
    if (!runs.enable.empty()) {
      entry.enabled = add_enabling(index, entry, name, "enabled", "enabled", runs.enable, origin + "/enable");
      wired_.enablings.back().resets_states = runs.resets_states;
      wired_.enablings.back().zeroes_outputs = runs.zeroes_outputs;
    }
    if (!runs.trigger.empty()) {
      entry.triggered = add_enabling(index, entry, name, "triggered", runs.edge, runs.trigger, origin + "/trigger");
      wired_.enablings.back().triggered = true;
    }
  }

  int add_enabling(int index, const Entry& entry, const std::string& name, const std::string& port,
                   const std::string& kind, const std::string& wire, const std::string& place) {
    const Kernel* kernel = registry_.find("enabling");
    if (kernel == nullptr) {
      problems_.add("unknown_block", place, "the registry has no block \"enabling\"", "register it");
      return -1;
    }
    Node& node = enabling_nodes_.emplace_back();
    node.parameters["runs"].content = kind;
    const int leaf = add_leaf(index, name + "." + port, *kernel, node, place);
    if (leaf < 0) return -1;
    BuildScope& inner = scopes_[static_cast<std::size_t>(entry.scope)];
    wired_.blocks.back().enabling = -1;  // it says whether others run, and itself always does
    const int outer = inner.enabling;
    enabling_wires_.push_back(
        {leaf, index, wire, place, outer < 0 ? -1 : wired_.enablings[static_cast<std::size_t>(outer)].block});
    Enabling enabling;
    enabling.block = leaf;
    enabling.outer = outer;
    enabling.path = scopes_[static_cast<std::size_t>(index)].scope.prefix + name;
    inner.enabling = static_cast<int>(wired_.enablings.size());
    wired_.enablings.push_back(std::move(enabling));
    return leaf;
  }

  void wire_enablings() {
    for (const auto& wire : enabling_wires_) {
      WiredBlock& b = wired_.blocks[static_cast<std::size_t>(wire.leaf)];
      PortEnd end = resolve(wire.scope, wire.from, wire.place);
      if (end.block < 0) end = open_end(scopes_[static_cast<std::size_t>(wire.scope)].scope.prefix + wire.from);
      b.place = wire.place;
      b.wires.push_back(std::move(end));
      if (wire.outer >= 0) b.wires.push_back({wire.outer, 0, -1, {}, wire.place});
      b.port.assign(b.wires.size(), 0);
      b.shape.inputs = static_cast<int>(b.wires.size());
    }
  }

  /// Null where the text that names the ports of a block is wrong.
  KernelPointer own_kernel(const Kernel& type, const Node& body, const std::string& origin) {
    try {
      return instance_of(type, body);
    } catch (const Error& e) {
      for (const auto& p : e.problems) problems_.add(p.code, place_of(body, origin, p.path), p.what, p.cure);
      return nullptr;
    }
  }

  /// "/blocks/law/y"; where the value was given from outside, that.
  static std::string place_of(const Node& body, const std::string& origin, const std::string& in_block) {
    const Value* given = in_block.empty() ? nullptr : body.parameters.find(in_block.substr(1));
    return given != nullptr && was_set(given->origin) ? given->origin : origin + in_block;
  }

  /// -1 in a draft where its parameters are wrong.
  int add_leaf(int index, const std::string& name, const Kernel& kernel, const Node& body, const std::string& origin) {
    const Scope& scope = scopes_[static_cast<std::size_t>(index)].scope;
    WiredBlock b;
    b.path = scope.prefix + name;
    b.origin = origin;
    b.kernel = &kernel;
    const std::size_t problems_before = problems_.list().size();
    b.enabling = scopes_[static_cast<std::size_t>(index)].enabling;
    b.parameters = resolve_parameters(scope, body, kernel.declaration, origin, wired_.parameters, problems_);
    b.shape = shape_of(kernel.declaration, b.parameters);
    if (const Value* samples = body.parameters.find("samples"))
      if (const auto* series = std::get_if<SeriesPointer>(&samples->content)) b.series = *series;
    if (kernel.declaration.is_series && kernel.declaration.type != "input" && !b.series)
      problems_.add("missing_parameter", origin, fmt::format("\"{}\" has no recorded samples", b.path),
                    "name them: \"file\": \"x.csv\", \"column\": \"u\"");
    if (const Value* unit = kernel.declaration.is_series ? body.parameters.find("unit") : nullptr)
      if (const auto* text = std::get_if<std::string>(&unit->content)) try {
          b.unit = parse_unit(*text, unit->origin);
          b.unit_known = true;
        } catch (const Error& e) {
          for (const auto& p : e.problems) problems_.add(p.code, p.path, p.what, p.cure);
        }
    if (gaps_ != nullptr && problems_.list().size() > problems_before) return -1;
    wired_.blocks.push_back(std::move(b));
    return static_cast<int>(wired_.blocks.size()) - 1;
  }

  static Shape shape_of(const Declaration& declaration, const std::vector<ResolvedParameter>& parameters) {
    Shape shape;
    shape.declaration = &declaration;
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      const auto& numbers = parameters[i].numbers;
      const bool text = declaration.parameters[i].kind == ParameterKind::text;
      shape.list_lengths.push_back(static_cast<int>(numbers.size()));
      shape.text_choices.push_back(text && !numbers.empty() ? static_cast<int>(numbers[0].si) : 0);
      shape.columns.push_back(parameters[i].columns);
      shape.structure.emplace_back();
      if (declaration.parameters[i].is_structural || text)
        for (const auto& number : numbers) shape.structure.back().push_back(number.si);
    }
    return shape;
  }

  // --- wires --------------------------------------------------------------------------------------------------------

  /// What `name` means in a scope: "block", "block.port", an input, or "a/b.port" for a block further in, each perhaps
  /// with the index of an element. Block -1 and a problem if none.
  PortEnd resolve(int index, const std::string& name, const std::string& place) {
    PortEnd end = resolve(index, name, place, 0);
    end.name = name;
    end.place = place;
    return end;
  }

  PortEnd resolve(int index, const std::string& name, const std::string& place, int depth) {
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

  /// 12 of "[12]"; -1 if it is anything else.
  static int index_in(const std::string& text) {
    int number = -1;
    const char* last = text.data() + text.size() - 1;
    if (text.size() < 3 || text.size() > 9 || *last != ']') return -1;
    const auto end = std::from_chars(text.data() + 1, last, number);
    return end.ec == std::errc{} && end.ptr == last ? number : -1;
  }

  PortEnd resolve_whole(int index, const std::string& name, const std::string& place, int depth) {
    if (depth > 64) {
      problems_.add("algebraic_loop", place, fmt::format("\"{}\" leads back to itself through nested diagrams", name),
                    "read from a block instead");
      return {};
    }
    const auto slash = name.find('/');
    const std::string head = name.substr(0, slash);
    auto& scope = scopes_[static_cast<std::size_t>(index)];
    if (slash != std::string::npos) {
      const auto found = scope.entries.find(head);
      if (found != scope.entries.end() && found->second.scope >= 0)
        return resolve(found->second.scope, name.substr(slash + 1), place, depth + 1);
      if (found != scope.entries.end() && found->second.leaf < 0) return {};
      problems_.add("unknown_signal", place, fmt::format("there is no nested diagram \"{}\" in \"{}\"", head, name),
                    did_you_mean(head, known_names(index)));
      return {};
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
      return {};
    }
    const Entry& entry = found->second;
    if (entry.scope >= 0) return resolve_nested(entry, block, port, place, depth);
    if (entry.leaf < 0) return {};  // a problem of the block itself
    return resolve_leaf(entry.leaf, block, port, place);
  }

  PortEnd resolve_input(int index, const std::string& name, const std::string& place, int depth) {
    if (index == 0) return {inputs_.at(name), 0, -1, {}, {}};
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
    return {};
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

  PortEnd resolve_nested(const Entry& entry, const std::string& block, const std::string& port,
                         const std::string& place, int depth) {
    const Diagram& inner = *scopes_[static_cast<std::size_t>(entry.scope)].scope.diagram;
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

  PortEnd resolve_leaf(int leaf, const std::string& block, const std::string& port, const std::string& place) {
    const WiredBlock& b = wired_.blocks[static_cast<std::size_t>(leaf)];
    const auto names = output_names(b);
    for (std::size_t i = 0; i < names.size(); ++i)
      if (names[i] == port || (port.empty() && names.size() == 1)) return {leaf, static_cast<int>(i), -1, {}, {}};
    problems_.add("unknown_signal", place,
                  port.empty() ? fmt::format("\"{}\" has {} outputs; say which", block, names.size())
                               : fmt::format("{} \"{}\" has no output \"{}\"", b.kernel->declaration.type, block, port),
                  did_you_mean(port, names));
    return {};
  }

  /// Declared, or y0, y1, ... where the parameters say how many there are.
  static std::vector<std::string> output_names(const WiredBlock& b) {
    const Declaration& d = b.kernel->declaration;
    if (d.outputs.empty() || !d.outputs.front().variadic) return d.output_names();
    std::vector<std::string> names;
    for (std::size_t i = 0; i < b.kernel->sizes(b.shape).output_lengths.size(); ++i)
      names.push_back(fmt::format("{}{}", d.outputs.front().name, i));
    return names;
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
        if (entry.leaf < 0 && entry.scope < 0) {
          wired_.left_out.push_back(scopes_[s].scope.prefix + name);
          // The wires of a block that is not there may be wrong, too.
          for (const Wire& wire : wires.in) resolve(static_cast<int>(s), wire.from, entry.origin + "/in");
        }
      }
  }

  void wire_leaf(int index, const Entry& entry, const Node& wires) {
    WiredBlock& b = wired_.blocks[static_cast<std::size_t>(entry.leaf)];
    const auto& ports = b.kernel->declaration.inputs;
    const bool is_choice = !entry.node->from.empty();
    const std::string place = entry.origin + "/in";
    b.place = place;
    std::vector<std::vector<PortEnd>> sources(ports.size());
    std::size_t next = 0;
    for (const Wire& wire : wires.in) {
      PortEnd end = resolve(index, wire.from, place);
      if (end.block < 0) end = open_end(scopes_[static_cast<std::size_t>(index)].scope.prefix + wire.from);
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
      sources[port].push_back(std::move(end));
    }
    for (std::size_t i = 0; i < ports.size(); ++i) {
      if (sources[i].empty()) {
        problems_.add("missing_connection", place,
                      fmt::format("input \"{}\" of {} \"{}\" is not connected", ports[i].name,
                                  b.kernel->declaration.type, b.path),
                      fmt::format("say where it comes from: \"in\": \"...\"; {}", ports[i].meaning));
        if (!ports[i].variadic)
          sources[i].push_back(open_end(b.path + "." + ports[i].name));
        else if (gaps_ != nullptr)  // nothing says how many
          gaps_->left_out.insert(b.origin);
      }
      for (auto& end : sources[i]) {
        b.wires.push_back(std::move(end));
        b.port.push_back(static_cast<int>(i));
      }
    }
    b.shape.inputs = static_cast<int>(b.wires.size());
  }

  void check_nested_wires(int index, const Entry& entry, const Node& wires) {
    const BuildScope& inner = scopes_[static_cast<std::size_t>(entry.scope)];
    const auto names = inner.scope.diagram->inputs.names();
    const std::string place = entry.origin + "/in";
    std::set<std::string> seen;
    for (std::size_t i = 0; i < wires.in.size(); ++i) {
      PortEnd end = resolve(index, wires.in[i].from, place);
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
      else if (const int length = inner.scope.diagram->inputs.find(port)->length; length > 0 && end.block >= 0)
        wired_.stated.push_back({std::move(end), length, inner.scope.prefix + port});
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
      if (PortEnd end = resolve(0, signal, "/outputs/" + name); end.block >= 0)
        wired_.outputs.emplace_back(name, std::move(end));
    for (std::size_t i = 0; i < top.record.size(); ++i)
      if (PortEnd end = resolve_recorded(top, top.record[i], fmt::format("/record/{}", i)); end.block >= 0)
        wired_.record.push_back(std::move(end));
    for (const auto& [kind, wires] : top.places)
      for (const auto& wire : wires) {
        const auto dot = wire.find('.');
        // A place may name an input port ("stage.in"): then the block itself must exist.
        if (dot != std::string::npos && (wire.substr(dot + 1) == "in" || is_input_port(wire))) continue;
        if (PortEnd end = resolve(0, wire, "/places/" + kind); end.block >= 0)
          wired_.places_read.push_back(std::move(end));
      }
  }

  /// A signal, or an output of the diagram ("y", "y[1]") where no block and no input has this name.
  PortEnd resolve_recorded(const Diagram& top, const std::string& name, const std::string& place) {
    const auto open = name.find('[');
    const std::string* wire = top.outputs.find(name.substr(0, open));
    const std::string head = head_of_wire(name);
    if (wire == nullptr || top.blocks.find(head) != nullptr || top.inputs.find(head) != nullptr)
      return resolve(0, name, place);
    return resolve(0, open == std::string::npos ? *wire : *wire + name.substr(open), place);
  }

  bool is_input_port(const std::string& wire) const {
    const auto dot = wire.find('.');
    const auto found = scopes_[0].entries.find(wire.substr(0, dot));
    if (found == scopes_[0].entries.end() || found->second.leaf < 0) return false;
    const auto names = wired_.blocks[static_cast<std::size_t>(found->second.leaf)].kernel->declaration.input_names();
    return std::find(names.begin(), names.end(), wire.substr(dot + 1)) != names.end();
  }

  void find_unused() {
    std::vector<ScopeOfNames> list;
    for (const auto& scope : scopes_) list.push_back({scope.scope.diagram, scope.origin, {}});
    for (const auto& [scope, name] : used_) list[static_cast<std::size_t>(scope)].used.push_back(name);
    check_unused(list, problems_);
  }

  void check_wire_names() {
    const Diagram& top = *scopes_[0].scope.diagram;
    if (top.blocks.empty())
      problems_.add("empty_diagram", "/blocks", "the diagram has no blocks", "add at least one block");
  }

  const Registry& registry_;
  Gaps* gaps_;
  std::deque<BuildScope> scopes_;  // a deque: scopes point at their parents
  std::vector<int> parents_;
  std::map<std::string, int> inputs_;
  std::set<std::pair<int, std::string>> used_;
  std::deque<Node> enabling_nodes_;  // a deque: nodes stay where they are
  std::vector<EnablingWire> enabling_wires_;
  Problems problems_;
  WiredDiagram wired_;
};

}  // namespace

WiredDiagram wire_diagram(const Diagram& diagram, const Registry& registry) {
  return Builder(diagram, registry, nullptr).build();
}

WiredDiagram wire_draft(const Diagram& diagram, const Registry& registry, Gaps& gaps, Problems& problems) {
  Builder builder(diagram, registry, &gaps);
  WiredDiagram wired = builder.build();
  for (const auto& p : builder.problems().list()) problems.add(p.code, p.path, p.what, p.cure);
  return wired;
}

}  // namespace hysteron
