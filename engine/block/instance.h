// Decides what a block is whose ports and parameters its own texts name (Declaration::names_from): the kernel of its
// type with a declaration of its own. Does not decide what such a text means: the block type does.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/block/kernel.h"
#include "engine/diagram/diagram.h"
#include "engine/diagram/units.h"

namespace hysteron {

/// The kernel of one block of that type. Throws Error where its texts are wrong; places begin at the block: "/y".
KernelPointer instance_of(const Kernel& type, const Node& block);

/// What the registry has for the type of a block, with the ports that this block has; those of its type where its texts
/// are wrong. Null if there is no such type. Fixed types are not copied: the registry must live as long.
KernelPointer kernel_of(const Registry& registry, const Node& block);

/// A value as a text, also where it looked like a number ("2", "2/u"). Nothing for lists, matrices, references.
std::optional<std::string> written_text(const Value& value);

/// The text that a block has for a parameter, at its place or in its parameter file. Nothing where it has none.
std::optional<std::string> written_text(const Node& block, const std::string& parameter);

/// Units inside one block: what is known before, and after Kernel::units also what follows. Absent: not known (zero
/// without a unit fits any).
struct InstanceUnits {
  using Known = std::optional<Dimension>;
  std::vector<Known> inputs, parameters, outputs;       ///< per wire, per declared parameter, per output
  std::function<std::string(const Dimension&)> name{};  ///< how a unit is called in messages
  std::string error{}, cure{};                          ///< not empty: what does not fit
  std::string parameter{};                              ///< the text in which it stands
};

}  // namespace hysteron
