// Decides how the wires of one level of a diagram are followed. See wiring.h.
#include "discover/wiring/wiring.h"

#include <algorithm>
#include <set>

#include "engine/block/port_names.h"

namespace hysteron {
namespace {

/// True if `test` holds for every block of the diagram, nested ones included.
template <class Test>
bool all_blocks(const Diagram& diagram, const Registry& registry, Test test) {
  const Wiring wiring(diagram, registry);
  for (const auto& [name, node] : diagram.blocks)
    if (!test(wiring, name)) return false;
  return true;
}

}  // namespace

std::string program_signal(const Diagram& diagram, const Registry& registry, const std::string& signal) {
  const auto slash = signal.find('/');
  const Wiring w(diagram, registry);
  const Node* node = w.body(slash == std::string::npos ? w.source(signal) : signal.substr(0, slash));
  if (node == nullptr || !node->nested) return signal;
  if (slash != std::string::npos)
    return signal.substr(0, slash + 1) + program_signal(*node->nested, registry, signal.substr(slash + 1));
  const std::string block = w.source(signal);
  const std::string port = signal == block || node->nested->outputs.empty() ? "" : signal.substr(block.size() + 1);
  const std::string* inside = port.empty() ? &node->nested->outputs.begin()->second : node->nested->outputs.find(port);
  if (inside == nullptr) return signal;
  const Wiring nested(*node->nested, registry);
  if (!nested.is_input(*inside)) return block + "/" + program_signal(*node->nested, registry, nested.signal(*inside));
  const Node* wires = diagram.blocks.find(block);  // handed through
  const auto names = node->nested->inputs.names();
  for (std::size_t i = 0; i < wires->in.size() && i < names.size(); ++i)
    if (wires->in[i].port.empty() ? names[i] == *inside : wires->in[i].port == *inside)
      return program_signal(diagram, registry, w.signal(wires->in[i].from));
  return signal;
}

bool is_of_output(const std::string& name, const std::string& output) {
  return name == output || name.starts_with(output + "[");
}

std::vector<Layer> layers(const Node& choice) {
  std::vector<Layer> list;
  std::string name = choice.choose;
  for (const Node* c = choice.from.find(name); c != nullptr; c = choice.from.find(name)) {
    list.insert(list.begin(), {name, c->upon.empty() && name != "off" ? choice.effect : c->effect});
    if (c->upon.empty()) break;
    name = c->upon;
  }
  return list;
}

bool has_effect(const Node& choice, const std::string& effect) {
  return choice.effect == effect || std::any_of(choice.from.begin(), choice.from.end(), [&](const auto& candidate) {
           return candidate.second.effect == effect;
         });
}

namespace {

/// What its output is without inputs never changes.
bool stays(const Kernel& k) { return !k.uses_time && !k.declaration.is_series && k.derivative == nullptr; }

}  // namespace

Wiring::Wiring(const Diagram& diagram, const Registry& registry) : diagram_(diagram), registry_(registry) {}

const Node* Wiring::body(const std::string& block) const {
  const Node* node = diagram_.blocks.find(block);
  if (node == nullptr || node->from.empty()) return node;
  return node->from.find(node->choose);
}

std::vector<std::string> Wiring::outputs_of(const std::string& block) const {
  const Node* node = body(block);
  if (node == nullptr) return {};
  std::vector<std::string> ports;
  if (node->nested)
    ports = node->nested->outputs.names();
  else if (const KernelPointer k = kernel_of(registry_, *node))
    ports = output_names(k->declaration, *node);
  if (ports.size() == 1) return {block};
  for (auto& port : ports) port = block + "." + port;
  return ports;
}

std::string Wiring::signal(const std::string& text) const {
  if (text.find('/') != std::string::npos) return text;
  if (const auto open = text.find('['); open != std::string::npos) {  // one element of a signal
    const std::string whole = signal(text.substr(0, open));
    return whole.empty() ? "" : whole + text.substr(open);
  }
  const auto dot = text.find('.');
  const std::string head = text.substr(0, dot);
  if (is_input(head)) return dot == std::string::npos ? head : "";
  const auto made = outputs_of(head);
  if (made.size() == 1) {
    if (dot == std::string::npos) return head;
    const Node* node = body(head);
    const auto ports =
        node->nested ? node->nested->outputs.names() : output_names(kernel_of(registry_, *node)->declaration, *node);
    return ports.front() == text.substr(dot + 1) ? head : "";
  }
  return std::find(made.begin(), made.end(), text) != made.end() ? text : "";
}

std::string Wiring::source(const std::string& signal) const {
  const std::string head = signal.substr(0, signal.find_first_of("./["));
  return is_input(head) ? "" : head;
}

std::vector<Reader> Wiring::readers(const std::string& signal) const {
  std::vector<Reader> list;
  const auto note = [&](const std::string& wire, Reader reader) {
    const std::string read = this->signal(wire);
    if (read != signal && !read.starts_with(signal + "[")) return;
    reader.element = read.substr(signal.size());
    list.push_back(std::move(reader));
  };
  for (const auto& [name, node] : diagram_.blocks)
    for (std::size_t i = 0; i < node.in.size(); ++i) note(node.in[i].from, {name, static_cast<int>(i), "", ""});
  for (const auto& [name, from] : diagram_.outputs) note(from, {"", 0, name, ""});
  return list;
}

bool Wiring::is_inserted(const std::string& block) const {
  const Node* node = diagram_.blocks.find(block);
  if (node == nullptr || node->effect.empty()) return false;
  // A choice that replaced a block (vary) is a block of the user's, not one of ours on the wire.
  const Node* off = node->from.find("off");
  return off != nullptr && off->type == "pass";
}

std::vector<Reader> Wiring::followers(const std::string& signal) const {
  auto list = readers(signal);
  std::erase_if(list, [&](const Reader& r) { return r.index > 0 && is_inserted(r.block); });
  return list;
}

std::vector<std::string> Wiring::signals() const {
  auto list = diagram_.inputs.names();
  for (const auto& [name, node] : diagram_.blocks)
    for (auto& made : outputs_of(name)) list.push_back(std::move(made));
  return list;
}

std::vector<std::string> Wiring::ports(const std::string& block) const {
  const Node* node = diagram_.blocks.find(block);
  const Node* inner = body(block);
  std::vector<std::string> declared;
  std::vector<bool> variadic;
  if (inner->nested) {
    declared = inner->nested->inputs.names();
    variadic.assign(declared.size(), false);
  } else if (const KernelPointer k = kernel_of(registry_, *inner)) {
    for (const auto& port : k->declaration.inputs) {
      declared.push_back(port.name);
      variadic.push_back(port.variadic);
    }
  }
  std::vector<std::string> list;
  std::size_t next = 0;
  for (const auto& wire : node->in) {
    if (!wire.port.empty()) {
      list.push_back(wire.port);
      continue;
    }
    list.push_back(next < declared.size() ? declared[next] : "");
    if (next < declared.size() && !variadic[next]) ++next;
  }
  return list;
}

bool Wiring::has_memory(const std::string& block) const { return remembers(body(block)); }

bool Wiring::had_memory(const std::string& block) const {
  const Node* node = diagram_.blocks.find(block);
  const Node* off = node == nullptr || node->effect.empty() ? nullptr : node->from.find("off");
  return remembers(off != nullptr ? off : body(block));
}

bool Wiring::remembers(const Node* node) const {
  if (node == nullptr) return false;
  if (node->nested)
    return !all_blocks(*node->nested, registry_,
                       [](const Wiring& w, const std::string& b) { return !w.has_memory(b); });
  const KernelPointer k = kernel_of(registry_, *node);
  // What merely counts (cycles) is no memory that shapes the response.
  const bool remembers = k != nullptr && k->advance != nullptr && !k->declaration.memory_port.empty();
  return remembers || (k != nullptr && k->declaration.is_rate_independent);
}

bool Wiring::is_linear(const std::string& block) const {
  const Node* node = body(block);
  if (node == nullptr || node->runs) return false;
  if (node->nested)
    return all_blocks(*node->nested, registry_, [](const Wiring& w, const std::string& b) { return w.is_linear(b); });
  const KernelPointer k = kernel_of(registry_, *node);
  // A delay is linear and time-invariant too, though its past is no state; a constant is a linear block without inputs.
  return k != nullptr &&
         (k->declaration.is_linear || k->reach_back != nullptr || (k->declaration.inputs.empty() && stays(*k)));
}

bool Wiring::has_states(const std::string& block) const {
  const Node* node = body(block);
  if (node == nullptr) return false;
  if (node->nested)
    return !all_blocks(*node->nested, registry_,
                       [](const Wiring& w, const std::string& b) { return !w.has_states(b); });
  const KernelPointer k = kernel_of(registry_, *node);
  return k != nullptr && (k->derivative != nullptr || k->reach_back != nullptr);
}

bool Wiring::is_constant(const std::string& signal) const {
  const std::string block = source(signal);
  const Node* node = block.empty() ? nullptr : body(block);
  if (node == nullptr || node->nested) return false;
  const KernelPointer k = kernel_of(registry_, *node);
  return k != nullptr && k->declaration.inputs.empty() && stays(*k);
}

std::vector<std::string> Wiring::outputs_behind(const std::string& from, bool beside) const {
  std::set<std::string> seen;
  std::vector<std::string> open{from};
  std::set<std::string> reached;
  while (!open.empty()) {
    const std::string s = open.back();
    open.pop_back();
    if (!seen.insert(s).second) continue;
    const auto reads = [&](const std::string& wire) {  // the signal, an element of it, or the vector that it is of
      const std::string read = signal(wire);
      return read.substr(0, read.find('[')) == s.substr(0, s.find('['));
    };
    for (const auto& [name, wire] : diagram_.outputs)
      if (reads(wire)) reached.insert(name);
    for (const auto& [name, node] : diagram_.blocks)
      for (std::size_t i = 0; i < node.in.size(); ++i)
        if (reads(node.in[i].from) && (beside || i == 0 || !is_inserted(name)))
          for (auto& next : outputs_of(name)) open.push_back(std::move(next));
  }
  auto list = diagram_.outputs.names();
  std::erase_if(list, [&](const std::string& name) { return !reached.contains(name); });
  return list;
}

bool Wiring::reaches_output(const std::string& from) const { return !outputs_behind(from, true).empty(); }

std::vector<std::string> Wiring::outputs_on_the_way(const std::string& from) const {
  return outputs_behind(from, false);
}

std::vector<std::string> Wiring::chain(const std::string& signal) const {
  std::vector<std::string> list;
  std::string s = signal;
  while (list.size() < 64) {
    const auto r = followers(s);
    if (r.size() != 1 || !r.front().element.empty() || !is_inserted(r.front().block)) break;
    s = r.front().block;
    list.push_back(s);
  }
  return list;
}

bool Wiring::passes(const std::string& block, Commutes law) const {
  switch (law) {
    case Commutes::nothing:
      return false;
    case Commutes::gains:
      return is_linear(block) && !has_states(block);
    case Commutes::linear:
      return is_linear(block);
    case Commutes::time_invariant: {
      const Node* node = body(block);
      if (node->nested) return is_linear(block);
      const KernelPointer k = kernel_of(registry_, *node);
      return k != nullptr && !k->declaration.inputs.empty() && (!k->uses_time || k->reach_back != nullptr);
    }
  }
  return false;
}

std::string Wiring::root(const std::string& signal, Commutes law, int depth) const {
  const std::string block = source(signal);
  if (signal.find('[') != std::string::npos) return signal;  // a law on one element is none on all of them
  if (block.empty() || depth > 64 || body(block) == nullptr || !passes(block, law) || outputs_of(block).size() != 1)
    return signal;
  const Node* node = diagram_.blocks.find(block);
  std::string moving;
  for (const auto& wire : node->in) {
    const std::string from = this->signal(wire.from);
    if (is_constant(from)) continue;
    if (!moving.empty()) return signal;
    moving = from;
  }
  if (moving.empty() || readers(moving).size() != 1) return signal;
  return root(moving, law, depth + 1);
}

}  // namespace hysteron
