#include "blocks/sampled/repetitive_controller.h"

#include <fmt/format.h>

#include <algorithm>

namespace hysteron::blocks {
namespace {

constexpr int longest_cycle = 100000;

}  // namespace

void RepetitiveController::describe(Declaration& d) {
  d.name("repetitive_controller", "repetitive controller: corrects errors that repeat every cycle")
      .in_group("sampled")
      .elementwise()
      .linear();
  d.law(
       "w_k = e_k + keep S(w)_(k - samples), y_k = gain keep S(w)_(k - samples + lead), S(w)_i = w_i + smoothing/4 (w_(i-1) - 2 "
       "w_i + w_(i+1))")
      .from("Longman, Int. J. Control 73 (2000) 930-954");
  d.remark(
      "Add the output to the command of the existing controller, or to its reference. \"lead\" is the "
      "delay of the loop in samples. A gain below 1/(gain of the loop) learns more slowly but more "
      "robustly.");
  d.remark(
      "smoothing 1 removes the highest frequencies, where the phase of the loop would make the learning "
      "unstable. The filter has zero phase: it uses the samples of the last cycle on both sides.");
  d.input("u", "$a", "control error");
  d.output("y", "$b", "correction");
  d.state("w", "$a", "the samples of the last cycle and one more, oldest first");
  d.parameter("samples", "", "samples per cycle").structural().positive();
  d.parameter("gain", "$b/$a", "learning gain: correction per error").optional("1").linear();
  d.parameter("lead", "", "number of samples by which the correction is advanced, below \"samples\" - 1")
      .optional("0")
      .structural()
      .not_negative();
  d.parameter("keep", "", "fraction of the correction that is kept from cycle to cycle (forgetting factor)")
      .optional("1")
      .not_negative();
  d.parameter("smoothing", "", "smoothing filter: 0 = none, 1 = the highest frequency is removed")
      .optional("0")
      .not_negative();
  d.sampled();
}

Sizes RepetitiveController::sizes(const Shape& shape) {
  Sizes s;
  const auto n = shape.whole_numbers("samples"), early = shape.whole_numbers("lead");
  const int cycle = n.empty() ? 0 : n[0], lead = early.empty() ? 0 : early[0];
  s.sampled_states = std::max(cycle, 1) + 1;
  s.feedthrough = false;
  if (cycle < 2 || cycle > longest_cycle)
    s.error = fmt::format("the cycle has {} samples; give a whole number from 2 to {}", cycle, longest_cycle);
  else if (lead > cycle - 2)
    s.error = fmt::format("the lead is {} samples in a cycle of {}; give at most {}", lead, cycle, cycle - 2);
  return s;
}

Kernel repetitive_controller_block() { return kernel<RepetitiveController>(); }

}  // namespace hysteron::blocks
