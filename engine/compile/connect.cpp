#include "engine/compile/connect.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "engine/compile/unused.h"

namespace hysteron {
namespace {

class Connector {
 public:
  Connector(Scopes& scopes, Gaps* gaps, WiredDiagram& wired, Problems& problems)
      : scopes_(scopes), gaps_(gaps), wired_(wired), problems_(problems) {}

  void connect_blocks() {
    for (int s = 0; s < static_cast<int>(scopes_.size()); ++s)
      for (const auto& name : scopes_[s].order) {
        const BlockOfScope& entry = scopes_[s].blocks.at(name);
        const Node& wires =
            entry.body == nullptr || !entry.body->in.empty() ? (entry.body ? *entry.body : *entry.node) : *entry.node;
        if (entry.leaf >= 0) wire_leaf(s, entry, wires);
        if (entry.scope >= 0) check_nested_wires(s, entry, wires);
        if (entry.leaf < 0 && entry.scope < 0) {
          wired_.left_out.push_back(scopes_[s].scope.prefix + name);
          // The wires of a block that is not there may be wrong, too.
          for (const Wire& wire : wires.in) scopes_.resolve(s, wire.from, entry.origin + "/in");
        }
      }
  }

  void connect_enablings(const std::vector<EnablingWire>& wires) {
    for (const auto& wire : wires) {
      WiredBlock& b = wired_.blocks[static_cast<std::size_t>(wire.leaf)];
      PortEnd end = scopes_.resolve(wire.scope, wire.from, wire.place);
      if (end.block < 0) end = open_end(scopes_[wire.scope].scope.prefix + wire.from);
      b.place = wire.place;
      b.wires.push_back(std::move(end));
      if (wire.outer >= 0) b.wires.push_back({wire.outer, 0, -1, {}, wire.place});
      b.port.assign(b.wires.size(), 0);
      b.shape.inputs = static_cast<int>(b.wires.size());
    }
  }

  void name_outputs() {
    const Diagram& top = *scopes_[0].scope.diagram;
    for (const auto& [name, signal] : top.outputs)
      if (PortEnd end = scopes_.resolve(0, signal, "/outputs/" + name); end.block >= 0)
        wired_.outputs.emplace_back(name, std::move(end));
    for (std::size_t i = 0; i < top.record.size(); ++i)
      if (PortEnd end = resolve_recorded(top, top.record[i], fmt::format("/record/{}", i)); end.block >= 0)
        wired_.record.push_back(std::move(end));
    for (const auto& [kind, wires] : top.places)
      for (const auto& wire : wires) {
        const auto dot = wire.find('.');
        // A place may name an input port ("stage.in"): then the block itself must exist.
        if (dot != std::string::npos && (wire.substr(dot + 1) == "in" || is_input_port(wire))) continue;
        if (PortEnd end = scopes_.resolve(0, wire, "/places/" + kind); end.block >= 0)
          wired_.places_read.push_back(std::move(end));
      }
  }

 private:
  /// The end in place of one that is missing; of a finished diagram there is none.
  PortEnd open_end(const std::string& name) {
    if (gaps_ == nullptr) return {};
    gaps_->open.insert(name);
    return scopes_.input(name);
  }

  void wire_leaf(int index, const BlockOfScope& entry, const Node& wires) {
    WiredBlock& b = wired_.blocks[static_cast<std::size_t>(entry.leaf)];
    const auto& ports = b.kernel->declaration.inputs;
    const bool is_choice = !entry.node->from.empty();
    const std::string place = entry.origin + "/in";
    b.place = place;
    std::vector<std::vector<PortEnd>> sources(ports.size());
    std::size_t next = 0;
    for (const Wire& wire : wires.in) {
      PortEnd end = scopes_.resolve(index, wire.from, place);
      if (end.block < 0) end = open_end(scopes_[index].scope.prefix + wire.from);
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

  void check_nested_wires(int index, const BlockOfScope& entry, const Node& wires) {
    const ScopeOfBlocks& inner = scopes_[entry.scope];
    const auto& inputs = inner.scope.diagram->inputs;
    const auto names = inputs.names();
    const std::string place = entry.origin + "/in";
    std::set<std::string> seen;
    for (std::size_t i = 0; i < wires.in.size(); ++i) {
      PortEnd end = scopes_.resolve(index, wires.in[i].from, place);
      const std::string port = wires.in[i].port.empty() ? (i < names.size() ? names[i] : "") : wires.in[i].port;
      if (inputs.find(port) == nullptr)
        problems_.add("unknown_input", place,
                      port.empty()
                          ? fmt::format("the nested diagram takes {} inputs, found {}", names.size(), wires.in.size())
                          : fmt::format("the nested diagram has no input \"{}\"", port),
                      did_you_mean(port, names));
      else if (!seen.insert(port).second)
        problems_.add("double_connection", place,
                      fmt::format("input \"{}\" of the nested diagram is connected twice", port), "keep one wire");
      else if (const int length = inputs.find(port)->length; length > 0 && end.block >= 0)
        wired_.stated.push_back({std::move(end), length, inner.scope.prefix + port});
    }
    for (const auto& name : names)
      if (!seen.contains(name))
        problems_.add("missing_connection", place,
                      fmt::format("input \"{}\" of the nested diagram is not connected", name),
                      "say where it comes from");
  }

  /// A signal, or an output of the diagram ("y", "y[1]") where no block and no input has this name.
  PortEnd resolve_recorded(const Diagram& top, const std::string& name, const std::string& place) {
    const auto open = name.find('[');
    const std::string* wire = top.outputs.find(name.substr(0, open));
    const std::string head = head_of_wire(name);
    if (wire == nullptr || top.blocks.find(head) != nullptr || top.inputs.find(head) != nullptr)
      return scopes_.resolve(0, name, place);
    return scopes_.resolve(0, open == std::string::npos ? *wire : *wire + name.substr(open), place);
  }

  bool is_input_port(const std::string& wire) const {
    const auto dot = wire.find('.');
    const auto found = scopes_[0].blocks.find(wire.substr(0, dot));
    if (found == scopes_[0].blocks.end() || found->second.leaf < 0) return false;
    const auto names = wired_.blocks[static_cast<std::size_t>(found->second.leaf)].kernel->declaration.input_names();
    return std::find(names.begin(), names.end(), wire.substr(dot + 1)) != names.end();
  }

  Scopes& scopes_;
  Gaps* gaps_;
  WiredDiagram& wired_;
  Problems& problems_;
};

}  // namespace

void connect(Scopes& scopes, const std::vector<EnablingWire>& enabling_wires, Gaps* gaps, WiredDiagram& wired,
             Problems& problems) {
  Connector connector(scopes, gaps, wired, problems);
  connector.connect_blocks();
  connector.connect_enablings(enabling_wires);
  connector.name_outputs();
}

}  // namespace hysteron
