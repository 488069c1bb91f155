#include "blocks/logic/switches.h"

namespace hysteron::blocks {

void Switch::describe(BlockSpec<Switch>& spec) {
  spec.name("switch", "switch: selects one of two signals by the level of a third").in_group("logic").elementwise();
  spec.law("y = above if control > level, else below").from("definition");
  spec.remark("For a logic control signal (1 or 0) the default level 0 is suitable.");
  spec.remark(
      "The switching instants are located. For more than two signals use several switches in series, or an "
      "\"expression\" with if().");
  spec.input(&In<double>::above, "above", "$a", "output while the control is above the level");
  spec.input(&In<double>::control, "control", "$c", "control signal");
  spec.input(&In<double>::below, "below", "$a", "output while the control is at or below the level");
  spec.output(&Out<double>::y, "y", "$a", "the selected signal");
  spec.param(&Params<double>::level, "level", "$c", "switching level of the control").optional("0");
}

void ManualSwitch::describe(BlockSpec<ManualSwitch>& spec) {
  spec.name("manual_switch", "manual switch: selects one of two signals by a parameter")
      .in_group("logic")
      .elementwise()
      .linear();
  spec.law("y = first or second").from("definition");
  spec.remark(
      "The position is fixed during a run; set it with --set NAME.position=second. To exchange whole "
      "blocks use a choice (\"choose\", \"from\").");
  spec.input(&In<double>::first, "first", "$a", "output at position first");
  spec.input(&In<double>::second, "second", "$a", "output at position second");
  spec.output(&Out<double>::y, "y", "$a", "the selected signal");
  spec.text("position", {"first", "second"}, "the selected input");
}

Kernel switch_block() { return kernel<Switch>(); }
Kernel manual_switch_block() { return kernel<ManualSwitch>(); }

}  // namespace hysteron::blocks
