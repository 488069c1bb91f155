// Decides how the reference reads a diagram: nested diagrams opened, choices made, $names and units resolved.
#pragma once

#include <string>
#include <vector>

#include "tests/reference/law.h"

namespace reference {

struct FlatDiagram {
  std::vector<Block> blocks{};
  std::vector<std::string> record{};
  double until = 1, every = 1e-3;  ///< [s]
};

/// Throws Unknown for what the reference cannot read.
FlatDiagram read_flat(const std::string& file);

}  // namespace reference
