#include "blocks/continuous/ageing.h"

namespace hysteron::blocks {

void Ageing::describe(BlockSpec<Ageing>& spec) {
  spec.name("ageing", "gain that decreases with the logarithm of the number of cycles")
      .in_group("continuous")
      .elementwise()
      .at("core");
  spec.law("y = u (1 - per_decade log10(1 + n/first)), n = used + cycles of u so far")
      .from("Jaffe, Cook, Jaffe, Piezoelectric Ceramics (1971), chapter 7; Zhang, Jones, Acta Mater. 58 (2010) 1584");
  spec.remark(
      "\"used\" is the previous use of the device at the start of the run, in cycles or hours. Recordings "
      "give it in the columns cycles_before and start.");
  spec.remark("Every reversal of u after a change of more than \"swing\" counts as half a cycle.");
  spec.input(&In<double>::u, "u", "$a", "signal of the new device");
  spec.input(&In<double>::used, "used", "$b", "previous use at the start, in cycles or hours");
  spec.memory(&Memory<double>::extreme, "extreme");
  spec.memory(&Memory<double>::direction, "direction");
  spec.memory(&Memory<double>::cycles, "cycles");
  spec.output(&Out<double>::y, "y", "$a", "signal of the aged device");
  spec.param(&Params<double>::per_decade, "per_decade", "", "relative loss of gain per decade of use").linear();
  spec.param(&Params<double>::first, "first", "$b", "use from which the decades are counted").positive();
  spec.param(&Params<double>::swing, "swing", "$a",
             "smallest change between reversals that counts; 0 = no cycles are counted")
      .optional("0")
      .not_negative()
      .difference();
}

Kernel ageing_block() { return kernel<Ageing>(); }

}  // namespace hysteron::blocks
