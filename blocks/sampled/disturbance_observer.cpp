#include "blocks/sampled/disturbance_observer.h"

namespace hysteron::blocks {

void DisturbanceObserver::describe(Declaration& d) {
  d.name("disturbance_observer", "what acts on an inertia besides the command, and the command without it")
      .in_group("sampled")
      .linear();
  d.law(
       "disturbance_k = s inertia v_k/T - z_k, z_(k+1) = z_k + s (y_k + s inertia v_k/T - z_k), s = 1 - exp(-2 pi corner T), T "
       "= period; y = command - disturbance (compensate), or command (watch)")
      .from("Ohnishi, Shibata, Murakami, IEEE/ASME Trans. Mechatronics 1 (1996) 56-67; samples held");
  d.remark(
      "compensate: the output is what the drive shall do, so that friction, gravity and load below the corner seem not to be "
      "there. watch: the input is what the drive does, limits included, and the disturbance is told.");
  d.remark(
      "inertia is what the drive is taken to be: a mass with forces and m/s, a moment of inertia with torques and rad/s.");
  d.input("command", "$a", "force or torque that is wanted");
  d.input("speed", "$b", "measured speed");
  d.output("y", "$a", "force or torque of the drive");
  d.output("disturbance", "$a", "what acts besides it");
  d.state("z", "$a", "command and rate of momentum behind the low-pass");
  d.parameter("inertia", "$a*s/$b", "force over acceleration");
  d.parameter("corner", "Hz", "up to where disturbances are seen").positive();
  d.text("use", {"compensate", "watch"}, "take the disturbance from the command, or only tell it");
  d.sampled();
}

Sizes DisturbanceObserver::sizes(const Shape&) {
  Sizes s;
  s.outputs = 2;
  s.sampled_states = 1;
  return s;
}

Kernel disturbance_observer_block() { return kernel<DisturbanceObserver>(); }

}  // namespace hysteron::blocks
