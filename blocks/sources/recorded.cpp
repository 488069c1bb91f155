#include "blocks/sources/recorded.h"

namespace hysteron::blocks {

void Recorded::describe(Declaration& d) {
  d.name("recorded", "a recorded signal, from a column of a file").in_group("sources");
  d.law(
       "linear: straight lines between the samples; hold: each sample until the next; smooth: a cubic spline through "
       "them; constant outside")
      .from("definition");
  d.remark("Name the column: \"file\": \"lab.csv\", \"column\": \"u\". The unit is that of the column.");
  d.remark("A held signal jumps: a law that is driven by the rate of its input (bouc_wen) needs a lag in between.");
  d.output("y", "$a", "the signal");
  d.text("between_samples", {"linear", "hold", "smooth"}, "how it moves between samples");
  d.is_series = true;
}

void Input::describe(Declaration& d) {
  d.name("input", "an input of the diagram, bound to a recording or a series").in_group("internal");
  d.law("linear: straight lines between the samples; hold: each sample until the next; constant outside")
      .from("definition");
  d.output("y", "$a", "the signal");
  d.is_series = true;
}

Kernel recorded_block() { return kernel<Recorded>(); }
Kernel input_block() { return kernel<Input>(); }

}  // namespace hysteron::blocks
