#include "blocks/logic/triggered.h"

namespace hysteron::blocks {
namespace {

const char* const on_which_edge = "rising: from false to true; falling: from true to false; either";

}  // namespace

void SampleAndHold::describe(BlockSpec<SampleAndHold>& spec) {
  spec.name("sample_and_hold", "holds what its input was when it was triggered").in_group("logic");
  spec.law("y = u at the last edge of the trigger, initial before the first").from("definition");
  spec.remark("The edges are located, wherever they come. With a clock: \"sample_hold\".");
  spec.remark("What is true at the start makes no edge there.");
  spec.input(&In<double>::u, "u", "$a", "the signal");
  spec.input(&In<double>::trigger, "trigger", "", "1 = true, 0 = false; the level is 1/2");
  spec.output(&Out<double>::y, "y", "$a", "the held value");
  spec.state(&State<double>::held, "held", "$a", "the held value");
  spec.param(&Params<double>::initial, "initial", "$a", "output before the first edge").optional("0");
  spec.text("edge", {"rising", "falling", "either"}, on_which_edge);
}

void Counter::describe(BlockSpec<Counter>& spec) {
  spec.name("counter", "counts how often its input becomes true").in_group("logic");
  spec.law("y = initial + by for every edge of u; initial while reset is true").from("definition");
  spec.remark("The edges are located. What is true at the start makes no edge there.");
  spec.remark("Without a reset: wire a \"constant\" 0 to it.");
  spec.input(&In<double>::u, "u", "", "what is counted: 1 = true, 0 = false; the level is 1/2");
  spec.input(&In<double>::reset, "reset", "", "back to the beginning while it is true");
  spec.output(&Out<double>::y, "y", "", "the count");
  spec.state(&State<double>::count, "count", "", "the count");
  spec.param(&Params<double>::initial, "initial", "", "where it begins").optional("0");
  spec.param(&Params<double>::by, "by", "", "what one edge adds").optional("1");
  spec.text("edge", {"rising", "falling", "either"}, on_which_edge);
}

void Timer::describe(BlockSpec<Timer>& spec) {
  spec.name("timer", "how long its input has been true").in_group("logic");
  spec.law("dy/dt = 1 while u is true; y = 0 when it becomes so, and while it is false").from("definition");
  spec.remark("A delayed switch: \"comparator\" behind it. The edges are located.");
  spec.input(&In<double>::u, "u", "", "1 = true, 0 = false; the level is 1/2");
  spec.output(&Out<double>::y, "y", "s", "the time since it became true");
  spec.state(&State<double>::elapsed, "elapsed", "s", "the time since it became true").nominal(1.0);
}

Kernel sample_and_hold_block() { return kernel<SampleAndHold>(); }
Kernel counter_block() { return kernel<Counter>(); }
Kernel timer_block() { return kernel<Timer>(); }

}  // namespace hysteron::blocks
