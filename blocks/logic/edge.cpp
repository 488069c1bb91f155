#include "blocks/logic/edge.h"

namespace hysteron::blocks {

void EdgeDetector::describe(BlockSpec<EdgeDetector>& spec) {
  spec.name("edge", "1 for one sample when its input becomes true").in_group("logic").elementwise();
  spec.law("y_k = 1 if u_k is true and u_k-1 was not, else 0 (falling: the other way round)").from("definition");
  spec.remark(
      "Sampled. At any instant, without a clock, edges are followed by \"sample_and_hold\", \"counter\", \"timer\".");
  spec.input(&In<double>::u, "u", "", "1 = true, 0 = false; the level is 1/2");
  spec.output(&Out<double>::y, "y", "", "1 = there was an edge, 0 = none");
  spec.state(&State<double>::side, "side", "", "1 = was false at the last instant, 2 = was true, 0 = there was none");
  spec.text("edge", {"rising", "falling", "either"}, "rising: from false to true; falling: from true to false; either");
  spec.sampled(&Params<double>::period, &Params<double>::offset);
}

Kernel edge_block() { return kernel<EdgeDetector>(); }

}  // namespace hysteron::blocks
