#include "blocks/logic/edge.h"

namespace hysteron::blocks {

void EdgeDetector::describe(BlockSpec<EdgeDetector>& spec) {
  spec.name("edge", "edge detector: 1 for one sample when its input becomes true").in_group("logic").elementwise();
  spec.law("y_k = 1 if u_k is true and u_(k-1) was not, else 0 (falling: the other way round)").from("definition");
  spec.remark(
      "The block is sampled. \"sample_and_hold\", \"counter\" and \"timer\" react to edges at any instant, "
      "without a clock.");
  spec.input(&In<double>::u, "u", "", "1 = true, 0 = false; above 1/2 counts as true");
  spec.output(&Out<double>::y, "y", "", "1 = edge since the last sample, 0 = none");
  spec.state(&State<double>::side, "side", "", "input at the last instant: 1 = false, 2 = true, 0 = no last instant");
  spec.text("edge", {"rising", "falling", "either"}, "rising: from false to true; falling: from true to false; either");
  spec.sampled(&Params<double>::period, &Params<double>::offset);
}

Kernel edge_block() { return kernel<EdgeDetector>(); }

}  // namespace hysteron::blocks
