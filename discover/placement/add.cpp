// Decides how an effect enters a diagram as a choice and how it is taken out again without a trace.
#include "discover/placement/add.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "discover/placement/excitation.h"
#include "discover/placement/wire_places.h"
#include "discover/wiring/wiring.h"
#include "engine/diagram/error.h"
#include "engine/program/loop_plan.h"

namespace hysteron {
namespace {

/// Where a new block is wired in: it reads `from`, and these wires of the diagram read it.
struct Spot {
  std::string wire;  ///< gives the choice its name
  std::string from;  ///< as the readers wrote it
  std::vector<Reader> readers;
};

Spot spot_behind(const Wiring& w, const std::string& signal) {
  const auto chain = w.chain(signal);
  const std::string end = chain.empty() ? signal : chain.back();
  Spot spot{signal, end, w.readers(end)};
  if (spot.readers.empty())
    fail("unknown_place", signal, fmt::format("nothing reads the signal \"{}\"", signal),
         "name a signal that is read by a block or is an output");
  // The spelling of the first reader, so that taking the effect out gives back what stood there.
  const Reader& first = spot.readers.front();
  spot.from = first.block.empty()
                  ? *w.diagram().outputs.find(first.output)
                  : w.diagram().blocks.find(first.block)->in[static_cast<std::size_t>(first.index)].from;
  spot.from.erase(spot.from.size() - first.element.size());
  return spot;
}

Spot spot_before(const Wiring& w, const std::string& at) {
  const auto dot = at.find('.');
  const std::string block = at.substr(0, dot);
  const std::string port = at.substr(dot + 1);
  const auto& in = w.diagram().blocks.find(block)->in;
  const auto ports = w.ports(block);
  for (std::size_t i = 0; i < in.size(); ++i)
    if (ports[i] == port || (port == "in" && in.size() == 1) || port == fmt::format("in[{}]", i))
      return {w.signal(in[i].from), in[i].from, {{block, static_cast<int>(i), ""}}};
  fail("unknown_place", at, fmt::format("\"{}\" has no input \"{}\"", block, port), did_you_mean(port, ports));
}

/// Before one output alone. What is put there is called by the output.
Spot spot_of_reading(const Wiring& w, const std::string& at) {
  const std::string output = at.substr(at.find('.') + 1);
  const std::string& from = *output_of_reading(w.diagram(), at);
  return {output, from, {{"", 0, output, ""}}};
}

/// A name for a block, made of the signal that it stands on: inputs may hold capital letters, blocks may not.
std::string unused_name(const Diagram& diagram, std::string name) {
  std::erase(name, ']');
  for (char& c : name) {
    if (c == '.' || c == '/' || c == '[') c = '_';
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  const auto taken = [&](const std::string& n) {
    return diagram.blocks.find(n) != nullptr || diagram.inputs.find(n) != nullptr;
  };
  if (!taken(name)) return name;
  for (int i = 2;; ++i)
    if (const std::string next = fmt::format("{}_{}", name, i); !taken(next)) return next;
}

/// Inserts behind the block that makes `wire`; at the head of the file where that is an input of the diagram.
void place_node(Ordered<Node>& blocks, const std::string& source, const std::string& name, Node node) {
  if (!source.empty()) {
    blocks.insert_after(source, name, std::move(node));
    return;
  }
  Ordered<Node> reordered;
  reordered[name] = std::move(node);
  for (auto& [n, b] : blocks) reordered[n] = std::move(b);
  blocks = std::move(reordered);
}

/// An effect file as a diagram names it.
std::string seen_from(const Diagram& diagram, const std::string& file) {
  namespace fs = std::filesystem;
  if (diagram.file.empty()) return file;
  const auto folder = fs::weakly_canonical(fs::absolute(diagram.file)).parent_path();
  return fs::weakly_canonical(fs::absolute(file)).lexically_relative(folder).generic_string();
}

/// Axes that couple into each other pass on each their own motion (x_j += c_ij*x_i): the same effect on
/// another wire, which has this one beside it, goes on reading it without what comes back.
bool passes_on_its_own(const Wiring& w, const Reader& reader, const Effect& effect) {
  return reader.index > 0 && w.is_inserted(reader.block) && w.diagram().blocks.find(reader.block)->effect == effect.id;
}

std::string insert(Diagram& diagram, const Registry& registry, const Effect& effect, const Law& law,
                   const std::string& at, const Place& place, Added& added) {
  const Wiring w(diagram, registry);
  const std::string signal = w.signal(at);
  const Spot spot = !signal.empty()                             ? spot_behind(w, signal)
                    : output_of_reading(diagram, at) != nullptr ? spot_of_reading(w, at)
                                                                : spot_before(w, at);
  for (const auto& name : signal.empty() ? std::vector<std::string>{} : w.chain(spot.wire))
    if (diagram.blocks.find(name)->effect == effect.id)
      fail("effect_there", at, fmt::format("{} stands on \"{}\" already, as \"{}\"", effect.id, spot.wire, name),
           fmt::format("change \"{}\", or remove it first", name));
  Node choice;
  choice.choose = "on";
  choice.effect = effect.id;
  choice.in = {{"", spot.from}};
  if (!place.side.empty()) {
    choice.in.push_back({"", place.side});
    if (w.signal(place.side).empty()) diagram.inputs[place.side] = {place.side_unit.text, side_remark(effect.id), 0};
  }
  choice.from["off"].type = "pass";
  Node& on = choice.from["on"];
  on = law.block;
  if (on.nested) {
    on.file = seen_from(diagram, on.file);
    added.parts.emplace_back(on.file, *on.nested);
  }
  const std::string name = unused_name(diagram, spot.wire + "_" + effect.id);
  const std::string source = w.source(w.signal(spot.from));
  for (const auto& reader : spot.readers) {
    if (passes_on_its_own(w, reader, effect)) continue;
    if (reader.block.empty())
      *diagram.outputs.find(reader.output) = name + reader.element;
    else
      diagram.blocks.find(reader.block)->in[static_cast<std::size_t>(reader.index)].from = name + reader.element;
  }
  place_node(diagram.blocks, source, name, std::move(choice));
  return name;
}

/// A block becomes a choice between itself as it was and itself with more parameters. Its name and its readers stay.
std::string vary(Diagram& diagram, const Effect& effect, const Law& law, const std::string& block) {
  Node* node = diagram.blocks.find(block);
  if (node == nullptr)
    fail("unknown_place", block, fmt::format("there is no block \"{}\"", block),
         did_you_mean(block, diagram.blocks.names()));
  const auto with_law = [&](Node as_is) {
    if (!law.block.type.empty()) as_is.type = law.block.type;
    for (const auto& [name, value] : law.block.parameters) as_is.parameters[name] = value;
    return as_is;
  };
  if (!node->from.empty()) {
    // A choice already (an effect found before, or the user's own): one more candidate, named after this effect.
    if (has_effect(*node, effect.id))
      fail("effect_there", block, fmt::format("\"{}\" has {} already", block, effect.id),
           "change its value, or remove it first");
    Node with_both = with_law(*node->from.find(node->choose));
    with_both.effect = effect.id;
    with_both.upon = node->choose;
    std::string name = effect.id;
    for (int i = 2; node->from.find(name) != nullptr; ++i) name = fmt::format("{}_{}", effect.id, i);
    node->from[name] = std::move(with_both);
    node->choose = name;
    return block;
  }
  Node choice;
  choice.in = std::move(node->in);
  choice.origin = node->origin;
  node->in.clear();
  choice.from["off"] = *node;
  choice.from["on"] = with_law(std::move(*node));
  choice.choose = "on";
  choice.effect = effect.id;
  *node = std::move(choice);
  return block;
}

/// "p753.json" -> "p753_creep.json": a nested diagram that got an effect is another file.
std::string changed_file(const std::string& file, const std::string& effect) {
  const std::filesystem::path p(file);
  return (p.parent_path() / (p.stem().string() + "_" + effect + p.extension().string())).generic_string();
}

std::string add_at(Diagram& diagram, const Registry& registry, const Effect& effect, const Law& law,
                   const std::string& at, const Place& place, Added& added) {
  const auto slash = at.find('/');
  if (slash == std::string::npos)
    return effect.way == Way::vary || !place.by.empty() ? vary(diagram, effect, law, at)
                                                        : insert(diagram, registry, effect, law, at, place, added);
  const std::string head = at.substr(0, slash);
  Node* node = diagram.blocks.find(head);
  if (node != nullptr && !node->from.empty()) node = node->from.find(node->choose);
  if (node == nullptr || !node->nested)
    fail("unknown_place", at, fmt::format("there is no nested diagram \"{}\"", head),
         did_you_mean(head, diagram.blocks.names()));
  Diagram inner = *node->nested;
  const std::string name = head + "/" + add_at(inner, registry, effect, law, at.substr(slash + 1), place, added);
  node->file = changed_file(node->file, effect.id);
  inner.file = inner.file.empty() ? "" : changed_file(inner.file, effect.id);
  added.nested.emplace_back(node->file, inner);
  node->nested = std::make_shared<const Diagram>(std::move(inner));
  return name;
}

/// What the diagram says of a place without data: the unit of its wire, in which a law that enters there has its
/// thresholds, and what damping is behind it.
Excitation without_data(const Diagram& diagram, const Registry& registry, const Place& place) {
  Excitation c;
  c.by = place.by;
  const auto program = compile(diagram, registry);
  if (const int signal = program->find_signal(place.wire); signal >= 0)
    c.unit = program->signals[static_cast<std::size_t>(signal)].unit;
  c.damping = damping_behind(*program, place, c.unit);
  c.inertia = inertia_before(*program, place);
  return c;
}

}  // namespace

Added add_effect(const Diagram& diagram, const Registry& registry, const Effect& effect, const Law& law,
                 const Place& place) {
  Added added;
  added.diagram = diagram;
  added.effect = effect.id;
  added.at = place.at;
  added.law = law.name;
  added.name = add_at(added.diagram, registry, effect, law, place.at, place, added);
  for (const auto& p : law.free) added.free.push_back(parameter_path(added.name, law, p));
  return added;
}

Added add_effect(const Diagram& diagram, const Registry& registry, const Effect& effect, const std::string& at,
                 const Excitation* excitation, const DataSet* data) {
  const Place place = place_for(effect, diagram, registry, at, data);
  const auto laws = effect.laws(excitation != nullptr ? *excitation : without_data(diagram, registry, place));
  Added added = add_effect(diagram, registry, effect, laws.front(), place);
  if (excitation == nullptr)
    added.remarks.push_back(fmt::format(
        "the numbers of {} are placeholders (signal 0 .. 1, rows every 1 ms, 100 s long): fit them, or add with data",
        added.name));
  if (at.empty())
    added.remarks.push_back(fmt::format("put at {} ({}); name another place with --at", place.at, place.kind));
  return added;
}

void refuse_new_loop(const Program& before, const Program& after, const std::string& at) {
  const auto loops = [](const Program& p) {
    return std::count_if(p.loops.begin(), p.loops.end(), [](const Loop& loop) { return loop.needed; });
  };
  if (loops(after) <= loops(before)) return;
  std::string ways;
  for (const auto& loop : after.loops)
    if (loop.needed) ways += (ways.empty() ? "" : "; ") + to_text(after, loop.path);
  fail("closes_loop", at, fmt::format("the effect would close an algebraic loop there: {}", ways),
       "put it at another place, or a block with a state into the loop (a lag: the amplifier's or sensor's dynamics)");
}

}  // namespace hysteron
