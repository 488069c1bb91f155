#include "engine/block/declaration.h"

#include <stdexcept>

#include "engine/block/kernel.h"

namespace hysteron {
namespace {

template <class List>
std::vector<std::string> names_of(const List& list) {
  std::vector<std::string> names;
  for (const auto& item : list) names.push_back(item.name);
  return names;
}

}  // namespace

int Declaration::parameter_index(const std::string& key) const {
  for (std::size_t i = 0; i < parameters.size(); ++i)
    if (parameters[i].name == key) return static_cast<int>(i);
  return -1;
}
std::vector<std::string> Declaration::parameter_names() const { return names_of(parameters); }
std::vector<std::string> Declaration::input_names() const { return names_of(inputs); }
std::vector<std::string> Declaration::output_names() const { return names_of(outputs); }

bool Declaration::has_vector_ports() const {
  for (const auto* ports : {&inputs, &outputs})
    for (const auto& port : *ports)
      if (port.is_vector) return true;
  return false;
}

int Shape::length(const std::string& parameter) const {
  const int i = declaration->parameter_index(parameter);
  if (i < 0) throw std::logic_error("block " + declaration->type + " asks for the length of " + parameter);
  return list_lengths[static_cast<std::size_t>(i)];
}

const std::string& Shape::text(const std::string& parameter) const {
  const int i = declaration->parameter_index(parameter);
  if (i < 0) throw std::logic_error("block " + declaration->type + " asks for the text of " + parameter);
  const auto& choices = declaration->parameters[static_cast<std::size_t>(i)].choices;
  return choices.at(static_cast<std::size_t>(text_choices[static_cast<std::size_t>(i)]));
}

int Shape::columns_of(const std::string& parameter) const {
  const int i = declaration->parameter_index(parameter);
  if (i < 0) throw std::logic_error("block " + declaration->type + " asks for the columns of " + parameter);
  return static_cast<std::size_t>(i) < columns.size() ? columns[static_cast<std::size_t>(i)] : 0;
}

int Shape::rows_of(const std::string& parameter) const {
  const int n = columns_of(parameter);
  return n == 0 ? 0 : length(parameter) / n;
}

std::vector<int> Shape::whole_numbers(const std::string& parameter) const {
  const int i = declaration->parameter_index(parameter);
  if (i < 0) throw std::logic_error("block " + declaration->type + " asks for the numbers of " + parameter);
  std::vector<int> list;
  if (static_cast<std::size_t>(i) < structure.size())
    for (const double number : structure[static_cast<std::size_t>(i)]) list.push_back(static_cast<int>(number));
  return list;
}

std::string Shape::free_text(const std::string& parameter) const {
  std::string text;
  for (const int code : whole_numbers(parameter)) text += static_cast<char>(code);
  return text;
}

void Registry::add(Kernel kernel) {
  const std::string type = kernel.declaration.type;
  if (!kernels_.emplace(type, std::move(kernel)).second) throw std::logic_error("block type " + type + " twice");
  order_.push_back(type);
}

const Kernel* Registry::find(const std::string& type) const {
  const auto found = kernels_.find(type);
  return found == kernels_.end() ? nullptr : &found->second;
}

std::vector<std::string> Registry::types() const { return order_; }

}  // namespace hysteron
