#include "blocks/hysteresis/play.h"

namespace hysteron::blocks {

void Play::describe(BlockSpec<Play>& spec) {
  spec.name("play", "play operator: follows its input with a dead zone")
      .in_group("hysteresis")
      .elementwise()
      .at("core");
  spec.law("two: y = max(u - radius, min(u + radius, y before)); one: y = max(u - radius, min(u, y before))")
      .from("thesis Eqs. 2.3, 2.4; Brokate, Sprekels, Hysteresis and Phase Transitions (1996), chapter 2");
  spec.remark("The one-sided operator is the two-sided one of half the radius behind u - radius/2.");
  spec.remark("The memory starts at zero, visits \"before\", then the first input.");
  spec.remembers("u", "its output");
  spec.input(&In<double>::u, "u", "$a", "drive");
  spec.output(&Out<double>::y, "y", "$a", "follower");
  spec.param(&Params<double>::radius, "radius", "$a", "half the dead zone (two sides), or the whole (one side)")
      .not_negative()
      .difference();
  spec.text("sides", {"two", "one"}, "dead zone on both sides of the input, or below it only");
  spec.param(&Params<double>::before, "before", "$a", "an input that was visited before the start").optional("0");
  spec.memory(&Memory<double>::w, "w");
}

Kernel play_block() { return kernel<Play>(); }

}  // namespace hysteron::blocks
