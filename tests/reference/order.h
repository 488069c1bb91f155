// Decides in which order blocks are evaluated: each behind those whose outputs it needs at the same instant. Blocks
// that need each other are a group in which one signal is torn and solved for.
#pragma once

#include <vector>

#include "tests/reference/law.h"

namespace reference {

struct Group {
  std::vector<int> laws{};
  int tear = -1;  ///< the law whose output is solved for; it stands last among `laws`
};

/// Throws Unknown where one torn signal is not enough.
std::vector<Group> evaluation_order(const std::vector<LawPointer>& laws);

}  // namespace reference
