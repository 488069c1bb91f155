// Decides what the blocks of this room are in C: the operations of their models, one by one. Does not write files
// (export/).
#include "engine/block/c_law.h"

namespace hysteron::blocks {

CLaw constant_c() {
  return {"constant", [](const CBlock&) {
            CCode c;
            c.output = "$out.0 = $p.value;";
            return c;
          }};
}

}  // namespace hysteron::blocks
