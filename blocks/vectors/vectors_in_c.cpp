// Decides what the blocks of this room are in C: the operations of their models, one by one. Does not write files
// (export/).
#include <fmt/format.h>

#include "engine/block/c_law.h"

namespace hysteron::blocks {

CLaw matrix_gain_c() {
  return {"matrix_gain", [](const CBlock& b) {
            CCode c;
            for (int r = 0; r < b.view.n_y; ++r) {
              c.output += fmt::format("{}$out.{} = 0.0", r == 0 ? "" : "\n", r);
              for (int k = 0; k < b.view.n_u; ++k)
                c.output += fmt::format(" + $p.matrix[{}] * $in.{}", r * b.view.n_u + k, k);
              c.output += ";";
            }
            return c;
          }};
}

}  // namespace hysteron::blocks
