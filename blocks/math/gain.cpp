#include "blocks/math/gain.h"

namespace hysteron::blocks {

void Gain::describe(BlockSpec<Gain>& spec) {
  spec.name("gain", "multiplies a signal by a constant")
      .in_group("math")
      .elementwise()
      .linear()
      .law("y = gain u")
      .from("definition");
  spec.remark("A gain of 0 still counts as a connection (e.g. for algebraic loops).");
  spec.variation("offset", "calibration", {{"offset", "0"}});
  spec.input(&In<double>::u, "u", "$a", "the signal");
  spec.output(&Out<double>::y, "y", "$b", "gain times the signal");
  spec.param(&Params<double>::gain, "gain", "$b/$a", "output per input, e.g. \"0.75 um/V\"").linear();
}

void Pass::describe(BlockSpec<Pass>& spec) {
  spec.name("pass", "passes its input through unchanged")
      .in_group("math")
      .elementwise()
      .linear()
      .law("y = u")
      .from("definition");
  spec.remark("Use it as the neutral option of a choice, where an effect is switched off.");
  spec.input(&In<double>::u, "u", "$a", "the signal");
  spec.output(&Out<double>::y, "y", "$a", "the same signal");
}

void Calibration::describe(BlockSpec<Calibration>& spec) {
  spec.name("calibration", "gain and offset, e.g. of a sensor").in_group("math").elementwise().linear().at("measured");
  spec.law("y = gain u + offset").from("definition");
  spec.remark("A plain gain keeps the unit of the signal; with a unit (\"0.1 um/V\") it converts.");
  spec.input(&In<double>::u, "u", "$a", "the true signal");
  spec.output(&Out<double>::y, "y", "$b", "the sensor reading");
  spec.param(&Params<double>::gain, "gain", "$b/$a", "sensitivity: reading per true value").optional("1").linear();
  spec.param(&Params<double>::offset, "offset", "$b", "reading at zero").optional("0").offset().difference();
}

Kernel gain_block() { return kernel<Gain>(); }
Kernel pass_block() { return kernel<Pass>(); }
Kernel calibration_block() { return kernel<Calibration>(); }

}  // namespace hysteron::blocks
