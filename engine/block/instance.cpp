#include "engine/block/instance.h"

#include <fmt/format.h>

#include "engine/diagram/error.h"

namespace hysteron {

KernelPointer instance_of(const Kernel& type, const Node& block) {
  auto own = std::make_shared<Kernel>(type);
  own->declaration = type.instance(type.declaration, block);
  return own;
}

KernelPointer kernel_of(const Registry& registry, const Node& block) {
  const Kernel* type = registry.find(block.type);
  if (type != nullptr && type->instance != nullptr) try {
      return instance_of(*type, block);
    } catch (const Error&) {  // who compiles the diagram is told
    }
  return {KernelPointer(), type};
}

std::optional<std::string> written_text(const Value& value) {
  if (const auto* text = std::get_if<std::string>(&value.content)) return *text;
  if (const auto* number = std::get_if<Number>(&value.content))
    return fmt::format("{}{}", number->value, number->unit.value_or(""));
  return std::nullopt;
}

std::optional<std::string> written_text(const Node& block, const std::string& parameter) {
  const Value* value = block.parameters.find(parameter);
  if (value == nullptr) value = block.parameters_from_file.find(parameter);
  return value == nullptr ? std::nullopt : written_text(*value);
}

}  // namespace hysteron
