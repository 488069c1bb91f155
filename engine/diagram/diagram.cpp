#include "engine/diagram/diagram.h"

#include <fmt/format.h>

#include "engine/diagram/error.h"
#include "engine/diagram/units.h"

namespace hysteron {

Value::Value(const std::string& text) {
  double number = 0;
  std::string unit;
  if (!text.empty() && text.front() == '$') {
    content = Reference{text.substr(1)};
  } else if (split_quantity(text, number, unit)) {
    content = unit.empty() ? Number{number, {}} : Number{number, unit};
  } else {
    content = text;
  }
}

namespace {

/// Follows "stage/actuator" to the node, cloning nested diagrams on the way so that the change stays in this value.
Node& find_node(Diagram& diagram, const std::string& path, const std::string& option) {
  Diagram* scope = &diagram;
  std::string rest = path;
  for (;;) {
    const auto slash = rest.find('/');
    const std::string name = rest.substr(0, slash);
    Node* node = scope->blocks.find(name);
    if (node == nullptr)
      fail("unknown_block", option, fmt::format("there is no block \"{}\"", name),
           did_you_mean(name, scope->blocks.names()));
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
    auto copy = std::make_shared<Diagram>(*body->nested);
    scope = copy.get();
    body->nested = std::move(copy);
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

}  // namespace

bool was_set(const std::string& origin) { return origin.starts_with("--set "); }

void apply_settings(Diagram& diagram, const std::vector<Override>& set, const std::vector<Override>& choose) {
  for (const auto& c : choose) {
    const std::string option = fmt::format("--choose {}={}", c.path, c.value);
    Node& node = find_node(diagram, c.path, option);
    if (node.from.empty())
      fail("bad_choice", option, fmt::format("block \"{}\" is not a choice", c.path),
           "choices are blocks with \"choose\" and \"from\"");
    if (node.from.find(c.value) == nullptr)
      fail("bad_choice", option, fmt::format("\"{}\" has no candidate \"{}\"", c.path, c.value),
           did_you_mean(c.value, node.from.names()));
    node.choose = c.value;
  }
  for (const auto& s : set) {
    const std::string option = fmt::format("--set {}={}", s.path, s.value);
    Value value(s.value);
    value.origin = option;
    const auto dot = s.path.rfind('.');
    if (dot == std::string::npos) {
      DiagramParameter* parameter = diagram.parameters.find(s.path);
      if (parameter == nullptr)
        fail("unknown_parameter", option, fmt::format("the diagram has no parameter \"{}\"", s.path),
             did_you_mean(s.path, diagram.parameters.names()) + " A parameter of a block is written block.parameter");
      keep_unit_of_bounds(*parameter);
      parameter->value = value;
      continue;
    }
    Node* node = &find_node(diagram, s.path.substr(0, dot), option);
    if (!node->from.empty())
      if (Node* chosen = node->from.find(node->choose)) node = chosen;
    node->parameters[s.path.substr(dot + 1)] = value;
  }
}

}  // namespace hysteron
