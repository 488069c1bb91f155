#include "blocks/mechanics/transmission.h"

namespace hysteron::blocks {

namespace {

constexpr const char* source_of_transmissions =
    "Nordin, Gutman, Automatica 38 (2002) 1633-1649 (play with damping in contact); Niemann, Winter, Maschinenelemente "
    "2 (2003), section 21.6 (losses)";

template <class B>
void remarks(BlockSpec<B>& spec, const char* driven) {
  spec.remark(std::string("It connects two bodies, each with its own block: ") + driven);
  spec.remark("A very high stiffness makes the simulation stiff (slow): use the real stiffness.");
  spec.remark(
      "The damping acts only while the sides are in contact; with a gap the contact only pushes, it never "
      "pulls.");
  spec.remark("The loss changes sign with the direction of motion of the driving side, smoothed over 0.01 rad/s.");
}

template <class B>
void describe_contact(BlockSpec<B>& spec, const std::string& force, const std::string& way) {
  using P = typename B::template Params<double>;
  spec.param(&P::stiffness, "stiffness", force + "/" + way, "total stiffness, referred to the driven side").positive();
  spec.param(&P::damping, "damping", force + "*s/" + way, "damping of the contact, referred to the driven side")
      .optional("0")
      .not_negative();
  spec.param(&P::gap, "gap", way, "total backlash, referred to the driven side; 0 = none").optional("0").not_negative();
  spec.variation("backlash", spec.type, {{"gap", "0"}});
  spec.param(&P::efficiency, "efficiency", "",
             "efficiency: output power over input power, for either direction of power flow")
      .optional("1")
      .positive()
      .maximum = 1;
}

template <class B>
void describe_shaft_and_carriage(BlockSpec<B>& spec) {
  using I = ShaftAndCarriage<double>;
  using O = ForceAndTorque<double>;
  spec.input(&I::angle, "angle", "rad", "angle of the shaft");
  spec.input(&I::angular_velocity, "angular_velocity", "rad/s", "angular velocity of the shaft");
  spec.input(&I::position, "position", "m", "position of the moved body");
  spec.input(&I::velocity, "velocity", "m/s", "velocity of the moved body");
  spec.output(&O::force, "force", "N", "force on the moved body");
  spec.output(&O::torque, "torque", "N*m", "reaction torque on the shaft: subtract it from the motor torque");
}

}  // namespace

void Gear::describe(BlockSpec<Gear>& spec) {
  spec.name("gear", "gear, coupling or belt between two shafts, with compliance and play").in_group("mechanics");
  spec.law(
          "twist = angle_in/ratio - angle_out; torque_out = stiffness (twist -+ gap/2) + damping twist' beyond "
          "the gap, 0 within; torque_in = torque_out/ratio, divided by the efficiency where the in side "
          "drives, multiplied by it where the in side is driven")
      .from(source_of_transmissions);
  remarks(spec, "an \"inertia\" driven by the motor torque minus torque_in, and one driven by torque_out.");
  spec.remark(
      "A belt between pulleys of radius r1 and r2 is a gear of ratio r2/r1 with the stiffness r2^2 times "
      "that of the belt.");
  spec.input(&In<double>::angle_in, "angle_in", "rad", "angle of the input shaft");
  spec.input(&In<double>::velocity_in, "velocity_in", "rad/s", "angular velocity of the input shaft");
  spec.input(&In<double>::angle_out, "angle_out", "rad", "angle of the output shaft");
  spec.input(&In<double>::velocity_out, "velocity_out", "rad/s", "angular velocity of the output shaft");
  spec.output(&Out<double>::torque_out, "torque_out", "N*m", "torque on the output shaft");
  spec.output(&Out<double>::torque_in, "torque_in", "N*m",
              "reaction torque on the input shaft: subtract it from the motor torque");
  spec.param(&Params<double>::ratio, "ratio", "", "gear ratio: turns of the input shaft per turn of the output shaft")
      .positive();
  describe_contact(spec, "N*m", "rad");
}

void Belt::describe(BlockSpec<Belt>& spec) {
  spec.name("belt", "belt or rack moved by a pulley, with compliance and play").in_group("mechanics");
  spec.law(
          "stretch = radius angle - position; force = stiffness stretch + damping stretch' (beyond a gap as in "
          "gear); torque = radius force, divided by the efficiency where the shaft drives, multiplied by it "
          "where the shaft is driven")
      .from(source_of_transmissions);
  remarks(spec, "the pulley an \"inertia\", the carriage a \"mass_spring_damper\" of stiffness 0.");
  describe_shaft_and_carriage(spec);
  spec.param(&Params<double>::radius, "radius", "m", "effective radius of the pulley, to the middle of the belt")
      .positive();
  describe_contact(spec, "N", "m");
}

void BallScrew::describe(BlockSpec<BallScrew>& spec) {
  spec.name("ball_screw", "ball screw and nut, with pitch errors, compliance and play").in_group("mechanics");
  spec.law(
          "ahead = pitch (1 + pitch_error) angle/(2 pi) + wobble sin(angle + wobble_phase) - position; force = "
          "stiffness ahead + damping ahead' (beyond a gap as in gear); torque = force pitch/(2 pi), divided by "
          "the efficiency where the shaft drives, multiplied by it where the shaft is driven")
      .from(source_of_transmissions);
  remarks(spec, "the screw an \"inertia\", the table a \"mass_spring_damper\" of stiffness 0.");
  describe_shaft_and_carriage(spec);
  spec.param(&Params<double>::pitch, "pitch", "m", "lead: travel of the nut per turn, e.g. \"5 mm\"").positive();
  describe_contact(spec, "N", "m");
  spec.param(&Params<double>::pitch_error, "pitch_error", "",
             "relative error of the pitch, e.g. \"20 um/m\"; positive = longer")
      .optional("0");
  spec.param(&Params<double>::wobble, "wobble", "m", "amplitude of the periodic error, once per turn").optional("0");
  spec.param(&Params<double>::wobble_phase, "wobble_phase", "deg", "phase of the periodic error at angle 0")
      .optional("0 deg");
}

Kernel gear_block() { return kernel<Gear>(); }
Kernel belt_block() { return kernel<Belt>(); }
Kernel ball_screw_block() { return kernel<BallScrew>(); }

}  // namespace hysteron::blocks
