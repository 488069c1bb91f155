#include "blocks/sampled/delay_line.h"

#include <algorithm>

namespace hysteron::blocks {

void DelayLine::describe(Declaration& d) {
  d.name("delay_line", "delays its input by a whole number of samples").in_group("sampled").elementwise().linear();
  d.law("y_k = u_(k - samples)").from("definition");
  d.remark("For a delay of any length use \"dead_time\". A computation delay of one sample is \"samples\": 1.");
  d.input("u", "$a", "the signal");
  d.output("y", "$a", "the delayed signal");
  d.state("line", "$a", "the stored samples, oldest first");
  d.parameter("samples", "", "delay, in samples").structural().not_negative();
  d.parameter("before", "$a", "value of the input before the first instant").optional("0");
  d.sampled();
}

Sizes DelayLine::sizes(const Shape& shape) {
  Sizes s;
  const auto n = shape.whole_numbers("samples");
  s.sampled_states = n.empty() ? 0 : n[0];
  s.feedthrough = s.sampled_states == 0;
  if (s.sampled_states > 100000) s.error = "more than 100000 samples of delay; give a longer period";
  return s;
}

void DelayLine::initial_states(const View<double>& v) { std::fill(v.out, v.out + v.n_x, v.parameter(before)); }

Kernel delay_line_block() { return kernel<DelayLine>(); }

}  // namespace hysteron::blocks
