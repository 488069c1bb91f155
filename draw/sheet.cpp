#include "draw/sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "engine/block/instance.h"
#include "engine/block/port_names.h"

namespace hysteron::draw {
namespace {

constexpr std::size_t lines_of_values = 4;

/// An item and one of its outputs.
struct Source {
  int item = -1;
  int out = 0;
};

int index_of(const std::vector<std::string>& list, const std::string& name) {
  const auto found = std::find(list.begin(), list.end(), name);
  return found == list.end() ? -1 : static_cast<int>(found - list.begin());
}

/// One diagram becomes one sheet; nested ones that are open become sheets of their own.
class Maker {
 public:
  /// `draft`: what is wrong or unfinished is drawn as far as it goes; else it is an error.
  Maker(const Program* program, const Registry& registry, bool draft)
      : program_(program), registry_(registry), draft_(draft) {}

  /// `outputs`: names of the sheet's outputs and what they read; `prefix`: "stage/" inside the block stage.
  Sheet make(const Diagram& diagram, const Ordered<std::string>& outputs, const std::string& prefix,
             const Surroundings& around, int depth) {
    Sheet sheet;
    std::map<std::string, int> at;
    for (const auto& [name, input] : diagram.inputs) {
      at[name] = static_cast<int>(sheet.items.size());
      sheet.items.push_back(port(prefix + name, name, "input", input.remark));
      sheet.items.back().out = {"y"};
      sheet.items.back().out_lengths = {length_of_path(prefix + name)};
      sheet.items.back().out_units = {with_length(input.unit, sheet.items.back().out_lengths[0])};
    }
    for (const auto& [name, signal] : around.node == nullptr ? Signals{} : switching_wires(*around.node)) {
      sheet.items.push_back(port(prefix + name, name, "input", "read from outside: " + signal));
      sheet.items.back().out = {"y"};
      sheet.items.back().out_lengths = {1};
      sheet.items.back().out_units = {""};
    }
    const auto reached = reached_inside(diagram, outputs);
    for (const auto& [name, node] : diagram.blocks) {
      at[name] = static_cast<int>(sheet.items.size());
      const auto further = reached.find(name);
      sheet.items.push_back(item(name, node, prefix, around, depth,
                                 further == reached.end() ? std::set<std::string>{} : further->second));
    }
    for (const auto& [name, node] : diagram.blocks) connect(sheet, at, at.at(name), prefix);
    for (const auto& [name, signal] : outputs) {
      sheet.items.push_back(port(prefix + name, name, "output", ""));
      sheet.items.back().in = {"u"};
      sheet.items.back().reads = {signal};
      connect(sheet, at, static_cast<int>(sheet.items.size()) - 1, prefix);
    }
    return sheet;
  }

 private:
  using Signals = std::vector<std::pair<std::string, std::string>>;  ///< port, what is wired to it

  static Item port(const std::string& path, const std::string& name, const std::string& type, const std::string& tip) {
    Item port;
    port.path = path;
    port.name = name;
    port.type = type;
    port.tip = type + " " + name + (tip.empty() ? "" : ": " + tip);
    port.symbol.outline = Outline::port;
    port.symbol.text = {name};
    port.symbol.width = std::max(34.0, std::ceil(text_width(name, 11)) + 20);
    port.symbol.height = 22;
    return port;
  }

  /// What enables and triggers a nested diagram, as ports behind its inputs.
  static Signals switching_wires(const Node& body) {
    Signals list;
    if (body.runs && !body.runs->enable.empty()) list.emplace_back("enable", body.runs->enable);
    if (body.runs && !body.runs->trigger.empty()) list.emplace_back("trigger", body.runs->trigger);
    return list;
  }

  /// What the picture cannot show of them.
  static std::string switching_tip(const RunsWhen& runs) {
    std::string tip;
    if (!runs.enable.empty())
      tip += fmt::format("\nruns while {} is true; else its outputs {}, and its states {}", runs.enable,
                         runs.zeroes_outputs ? "are zero" : "stay", runs.resets_states ? "begin anew" : "stay");
    if (!runs.trigger.empty())
      tip += fmt::format("\nruns once at each {} of {}", runs.edge == "either" ? "edge" : runs.edge + " edge",
                         runs.trigger);
    return tip;
  }

  /// Per nested diagram: the signals further inside that somebody outside reads ("play" of "stage/play").
  static std::map<std::string, std::set<std::string>> reached_inside(const Diagram& diagram,
                                                                     const Ordered<std::string>& outputs) {
    std::map<std::string, std::set<std::string>> reached;
    const auto look = [&](const std::string& signal) {
      const auto slash = signal.find('/');
      if (slash != std::string::npos) reached[signal.substr(0, slash)].insert(signal.substr(slash + 1));
    };
    for (const auto& [name, node] : diagram.blocks) {
      for (const auto& wire : node.in) look(wire.from);
      for (const auto& [port, signal] : switching_wires(node)) look(signal);
      if (const Node* candidate = node.from.find(node.choose))
        for (const auto& wire : candidate->in) look(wire.from);
      if (const Node* candidate = node.from.find(node.choose))
        for (const auto& [port, signal] : switching_wires(*candidate)) look(signal);
    }
    for (const auto& [name, signal] : outputs) look(signal);
    return reached;
  }

  Item item(const std::string& name, const Node& node, const std::string& prefix, const Surroundings& around, int depth,
            const std::set<std::string>& further) {
    const Node& body = body_of(node, prefix + name);
    Item item;
    item.path = prefix + name;
    item.name = name;
    item.candidates = static_cast<int>(node.from.size());
    item.chosen = node.choose;
    if (body.nested)
      nested(item, node, around, depth, further);
    else if (draft_)
      draft_block(item, node, body, around);
    else
      block(item, node, body, around);
    if (item.candidates > 1)
      item.tip += fmt::format("\nchoice: {} of {}", item.chosen, fmt::format("{}", fmt::join(node.from.names(), ", ")));
    return item;
  }

  const Node& body_of(const Node& node, const std::string& path) const {
    if (node.from.empty()) return node;
    const Node* candidate = node.from.find(node.choose);
    if (candidate == nullptr && draft_) return node.from.begin()->second;
    if (candidate == nullptr)
      fail("bad_choice", path, fmt::format("there is no candidate \"{}\"", node.choose),
           did_you_mean(node.choose, node.from.names()));
    return *candidate;
  }

  void block(Item& item, const Node& node, const Node& body, const Surroundings& around) {
    const KernelPointer kernel = kernel_of(registry_, body);
    if (kernel == nullptr)
      fail("unknown_block", item.path, fmt::format("there is no block type \"{}\"", body.type),
           did_you_mean(body.type, registry_.types()));
    const Declaration& declaration = kernel->declaration;
    item.type = body.type;
    for (const auto& [port, from] : ports_of(declaration, wires_of(node, body))) {
      item.in.push_back(port);
      item.reads.push_back(from);
    }
    item.out = output_names(declaration, body);
    for (const auto& port : item.out) tell_signal(item, item.out.size() == 1 ? item.path : item.path + "." + port);
    const Values values = values_of(body, declaration, around);
    item.symbol = symbol_of(declaration, values, static_cast<int>(item.in.size()), static_cast<int>(item.out.size()));
    keep_clear_of_port_names(item);
    item.caption = caption_lines(values, item.symbol.shown, lines_of_values);
    item.tip = fmt::format("{}: {} ({})", item.path, body.type, declaration.summary);
    if (!declaration.equation.empty()) item.tip += "\n" + declaration.equation;
    for (const auto& line : caption_lines(values, {}, 100)) item.tip += "\n" + line;
  }

  /// Of a block that cannot be drawn as its type says, what can be said: a box with the name of its type.
  void draft_block(Item& item, const Node& node, const Node& body, const Surroundings& around) {
    const Item named = item;
    try {
      block(item, node, body, around);
    } catch (const Error& error) {
      item = named;
      item.type = body.type;
      for (const auto& wire : wires_of(node, body)) {
        item.in.push_back(wire.port);
        item.reads.push_back(wire.from);
      }
      item.out = {"y"};
      item.out_lengths = {1};
      item.out_units = {""};
      item.symbol = text_symbol({body.type.empty() ? "?" : body.type}, static_cast<int>(item.in.size()), 1);
      item.tip = error.problems.front().what;
    }
  }

  void nested(Item& item, const Node& node, const Surroundings& around, int depth,
              const std::set<std::string>& further) {
    const Node& body = body_of(node, item.path);
    const Diagram& inner = *body.nested;
    item.type = "diagram";
    item.in = inner.inputs.names();
    item.reads.resize(item.in.size());
    const auto& wires = wires_of(node, body);
    for (std::size_t i = 0; i < wires.size(); ++i) {
      const int port = wires[i].port.empty() ? static_cast<int>(i) : index_of(item.in, wires[i].port);
      if (port >= 0 && port < static_cast<int>(item.in.size()))
        item.reads[static_cast<std::size_t>(port)] = wires[i].from;
    }
    for (const auto& [port, signal] : switching_wires(body)) {
      item.in.push_back(port);
      item.reads.push_back(signal);
    }
    Ordered<std::string> outputs = inner.outputs;
    for (const auto& signal : further) outputs[signal] = signal;
    item.out = outputs.names();
    for (const auto& [name, signal] : outputs) tell_signal(item, item.path + "/" + signal);
    for (const auto& [name, value] : body.parameters) {
      const ParameterDeclaration plain{.name = name, .unit = "", .meaning = ""};
      item.caption.push_back(name + " " + value_text(resolved(value, around), plain));
    }
    if (item.caption.size() > lines_of_values) item.caption.resize(lines_of_values), item.caption.back() = "…";
    item.tip = fmt::format("{}: {}", item.path, inner.title.empty() ? "a diagram" : inner.title);
    if (!body.file.empty()) item.tip += "\n" + body.file;
    if (body.runs) item.tip += switching_tip(*body.runs);
    if (depth > 0) {
      const Surroundings inside{&inner, &body, &around};
      item.inside = std::make_shared<Sheet>(make(inner, outputs, item.path + "/", inside, depth - 1));
      item.symbol.outline = Outline::frame;
      return;
    }
    const std::string text = body.file.empty() ? "diagram" : std::filesystem::path(body.file).stem().string();
    item.symbol = text_symbol({text}, static_cast<int>(item.in.size()), static_cast<int>(item.out.size()));
    item.symbol.outline = Outline::frame;
    item.symbol.port_names = true;
    keep_clear_of_port_names(item);
  }

  /// What stands in the middle is as far from either border as the longer names there reach.
  static void keep_clear_of_port_names(Item& item) {
    Symbol& s = item.symbol;
    if (!s.port_names || !s.signs.empty()) return;
    double middle = s.picture.empty() ? 0 : pictogram_width, names = 0;
    for (const auto& line : s.text) middle = std::max(middle, text_width(line, 12));
    for (const auto& port : item.in) names = std::max(names, text_width(port, 9));
    if (item.out.size() > 1)
      for (const auto& port : item.out) names = std::max(names, text_width(port, 9));
    if (middle > 0) s.width = std::max(s.width, std::ceil(middle + 2 * names) + 22);
  }

  static Value resolved(const Value& value, const Surroundings& around) {
    Node one;
    one.parameters["value"] = value;
    Declaration declaration;
    declaration.parameter("value", "", "");
    return values_of(one, declaration, around).list.front().second;
  }

  // --- wires --------------------------------------------------------------------------------------------------------

  static const std::vector<hysteron::Wire>& wires_of(const Node& node, const Node& body) {
    return body.in.empty() ? node.in : body.in;
  }

  /// Port names and their wires in the order of the declaration. What the chosen candidate has no port for is left out.
  /// In a draft also ports that nothing is wired to: their wire is "".
  std::vector<std::pair<std::string, std::string>> ports_of(const Declaration& declaration,
                                                            const std::vector<hysteron::Wire>& wires) const {
    std::vector<std::vector<std::string>> per_port(declaration.inputs.size());
    std::size_t next = 0;
    for (const auto& wire : wires) {
      std::size_t port = next;
      if (!wire.port.empty())
        port = static_cast<std::size_t>(index_of(declaration.input_names(), wire.port));
      else if (port < per_port.size() && !declaration.inputs[port].variadic)
        ++next;
      if (port < per_port.size()) per_port[port].push_back(wire.from);
    }
    std::vector<std::pair<std::string, std::string>> result;
    for (std::size_t i = 0; i < per_port.size(); ++i) {
      if (draft_ && per_port[i].empty()) per_port[i].emplace_back();
      for (const auto& from : per_port[i]) result.emplace_back(declaration.inputs[i].name, from);
    }
    return result;
  }

  void connect(Sheet& sheet, const std::map<std::string, int>& at, int to, const std::string& prefix) {
    const std::vector<std::string> reads = sheet.items[static_cast<std::size_t>(to)].reads;
    for (std::size_t i = 0; i < reads.size(); ++i)
      if (!reads[i].empty()) add_wire(sheet, at, reads[i], to, static_cast<int>(i), prefix);
  }

  void add_wire(Sheet& sheet, const std::map<std::string, int>& at, const std::string& signal, int to, int in,
                const std::string& prefix) {
    const Source source = source_of(sheet, at, signal);
    if (source.item < 0) return;
    Wire wire;
    wire.from = source.item;
    wire.out = source.out;
    wire.to = to;
    wire.in = in;
    wire.signal = prefix + signal;
    sheet.wires.push_back(std::move(wire));
  }

  /// The item and output that a signal's name means: "drive", "stage.displacement", "stage/play", "tilt[1]". In a
  /// draft nothing, where there is none.
  Source source_of(const Sheet& sheet, const std::map<std::string, int>& at, const std::string& signal) const {
    const std::string name = signal.substr(0, signal.find_first_of("./["));
    const auto found = at.find(name);
    if (found == at.end() && draft_) return {};
    if (found == at.end())
      fail("unknown_signal", signal, fmt::format("there is no signal \"{}\"", signal),
           "check the diagram with hysteron check");
    const Item& item = sheet.items[static_cast<std::size_t>(found->second)];
    std::string port = signal.size() > name.size() ? signal.substr(name.size() + 1) : "";
    if (!signal.starts_with(name + "/")) port = port.substr(0, port.find('['));
    return {found->second, std::max(0, index_of(item.out, port))};
  }

  // --- units --------------------------------------------------------------------------------------------------------

  /// What the wires of the next output carry.
  void tell_signal(Item& item, const std::string& path) const {
    item.out_lengths.push_back(length_of_path(path));
    item.out_units.push_back(with_length(unit_of_path(path), item.out_lengths.back()));
  }

  /// Elements of a vector stand in the program as "tilt[0]", "tilt[1]" ...
  int length_of_path(const std::string& path) const {
    int n = 0;
    while (program_ != nullptr && program_->find_signal(fmt::format("{}[{}]", path, n)) >= 0) ++n;
    return std::max(n, 1);
  }

  /// "" also where the elements of a vector have different units.
  std::string unit_of_path(const std::string& path) const {
    if (program_ == nullptr) return "";
    const auto unit = [&](const std::string& name) -> std::string {
      const int signal = program_->find_signal(name);
      return signal < 0 ? "" : program_->signals[static_cast<std::size_t>(signal)].unit.text;
    };
    if (program_->find_signal(path) >= 0) return unit(path);
    const std::string first = unit(path + "[0]");
    for (int k = 1; k < length_of_path(path); ++k)
      if (unit(fmt::format("{}[{}]", path, k)) != first) return "";
    return first;
  }

  static std::string with_length(const std::string& unit, int length) {
    if (length == 1) return unit;
    return unit.empty() ? fmt::format("[{}]", length) : fmt::format("{} [{}]", unit, length);
  }

  const Program* program_;
  const Registry& registry_;
  bool draft_;
};

double from_middle(int port, std::size_t ports) {
  return port_distance * (port - (static_cast<double>(ports) - 1) / 2);
}

}  // namespace

Sheet sheet_of(const Diagram& diagram, const Program& program, const Registry& registry, int depth) {
  const Surroundings around{&diagram, nullptr, nullptr};
  return Maker(&program, registry, false).make(diagram, diagram.outputs, "", around, depth);
}

Sheet draft_sheet(const Diagram& diagram, const Program* program, const Registry& registry, int depth) {
  const Surroundings around{&diagram, nullptr, nullptr};
  return Maker(program, registry, true).make(diagram, diagram.outputs, "", around, depth);
}

namespace {

/// Height of a port of an open diagram: where its port stands inside.
double inner_port(const Sheet& inside, const std::string& type, int port) {
  int seen = 0;
  for (const auto& item : inside.items)
    if (item.type == type && seen++ == port) return header_height + item.y + item.height() / 2;
  return 0;
}

}  // namespace

Point in_port(const Item& item, int port) {
  const double middle = item.height() / 2;
  if (item.inside) return {0, inner_port(*item.inside, "input", port)};
  if (item.symbol.outline == Outline::circle) {
    const Side side =
        static_cast<std::size_t>(port) < item.side.size() ? item.side[static_cast<std::size_t>(port)] : Side::left;
    if (side == Side::left) return {0, middle};
    return {item.width() / 2, side == Side::top ? 0 : item.height()};
  }
  return {0, middle + from_middle(port, item.in.size())};
}

Point out_port(const Item& item, int port) {
  if (item.inside) return {item.width(), inner_port(*item.inside, "output", port)};
  return {item.width(), item.height() / 2 + from_middle(port, item.out.size())};
}

Room room_of(const Item& item) {
  const double half = item.width() / 2;
  if (item.is_port() || item.inside) return {half, half, 0};
  const double choice = item.candidates > 1 ? 12 : 0;
  const double below = 16 + choice + 12 * static_cast<double>(item.caption.size());
  const double name = std::ceil(text_width(item.name, 12) * 1.08);  // bold
  if (item.symbol.outline == Outline::circle) return {half, sum_name_offset + name, below};
  double width = std::max(item.width(), name);
  if (item.candidates > 1) width = std::max(width, text_width(item.chosen, 10) + 50);
  for (const auto& line : item.caption) width = std::max(width, text_width(line, 10));
  return {std::ceil(width / 2), std::ceil(width / 2), below};
}

}  // namespace hysteron::draw
