#include "blocks/sampled/disturbance_observer.h"

namespace hysteron::blocks {

void DisturbanceObserver::describe(Declaration& d) {
  d.name("disturbance_observer", "disturbance observer (DOB) for a mass or inertia").in_group("sampled").linear();
  d.law(
       "disturbance_k = s inertia v_k/T - z_k, z_(k+1) = z_k + s (y_k + s inertia v_k/T - z_k), s = 1 - exp(-2 pi corner T), T "
       "= period; y = command - disturbance (compensate), or command (watch)")
      .from("Ohnishi, Shibata, Murakami, IEEE/ASME Trans. Mechatronics 1 (1996) 56-67; samples held");
  d.remark(
      "compensate: the estimated disturbance is subtracted from the command, which cancels friction, "
      "gravity and load below the corner frequency. watch: the disturbance is only estimated; wire the "
      "actual force or torque of the drive, limits included, to \"command\".");
  d.remark(
      "inertia is the nominal inertia: a mass for forces and m/s, a moment of inertia for torques and "
      "rad/s.");
  d.input("command", "$a", "commanded force or torque");
  d.input("speed", "$b", "measured speed");
  d.output("y", "$a", "force or torque for the drive");
  d.output("disturbance", "$a", "estimated disturbance; positive values act in the direction of a positive command");
  d.state("z", "$a", "low-pass filtered sum of command and scaled momentum");
  d.parameter("inertia", "$a*s/$b", "nominal mass or moment of inertia");
  d.parameter("corner", "Hz", "bandwidth of the observer").positive();
  d.text("use", {"compensate", "watch"},
         "compensate: subtract the disturbance from the command; watch: only estimate it");
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
