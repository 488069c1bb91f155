// Decides what the blocks of this room are in C: the operations of their models, one by one. Does not write files
// (export/).
#include "engine/block/c_law.h"

namespace hysteron::blocks {

CLaw switch_c() {
  return {"switch", [](const CBlock&) {
            CCode c;
            c.output = "$out.y = $in.control > $p.level ? $in.above : $in.below;";
            return c;
          }};
}

CLaw manual_switch_c() {
  return {"manual_switch", [](const CBlock& b) {
            CCode c;
            c.output = b.number("position") == 0 ? "$out.y = $in.first;" : "$out.y = $in.second;";
            return c;
          }};
}

}  // namespace hysteron::blocks
