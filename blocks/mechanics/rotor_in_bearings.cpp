#include "blocks/mechanics/rotor_in_bearings.h"

#include <string>

namespace hysteron::blocks {
namespace {

/// The body's own words, and those of its bearings.
template <class Body>
void describe_in_bearings(Declaration& d, const std::string& what) {
  BlockSpec<Body> body;
  Body::describe(body);
  d = body;
  d.variations.clear();
  d.remarks.clear();
  d.is_linear = false;
  d.name(body.type + "_with_presliding", what);
  d.law("as " + body.type +
        ", braked by the torque sum contact_stiffness_i (z_i + contact_time dz_i/dt), dz_i/dt = w - |w| "
        "z_i/(slip_distance_i (1 + excess exp(-(w/stribeck_velocity)^2))), w its speed")
      .from("Dahl, AIAA J. 14 (1976) 1675-1682, and as mass_with_presliding; " + body.source);
  d.remark("The friction torque of an element is contact_stiffness times slip_distance.");
  d.remark(
      "It yields elastically before it turns, and under a vibrating torque it drifts instead of sticking. "
      "With contact_stiffness 0 the block equals " +
      body.type + ".");
  describe_contacts(d, rotation);
  describe_contact_time(d);
}

}  // namespace

template <>
void RotorInBearings<DcMotor>::describe(Declaration& d) {
  describe_in_bearings<DcMotor>(d, "brushed DC motor with presliding bearing friction");
}
template <>
void RotorInBearings<Pendulum>::describe(Declaration& d) {
  describe_in_bearings<Pendulum>(d, "pendulum with presliding friction at the pivot");
}

template <class Body>
Sizes RotorInBearings<Body>::sizes(const Shape& shape) {
  Sizes s;
  s.states = moving + shape.length("contact_stiffness");
  s.outputs = block_detail::count<double, typename Body::template Out<double>>();
  s.feedthrough = false;
  s.error = elements_error(shape);
  return s;
}

Kernel dc_motor_with_presliding_block() { return kernel<RotorInBearings<DcMotor>>(); }
Kernel pendulum_with_presliding_block() { return kernel<RotorInBearings<Pendulum>>(); }

}  // namespace hysteron::blocks
