#include "blocks/logic/triggered.h"

namespace hysteron::blocks {
namespace {

const char* const on_which_edge = "rising: from false to true; falling: from true to false; either";

}  // namespace

void SampleAndHold::describe(BlockSpec<SampleAndHold>& spec) {
  spec.name("sample_and_hold", "sample and hold, triggered by the edges of a signal").in_group("logic");
  spec.law("y = u at the last edge of the trigger, initial before the first").from("definition");
  spec.remark("The instants of the edges are located. For sampling with a clock use \"sample_hold\".");
  spec.remark("A trigger that is true at the start is not an edge.");
  spec.input(&In<double>::u, "u", "$a", "the signal");
  spec.input(&In<double>::trigger, "trigger", "", "1 = true, 0 = false; above 1/2 counts as true");
  spec.output(&Out<double>::y, "y", "$a", "the held value");
  spec.state(&State<double>::held, "held", "$a", "the held value");
  spec.param(&Params<double>::initial, "initial", "$a", "output before the first edge").optional("0");
  spec.text("edge", {"rising", "falling", "either"}, on_which_edge);
}

void Counter::describe(BlockSpec<Counter>& spec) {
  spec.name("counter", "counts the edges of its input").in_group("logic");
  spec.law("y = initial + by for every edge of u; initial while reset is true").from("definition");
  spec.remark("The instants of the edges are located. An input that is true at the start is not an edge.");
  spec.remark("If no reset is needed, wire a \"constant\" 0 to \"reset\".");
  spec.input(&In<double>::u, "u", "", "signal whose edges are counted: 1 = true, 0 = false; above 1/2 counts as true");
  spec.input(&In<double>::reset, "reset", "", "while true, the count is held at \"initial\"");
  spec.output(&Out<double>::y, "y", "", "the count");
  spec.state(&State<double>::count, "count", "", "the count");
  spec.param(&Params<double>::initial, "initial", "", "initial count").optional("0");
  spec.param(&Params<double>::by, "by", "", "increment per edge").optional("1");
  spec.text("edge", {"rising", "falling", "either"}, on_which_edge);
}

void Timer::describe(BlockSpec<Timer>& spec) {
  spec.name("timer", "time since its input became true").in_group("logic");
  spec.law("dy/dt = 1 while u is true; y = 0 when u becomes true, and while it is false").from("definition");
  spec.remark("With a \"comparator\" after it, it makes a switch-on delay. The instants of the edges are located.");
  spec.input(&In<double>::u, "u", "", "1 = true, 0 = false; above 1/2 counts as true");
  spec.output(&Out<double>::y, "y", "s", "time since the input became true");
  spec.state(&State<double>::elapsed, "elapsed", "s", "time since the input became true").nominal(1.0);
}

Kernel sample_and_hold_block() { return kernel<SampleAndHold>(); }
Kernel counter_block() { return kernel<Counter>(); }
Kernel timer_block() { return kernel<Timer>(); }

}  // namespace hysteron::blocks
