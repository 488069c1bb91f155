#include "blocks/hysteresis/play.h"

namespace hysteron::blocks {

void Play::describe(BlockSpec<Play>& spec) {
  spec.name("play", "play (backlash) operator: follows its input with a dead band")
      .in_group("hysteresis")
      .elementwise()
      .at("core");
  spec.law("two: y = max(u - radius, min(u + radius, y before)); one: y = max(u - radius, min(u, y before))")
      .from("thesis Eqs. 2.3, 2.4; Brokate, Sprekels, Hysteresis and Phase Transitions (1996), chapter 2");
  spec.remark("The one-sided operator equals the two-sided one of half the radius with the input u - radius/2.");
  spec.remark("Initial memory: the operator starts at zero, moves to \"before\", then to the first input.");
  spec.remembers("u", "its output");
  spec.input(&In<double>::u, "u", "$a", "drive");
  spec.output(&Out<double>::y, "y", "$a", "follower");
  spec.param(&Params<double>::radius, "radius", "$a", "half the dead band (two), or all of it (one)")
      .not_negative()
      .difference();
  spec.text("sides", {"two", "one"}, "two: dead band on both sides of the input; one: below the input only");
  spec.param(&Params<double>::before, "before", "$a",
             "input value visited before the start, which sets the initial memory")
      .optional("0");
  spec.memory(&Memory<double>::w, "w");
}

Kernel play_block() { return kernel<Play>(); }

}  // namespace hysteron::blocks
