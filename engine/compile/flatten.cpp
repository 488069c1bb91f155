// Decides what a diagram is made of once choices are taken and nested diagrams are put in place: leaf blocks, and those
// that enable others. What names mean: scopes.cpp; which wire goes where: connect.cpp. Does not look at lengths
// (lengths.cpp), units (unit_check.cpp) nor the order of evaluation (order.cpp).
#include "engine/compile/flatten.h"

#include <fmt/format.h>

#include <deque>

#include "engine/block/instance.h"
#include "engine/compile/connect.h"
#include "engine/compile/resolve.h"
#include "engine/compile/scopes.h"

namespace hysteron {
namespace {

class Builder {
 public:
  /// `gaps`: of a draft, else null.
  Builder(const Diagram& diagram, const Registry& registry, Gaps* gaps) : registry_(registry), gaps_(gaps) {
    scopes_.add(diagram, "", -1, nullptr, nullptr, "");
  }

  WiredDiagram build() {
    check_wire_names();
    collect(0);
    stop_if_wrong();  // names and types first: wires of unknown blocks would only repeat the message
    connect(scopes_, enabling_wires_, gaps_, wired_, problems_);
    scopes_.check_unused();
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

  void add_open_ends() {
    const Kernel* kernel = registry_.find("input");
    if (gaps_ == nullptr || kernel == nullptr) return;
    static const Node empty;
    for (const auto& name : gaps_->open) {
      if (scopes_.has_input(name)) continue;  // an input of the diagram whose unit is not known
      const int leaf = add_leaf(0, name, *kernel, empty, "");
      scopes_.add_input(name, leaf);
      wired_.open.emplace_back(name, leaf);
    }
  }

  // --- blocks -------------------------------------------------------------------------------------------------------

  void collect(int index) {
    const Diagram& diagram = *scopes_[index].scope.diagram;
    if (index == 0) {
      add_inputs(diagram);
      add_open_ends();
    }
    for (const auto& [name, node] : diagram.blocks) {
      BlockOfScope entry;
      entry.node = &node;
      entry.origin = node.origin.empty() ? "/blocks/" + name : node.origin;
      if (diagram.inputs.find(name) != nullptr)
        problems_.add("duplicate_name", entry.origin, fmt::format("\"{}\" is both an input and a block", name),
                      "rename one of them");
      entry.body = chosen(node, name, entry.origin);
      if (entry.body != nullptr) add_block(index, name, entry);
      auto& scope = scopes_[index];
      scope.blocks[name] = std::move(entry);
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
      BlockOfScope entry{&empty, &empty, -1, -1, "/inputs/" + name};
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
      scopes_.add_input(name, entry.leaf);
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

  void add_block(int index, const std::string& name, BlockOfScope& entry) {
    const Node& body = *entry.body;
    const std::string prefix = scopes_[index].scope.prefix;
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
      entry.scope = scopes_.add(*body.nested, prefix + name + "/", index, &body, entry.node, origin);
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
  void enable(int index, const std::string& name, const std::string& origin, BlockOfScope& entry) {
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

  int add_enabling(int index, const BlockOfScope& entry, const std::string& name, const std::string& port,
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
    ScopeOfBlocks& inner = scopes_[entry.scope];
    wired_.blocks.back().enabling = -1;  // it says whether others run, and itself always does
    const int outer = inner.enabling;
    enabling_wires_.push_back(
        {leaf, index, wire, place, outer < 0 ? -1 : wired_.enablings[static_cast<std::size_t>(outer)].block});
    Enabling enabling;
    enabling.block = leaf;
    enabling.outer = outer;
    enabling.path = scopes_[index].scope.prefix + name;
    inner.enabling = static_cast<int>(wired_.enablings.size());
    wired_.enablings.push_back(std::move(enabling));
    return leaf;
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
    const Scope& scope = scopes_[index].scope;
    WiredBlock b;
    b.path = scope.prefix + name;
    b.origin = origin;
    b.kernel = &kernel;
    const std::size_t problems_before = problems_.list().size();
    b.enabling = scopes_[index].enabling;
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

  void check_wire_names() {
    const Diagram& top = *scopes_[0].scope.diagram;
    if (top.blocks.empty())
      problems_.add("empty_diagram", "/blocks", "the diagram has no blocks", "add at least one block");
  }

  const Registry& registry_;
  Gaps* gaps_;
  std::deque<Node> enabling_nodes_;  // a deque: nodes stay where they are
  std::vector<EnablingWire> enabling_wires_;
  Problems problems_;
  WiredDiagram wired_;
  Scopes scopes_{wired_.blocks, problems_};  // behind what it refers to
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
