// Decides how numbers become the rows of a block with one input.
#pragma once

#include "tests/blocks/bench.h"

namespace hysteron::bench {

/// One row for each number, as Bench::response takes them.
inline std::vector<Numbers> rows(const Numbers& u) {
  std::vector<Numbers> r;
  for (const double x : u) r.push_back({x});
  return r;
}

}  // namespace hysteron::bench
