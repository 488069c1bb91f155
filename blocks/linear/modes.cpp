#include "blocks/linear/modes.h"

namespace hysteron::blocks {

void Modes::describe(Declaration& d) {
  d.name("modes", "adds resonant modes to a motion, static gain 1").in_group("linear").elementwise().linear();
  d.law(
       "y = u + sum positions[k] (q_k - u) + velocities[k] q_k'/w_k, q_k'' + 2 dampings[k] w_k q_k' + w_k^2 q_k = "
       "w_k^2 u, w_k = 2 pi frequencies[k]")
      .from("modal sum with two residues; Preumont, Vibration Control of Active Structures, 3rd ed. (2011), chapter 2");
  d.remark(
      "The static gain stays 1: positions[k] is the fraction of the motion that moves with mode k. With "
      "positions and velocities 0 the block has no effect.");
  d.input("u", "$a", "the motion without the modes");
  d.output("y", "$a", "the motion with the modes");
  d.state("q", "$a", "motion of each mode, then its velocity over w_k");
  d.list("frequencies", "Hz", "undamped natural frequency of each mode").positive();
  d.list("dampings", "", "damping ratio of each mode").not_negative().as_long_as("frequencies");
  d.list("positions", "", "residues: fraction of each mode's motion q_k").linear().as_long_as("frequencies");
  d.list("velocities", "", "residues: fraction of each mode's velocity q_k'/w_k").linear().as_long_as("frequencies");
}

Sizes Modes::sizes(const Shape& shape) {
  Sizes s;
  const int n = shape.length("frequencies");
  s.states = 2 * n;
  for (const char* list : {"dampings", "positions", "velocities"})
    if (n < 1 || shape.length(list) != n)
      s.error =
          "\"frequencies\", \"dampings\", \"positions\" and \"velocities\" must be lists of one length; give one of "
          "each per mode";
  return s;
}

void Modes::rest(const View<double>& v) {
  for (int k = 0; k < v.n_x; ++k) v.out[k] = k < v.n_x / 2 ? v.u[0] : 0;
}

Kernel modes_block() { return kernel<Modes>(); }

}  // namespace hysteron::blocks
