#include "engine/program/names.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace hysteron {
namespace {

/// "tilt" of "tilt[0]"; "" if it ends otherwise.
std::string without_first_index(const std::string& name) {
  return name.ends_with("[0]") ? name.substr(0, name.size() - 3) : "";
}

int length_of(const Program& program, const std::string& name) {
  int n = 0;
  while (program.find_signal(fmt::format("{}[{}]", name, n)) >= 0) ++n;
  return n;
}

std::vector<std::string> parameter_names(const Program& program) {
  std::vector<std::string> names;
  for (const auto& [name, index] : program.parameter_names) names.push_back(name);
  return names;
}

/// The block in use: of a choice the chosen candidate. nullptr if there is none.
const Node* body_of(const Diagram& diagram, const std::string& block) {
  const Node* node = diagram.blocks.find(block);
  if (node != nullptr && !node->from.empty()) node = node->from.find(node->choose);
  return node;
}

/// What is wired to an input of the nested diagram that `block` is; "" if nothing is.
std::string wired_to(const Diagram& diagram, const std::string& block, const std::string& input) {
  const Node* body = body_of(diagram, block);
  const Node& outer = *diagram.blocks.find(block);
  const auto names = body->nested->inputs.names();
  const auto& wires = body->in.empty() ? outer.in : body->in;
  for (std::size_t i = 0; i < wires.size(); ++i)
    if (wires[i].port.empty() ? i < names.size() && names[i] == input : wires[i].port == input) return wires[i].from;
  return "";
}

std::string program_name(const Diagram& diagram, const std::string& name, int depth) {
  constexpr int deepest = 64;  // of diagrams that lead back to themselves
  const auto end = name.find_first_of("./[");
  const std::string block = name.substr(0, end);
  const Node* body = body_of(diagram, block);
  if (body == nullptr || !body->nested || depth > deepest) return name;
  const Diagram& inner = *body->nested;
  if (end != std::string::npos && name[end] == '/')
    return block + "/" + program_name(inner, name.substr(end + 1), depth + 1);
  const auto open = name.find('[');
  const std::string index = open == std::string::npos ? "" : name.substr(open);
  const std::string* wire = nullptr;
  if (end != std::string::npos && name[end] == '.')
    wire = inner.outputs.find(name.substr(end + 1, open == std::string::npos ? open : open - end - 1));
  else if (inner.outputs.size() == 1)
    wire = &inner.outputs.begin()->second;
  if (wire == nullptr) return name;
  const std::string head = wire->substr(0, wire->find_first_of("./["));
  if (inner.inputs.find(head) == nullptr) return block + "/" + program_name(inner, *wire + index, depth + 1);
  const std::string outside = wired_to(diagram, block, head);  // handed through
  return outside.empty() ? name : program_name(diagram, outside + wire->substr(head.size()) + index, depth + 1);
}

}  // namespace

std::string program_name(const Diagram& diagram, const std::string& name) { return program_name(diagram, name, 0); }

int find_named_signal(const Program& program, const std::string& name) {
  if (const int found = program.find_signal(name); found >= 0) return found;
  const std::string single = without_first_index(name);
  if (!single.empty()) return program.find_signal(single);
  return length_of(program, name) == 1 ? program.find_signal(name + "[0]") : -1;
}

int find_named_signal(const Program& program, const Diagram& diagram, const std::string& name) {
  return find_named_signal(program, program_name(diagram, name));
}

int named_signal(const Program& program, const Diagram& diagram, const std::string& name) {
  return named_signal(program, program_name(diagram, name));
}

int named_signal(const Program& program, const std::string& name) {
  const int found = find_named_signal(program, name);
  if (found >= 0) return found;
  if (const int n = length_of(program, name); n > 1)
    fail("unknown_signal", name, fmt::format("\"{}\" is a vector of {} numbers", name, n),
         fmt::format("name one of them: \"{0}[0]\" ... \"{0}[{1}]\"", name, n - 1));
  fail("unknown_signal", name, fmt::format("there is no signal \"{}\"", name),
       did_you_mean(name, signal_names(program)));
}

std::vector<std::string> signal_names(const Program& program) {
  std::vector<std::string> names;
  for (const auto& s : program.signals) names.push_back(s.path);
  names.insert(names.end(), program.output_names.begin(), program.output_names.end());
  std::vector<std::string> once;
  std::set<std::string> seen;
  for (auto& name : names)
    if (seen.insert(name).second) once.push_back(std::move(name));
  return once;
}

std::vector<int> find_named_parameters(const Program& program, const std::string& name) {
  const auto& names = program.parameter_names;
  if (const auto one = names.find(name); one != names.end()) return {one->second};
  if (const auto single = names.find(without_first_index(name)); single != names.end()) return {single->second};
  std::vector<int> list;
  const std::string open = name + "[";
  for (auto element = names.lower_bound(open); element != names.end() && element->first.starts_with(open); ++element)
    list.push_back(element->second);
  std::sort(list.begin(), list.end());  // as the program has them: "[10]" stands before "[2]" among the names
  list.erase(std::unique(list.begin(), list.end()), list.end());
  return list;
}

std::vector<int> named_parameters(const Program& program, const std::string& name) {
  auto list = find_named_parameters(program, name);
  if (list.empty())
    fail("unknown_parameter", name, fmt::format("there is no parameter \"{}\"", name),
         did_you_mean(name, parameter_names(program)));
  return list;
}

int named_parameter(const Program& program, const std::string& name) {
  const auto list = named_parameters(program, name);
  if (list.size() > 1)
    fail("unknown_parameter", name, fmt::format("\"{}\" is a list of {} numbers", name, list.size()),
         fmt::format("name one of them, such as \"{}\"",
                     program.parameters[static_cast<std::size_t>(list.front())].path));
  return list.front();
}

int named_state(const Program& program, const std::string& name) {
  const auto& names = program.state_names;
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    fail("unknown_state", name, fmt::format("the diagram has no state \"{}\"", name), did_you_mean(name, names));
  return static_cast<int>(found - names.begin());
}

}  // namespace hysteron
