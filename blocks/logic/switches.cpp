#include "blocks/logic/switches.h"

namespace hysteron::blocks {

void Switch::describe(BlockSpec<Switch>& spec) {
  spec.name("switch", "one of two signals, by the level of a third").in_group("logic").elementwise();
  spec.law("y = above if control > level, else below").from("definition");
  spec.remark("A control that is true or false (1, 0) switches at the default level 0.");
  spec.remark(
      "The switching instants are located. More than two: one behind the other, or an \"expression\" with if().");
  spec.input(&In<double>::above, "above", "$a", "goes on while the control is above the level");
  spec.input(&In<double>::control, "control", "$c", "what decides");
  spec.input(&In<double>::below, "below", "$a", "goes on at the level and below");
  spec.output(&Out<double>::y, "y", "$a", "the signal in force");
  spec.param(&Params<double>::level, "level", "$c", "of the control").optional("0");
}

void ManualSwitch::describe(BlockSpec<ManualSwitch>& spec) {
  spec.name("manual_switch", "one of two signals, as a parameter says").in_group("logic").elementwise().linear();
  spec.law("y = first or second").from("definition");
  spec.remark(
      "It stays during a run: --set NAME.position=second. Whole blocks are exchanged by a choice (\"choose\", \"from\").");
  spec.input(&In<double>::first, "first", "$a", "goes on at position first");
  spec.input(&In<double>::second, "second", "$a", "goes on at position second");
  spec.output(&Out<double>::y, "y", "$a", "the signal in force");
  spec.text("position", {"first", "second"}, "which one");
}

Kernel switch_block() { return kernel<Switch>(); }
Kernel manual_switch_block() { return kernel<ManualSwitch>(); }

}  // namespace hysteron::blocks
