#include "blocks/sampled/repetitive_controller.h"

#include <fmt/format.h>

#include <algorithm>

namespace hysteron::blocks {
namespace {

constexpr int longest_cycle = 100000;

}  // namespace

void RepetitiveController::describe(Declaration& d) {
  d.name("repetitive_controller", "puts right in advance what was wrong a cycle ago")
      .in_group("sampled")
      .elementwise()
      .linear();
  d.law(
       "w_k = e_k + keep S(w)_(k - samples), y_k = gain keep S(w)_(k - samples + lead), S(w)_i = w_i + smoothing/4 (w_(i-1) - 2 "
       "w_i + w_(i+1))")
      .from("Longman, Int. J. Control 73 (2000) 930-954");
  d.remark(
      "It is added to the command of the controller that is there, or to its reference. \"lead\" is how many samples the loop "
      "takes to answer; gain below 1 over the loop's own learns slowly and surely.");
  d.remark(
      "smoothing 1 lets the highest frequencies be forgotten, where the loop answers the other way round; it acts without "
      "delay, since a cycle ago what comes next is known.");
  d.input("u", "$a", "control error");
  d.output("y", "$b", "what is added");
  d.state("w", "$a", "the last cycle and one sample more, oldest first");
  d.parameter("samples", "", "of one cycle").structural().positive();
  d.parameter("gain", "$b/$a", "command over error").optional("1").linear();
  d.parameter("lead", "", "samples that it comes early, below \"samples\" - 1")
      .optional("0")
      .structural()
      .not_negative();
  d.parameter("keep", "", "share that is kept from cycle to cycle").optional("1").not_negative();
  d.parameter("smoothing", "", "0 = none, 1 = the highest frequency is taken out").optional("0").not_negative();
  d.sampled();
}

Sizes RepetitiveController::sizes(const Shape& shape) {
  Sizes s;
  const auto n = shape.whole_numbers("samples"), early = shape.whole_numbers("lead");
  const int cycle = n.empty() ? 0 : n[0], lead = early.empty() ? 0 : early[0];
  s.sampled_states = std::max(cycle, 1) + 1;
  s.feedthrough = false;
  if (cycle < 2 || cycle > longest_cycle)
    s.error = fmt::format("a cycle of {} samples; give a whole number from 2 to {}", cycle, longest_cycle);
  else if (lead > cycle - 2)
    s.error = fmt::format("a lead of {} samples in a cycle of {}; give at most {}", lead, cycle, cycle - 2);
  return s;
}

Kernel repetitive_controller_block() { return kernel<RepetitiveController>(); }

}  // namespace hysteron::blocks
