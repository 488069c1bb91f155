#include "blocks/continuous/ageing.h"

namespace hysteron::blocks {

void Ageing::describe(BlockSpec<Ageing>& spec) {
  spec.name("ageing", "gain that falls with the logarithm of use").in_group("continuous").elementwise().at("core");
  spec.law("y = u (1 - per_decade log10(1 + n/first)), n = used + cycles of u so far")
      .from("Jaffe, Cook, Jaffe, Piezoelectric Ceramics (1971), chapter 7; Zhang, Jones, Acta Mater. 58 (2010) 1584");
  spec.remark(
      "\"used\" is what the device had behind it at the start: cycles, or hours. Recordings that say it have it as the "
      "columns cycles_before and start.");
  spec.remark("Every turn by more than \"swing\" counts as half a cycle.");
  spec.input(&In<double>::u, "u", "$a", "the signal of a new device");
  spec.input(&In<double>::used, "used", "$b", "cycles or hours before the start");
  spec.memory(&Memory<double>::extreme, "extreme");
  spec.memory(&Memory<double>::direction, "direction");
  spec.memory(&Memory<double>::cycles, "cycles");
  spec.output(&Out<double>::y, "y", "$a", "the signal of this device");
  spec.param(&Params<double>::per_decade, "per_decade", "", "part of the gain that a decade of use takes").linear();
  spec.param(&Params<double>::first, "first", "$b", "use at which the decades begin").positive();
  spec.param(&Params<double>::swing, "swing", "$a", "smallest turn that counts; 0 = none is counted")
      .optional("0")
      .not_negative()
      .difference();
}

Kernel ageing_block() { return kernel<Ageing>(); }

}  // namespace hysteron::blocks
