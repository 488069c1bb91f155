#include "blocks/continuous/pi_controller.h"

namespace hysteron::blocks {

void PiController::describe(BlockSpec<PiController>& spec) {
  spec.name("pi_controller", "PI controller, continuous").in_group("continuous").controller().elementwise().linear();
  spec.law("y = kp u + x, dx/dt = ki u, x(0) = initial").from("thesis Eq. 2.48 with K_d = 0");
  spec.remark("The input is the control error, reference minus measured value: a sum with \"signs\": \"+-\".");
  spec.input(&In<double>::u, "u", "$a", "control error");
  spec.state(&State<double>::x, "x", "$b", "integral part");
  spec.output(&Out<double>::y, "y", "$b", "command");
  spec.param(&Params<double>::kp, "kp", "$b/$a", "proportional gain, e.g. \"1.207 V/um\"").linear();
  spec.param(&Params<double>::ki, "ki", "$b/$a/s", "integral gain, e.g. \"7009 V/(um s)\"").linear();
  spec.param(&Params<double>::initial, "initial", "$b", "initial value of the integral part").optional("0").offset();
}

Kernel pi_controller_block() { return kernel<PiController>(); }

}  // namespace hysteron::blocks
