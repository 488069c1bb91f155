// Decides how the numbers of a block are told on a picture: as written in the file, with their units.
// Does not check them: compile() has done so.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "engine/block/declaration.h"
#include "engine/diagram/diagram.h"

namespace hysteron::draw {

/// The diagrams around a block, from the innermost outwards: where "$name" is looked up.
struct Surroundings {
  const Diagram* diagram = nullptr;
  const Node* node = nullptr;  ///< the block of `outer` that holds `diagram`; its parameters go before the diagram's
  const Surroundings* outer = nullptr;
};

/// The values of a block that its file gives, in the order of the declaration.
struct Values {
  std::vector<std::pair<const ParameterDeclaration*, Value>> list;
  const Value* find(const std::string& name) const;
  /// "0.8 V/um", or "" where the file leaves the parameter at its default.
  std::string text(const std::string& name) const;
  /// The numbers of a list without units; empty where it is not given.
  std::vector<double> numbers(const std::string& name) const;
};

/// The values that `node` gives, references looked up.
Values values_of(const Node& node, const Declaration& declaration, const Surroundings& around);

/// "1.207 V/um"; "[0, 0.6, 1.2 ... 5.4] V (10)" of a list.
std::string value_text(const Value& value, const ParameterDeclaration& declaration);

/// Lines such as "kp 1.207 V/um", at most `lines`; parameters in `shown` are left out.
std::vector<std::string> caption_lines(const Values& values, const std::vector<std::string>& shown, std::size_t lines);

}  // namespace hysteron::draw
