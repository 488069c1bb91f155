#include "blocks/sources/recorded.h"

namespace hysteron::blocks {

void Recorded::describe(Declaration& d) {
  d.name("recorded", "a recorded signal, from a column of a file").in_group("sources");
  d.law(
       "linear: straight lines between the samples; hold: each sample is held until the next; smooth: a "
       "cubic spline through the samples; constant outside")
      .from("definition");
  d.remark(
      "Name the file and the column: \"file\": \"lab.csv\", \"column\": \"u\". The unit is that of the "
      "column.");
  d.remark(
      "With \"hold\" the output jumps: a block that is driven by the rate of its input (e.g. bouc_wen) "
      "needs a lag in between.");
  d.output("y", "$a", "the signal");
  d.text("between_samples", {"linear", "hold", "smooth"}, "interpolation between the samples");
  d.is_series = true;
}

void Input::describe(Declaration& d) {
  d.name("input", "input of the diagram, from a recording or a series").in_group("internal");
  d.law(
       "linear: straight lines between the samples; hold: each sample is held until the next; constant "
       "outside")
      .from("definition");
  d.output("y", "$a", "the signal");
  d.is_series = true;
}

Kernel recorded_block() { return kernel<Recorded>(); }
Kernel input_block() { return kernel<Input>(); }

}  // namespace hysteron::blocks
