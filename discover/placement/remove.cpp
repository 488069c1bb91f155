// Decides how an effect is taken out of a diagram again. See add.h.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "discover/placement/add.h"
#include "discover/wiring/wiring.h"
#include "engine/diagram/error.h"

namespace hysteron {
namespace {

void collect_effects(const Diagram& diagram, const std::string& prefix,
                     std::vector<std::pair<std::string, std::string>>& list) {
  for (const auto& [name, node] : diagram.blocks) {
    if (!node.effect.empty()) list.emplace_back(prefix + name, node.effect);
    for (const auto& layer : layers(node))
      if (!layer.effect.empty() && layer.effect != node.effect) list.emplace_back(prefix + name, layer.effect);
    const Node* body = node.from.empty() ? &node : node.from.find(node.choose);
    if (body != nullptr && body->nested) collect_effects(*body->nested, prefix + name + "/", list);
  }
}

/// The type that has all these parameters: that of `before`, else one by which it may be varied.
std::string type_for(const Node& before, const Node& with_parameters, const Registry& registry) {
  const auto has_all = [&](const std::string& type) {
    const Kernel* k = registry.find(type);
    return k != nullptr && std::all_of(with_parameters.parameters.begin(), with_parameters.parameters.end(),
                                       [&](const auto& p) { return k->declaration.parameter_index(p.first) >= 0; });
  };
  const KernelPointer k = kernel_of(registry, before);
  if (k == nullptr || has_all(before.type)) return before.type;
  for (const auto& v : k->declaration.variations) {
    const bool meant = std::any_of(v.null_value.begin(), v.null_value.end(), [&](const auto& null_value) {
      return with_parameters.parameters.find(null_value.parameter) != nullptr;
    });
    if (meant && has_all(v.type)) return v.type;
  }
  return with_parameters.type;
}

/// What an effect made of the block `before` is taken out of `later`, which stands upon that.
void take_from(Node& later, const Node& before, const Node& with_effect, const Registry& registry) {
  for (const auto& [name, value] : with_effect.parameters) {
    const Value* was = before.parameters.find(name);
    const auto* chosen_law = std::get_if<std::string>(&value.content);
    if (was == nullptr)
      later.parameters.erase(name);
    else if (chosen_law != nullptr)  // numbers are fitted beside an effect, words are its own
      later.parameters[name] = *was;
  }
  if (later.type == with_effect.type) later.type = type_for(before, later, registry);
}

/// `later` came to stand upon a law that an effect put there, and varies it: without that law it is nothing.
void refuse_without_its_law(const Node& later, const Node& with_effect, const std::string& effect,
                            const Registry& registry) {
  const KernelPointer k = kernel_of(registry, later);
  if (k == nullptr) return;
  for (const auto& p : k->declaration.parameters) {
    const bool taken = with_effect.parameters.find(p.name) != nullptr && later.parameters.find(p.name) == nullptr;
    if (taken && !p.default_text)
      fail("stood_upon", effect,
           fmt::format("{} changes the {} that {} put there, and is nothing without it", later.effect, later.type,
                       effect),
           fmt::format("remove {} first", later.effect));
  }
}

bool stands_upon(const Node& choice, const Node& candidate, const std::string& other) {
  if (candidate.upon.empty()) return false;
  return candidate.upon == other || stands_upon(choice, *choice.from.find(candidate.upon), other);
}

void rename_candidate(Node& choice, const std::string& from, const std::string& to) {
  Ordered<Node> renamed;
  for (auto& [name, candidate] : choice.from) {
    if (candidate.upon == from) candidate.upon = to;
    renamed[name == from ? to : name] = std::move(candidate);
  }
  choice.from = std::move(renamed);
  if (choice.choose == from) choice.choose = to;
}

/// One effect leaves a choice in which others stand upon it, or it upon others.
void take_out_layer(Node& choice, const std::string& candidate, const std::string& before, const Registry& registry) {
  const Node with_effect = *choice.from.find(candidate);
  const std::string effect = with_effect.effect.empty() ? choice.effect : with_effect.effect;
  for (auto& [name, later] : choice.from) {
    if (!stands_upon(choice, later, candidate)) continue;
    take_from(later, *choice.from.find(before), with_effect, registry);
    refuse_without_its_law(later, with_effect, effect, registry);
  }
  for (auto& [name, later] : choice.from)
    if (later.upon == candidate) later.upon = before;
  if (choice.choose == candidate) choice.choose = before;
  choice.from.erase(candidate);
  if (candidate != "on") return;
  // The choice is there for effects alone, and the first of these is called so.
  choice.effect = "";
  for (auto& [name, first] : choice.from)
    if (first.upon == before) {
      choice.effect = first.effect;
      first.effect = first.upon = "";
      return rename_candidate(choice, std::string(name), "on");
    }
}

/// The block as it was before any effect.
void take_out_choice(Diagram& diagram, const std::string& name, const std::string& effect) {
  Node& choice = *diagram.blocks.find(name);
  const Node off = *choice.from.find("off");
  if (off.type != "pass" || off.nested) {
    Node original = off;
    original.in = choice.in;
    original.origin = choice.origin;
    choice = std::move(original);
    return;
  }
  const std::string from = choice.in.front().from;
  const std::string side = choice.in.size() > 1 ? choice.in[1].from : "";
  const auto reads = [&](const std::string& wire) { return wire == name || wire.starts_with(name + "["); };
  const auto put_back = [&](std::string& wire) {
    if (reads(wire)) wire = from + wire.substr(name.size());
  };
  for (auto& [other, node] : diagram.blocks)
    for (auto& wire : node.in) put_back(wire.from);
  for (auto& [output, signal] : diagram.outputs) put_back(signal);
  std::erase_if(diagram.record, reads);
  diagram.blocks.erase(name);
  const auto* input = side.empty() ? nullptr : diagram.inputs.find(side);
  if (input == nullptr || input->remark != side_remark(effect)) return;
  for (const auto& [other, node] : diagram.blocks)
    for (const auto& wire : node.in)
      if (wire.from == side) return;
  diagram.inputs.erase(side);
}

void take_out(Diagram& diagram, const Registry& registry, const std::string& name, const std::string& effect) {
  Node& choice = *diagram.blocks.find(name);
  if (choice.effect == effect) {
    const bool others = std::any_of(choice.from.begin(), choice.from.end(),
                                    [](const auto& candidate) { return !candidate.second.upon.empty(); });
    return others ? take_out_layer(choice, "on", "off", registry) : take_out_choice(diagram, name, effect);
  }
  for (const auto& [candidate, body] : choice.from)
    if (body.effect == effect) return take_out_layer(choice, std::string(candidate), std::string(body.upon), registry);
}

void remove_at(Diagram& diagram, const Registry& registry, const std::string& path, const std::string& effect) {
  const auto slash = path.find('/');
  if (slash == std::string::npos) {
    take_out(diagram, registry, path, effect);
    return;
  }
  Node* node = diagram.blocks.find(path.substr(0, slash));
  if (!node->from.empty()) node = node->from.find(node->choose);
  Diagram inner = *node->nested;
  remove_at(inner, registry, path.substr(slash + 1), effect);
  // Back to the file that it was before, where the name tells.
  const auto plain = [&](std::string file) {
    const auto at = file.rfind("_" + effect + ".");
    if (at != std::string::npos) file.erase(at, effect.size() + 1);
    return file;
  };
  node->file = plain(node->file);
  inner.file = plain(inner.file);
  node->nested = std::make_shared<const Diagram>(std::move(inner));
}

}  // namespace

std::vector<std::pair<std::string, std::string>> effects_in(const Diagram& diagram) {
  std::vector<std::pair<std::string, std::string>> list;
  collect_effects(diagram, "", list);
  return list;
}

Diagram remove_effect(const Diagram& diagram, const Registry& registry, const std::string& name,
                      const std::string& effect) {
  const auto standing = effects_in(diagram);
  std::vector<std::pair<std::string, std::string>> meant;
  for (const auto& e : standing)
    if ((e.first == name || e.second == name) && (effect.empty() || e.second == effect)) meant.push_back(e);
  std::vector<std::string> known;
  for (const auto& [path, id] : standing) known.insert(known.end(), {path, id});
  if (meant.empty())
    fail("unknown_effect", name,
         standing.empty() ? "the diagram has no effect" : fmt::format("the diagram has no effect \"{}\"", name),
         standing.empty() ? "nothing is to be removed" : did_you_mean(name, known));
  if (meant.size() > 1) {
    const bool one_block = meant.front().first == meant.back().first;
    std::vector<std::string> names;
    for (const auto& m : meant) names.push_back(one_block ? m.second : m.first);
    fail("ambiguous_effect", name, fmt::format("\"{}\" stands for {} effects", name, meant.size()),
         fmt::format("name one of: {}", fmt::join(names, ", ")));
  }
  Diagram result = diagram;
  remove_at(result, registry, meant.front().first, meant.front().second);
  return result;
}

}  // namespace hysteron
