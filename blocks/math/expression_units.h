// Decides which units the parts of an expression have: what the inputs and parameters say of the output, and of each
// other. Does not decide which units are written where: engine/compile/unit_check.cpp.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/diagram/units.h"
#include "models/math/expression_tree.h"

namespace hysteron::expression {

struct UnitsOfTree {
  std::vector<std::optional<Dimension>> symbols;  ///< in: what is known; out: also what follows
  std::optional<Dimension> whole{};               ///< the same of the result
};

/// Fills in what follows. Angles count as plain numbers where they meet some: in sin(x), and in x + 1.
/// `name`: how a unit is called in messages. Throws Wrong where units do not fit.
void infer_units(const Tree& tree, UnitsOfTree& units, const std::function<std::string(const Dimension&)>& name);

}  // namespace hysteron::expression
