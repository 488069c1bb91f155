#include "blocks/mechanics/transmission.h"

namespace hysteron::blocks {

namespace {

constexpr const char* source_of_transmissions =
    "Nordin, Gutman, Automatica 38 (2002) 1633-1649 (play with damping in contact); Niemann, Winter, Maschinenelemente "
    "2 (2003), section 21.6 (losses)";

template <class B>
void remarks(BlockSpec<B>& spec, const char* driven) {
  spec.remark(std::string("It stands between two bodies, each of which has its own block: ") + driven);
  spec.remark("Stiff ones make stiff diagrams; take the stiffness that it has.");
  spec.remark("While the sides touch the damping acts, but they do not stick together: with a gap they never pull.");
  spec.remark("Losses turn their sign with the driver's motion, within 0.01 rad/s.");
}

template <class B>
void describe_contact(BlockSpec<B>& spec, const std::string& force, const std::string& way) {
  using P = typename B::template Params<double>;
  spec.param(&P::stiffness, "stiffness", force + "/" + way, "of all that gives, seen from the driven side").positive();
  spec.param(&P::damping, "damping", force + "*s/" + way, "while the sides touch").optional("0").not_negative();
  spec.param(&P::gap, "gap", way, "total play, seen from the driven side; 0 = none").optional("0").not_negative();
  spec.variation("backlash", spec.type, {{"gap", "0"}});
  spec.param(&P::efficiency, "efficiency", "", "power out over power in, whichever side drives")
      .optional("1")
      .positive()
      .maximum = 1;
}

template <class B>
void describe_shaft_and_carriage(BlockSpec<B>& spec) {
  using I = ShaftAndCarriage<double>;
  using O = ForceAndTorque<double>;
  spec.input(&I::angle, "angle", "rad", "of the shaft");
  spec.input(&I::angular_velocity, "angular_velocity", "rad/s", "of the shaft");
  spec.input(&I::position, "position", "m", "of what it moves");
  spec.input(&I::velocity, "velocity", "m/s", "of what it moves");
  spec.output(&O::force, "force", "N", "on what it moves");
  spec.output(&O::torque, "torque", "N*m", "that the shaft must give; take it from the motor's");
}

}  // namespace

void Gear::describe(BlockSpec<Gear>& spec) {
  spec.name("gear", "gear, coupling or belt between two shafts: ratio, compliance, play, efficiency")
      .in_group("mechanics");
  spec.law(
          "twist = angle_in/ratio - angle_out; torque_out = stiffness (twist -+ gap/2) + damping twist' beyond the gap, "
          "0 within; torque_in = torque_out/ratio over the efficiency where it drives, times it where it is driven")
      .from(source_of_transmissions);
  remarks(spec, "\"inertia\" with the torque of the motor less torque_in, and one that torque_out turns.");
  spec.remark("A belt between pulleys of radius r1 and r2 is a gear of ratio r2/r1 and of its stiffness times r2^2.");
  spec.input(&In<double>::angle_in, "angle_in", "rad", "of the driving shaft");
  spec.input(&In<double>::velocity_in, "velocity_in", "rad/s", "of the driving shaft");
  spec.input(&In<double>::angle_out, "angle_out", "rad", "of the driven shaft");
  spec.input(&In<double>::velocity_out, "velocity_out", "rad/s", "of the driven shaft");
  spec.output(&Out<double>::torque_out, "torque_out", "N*m", "on the driven shaft");
  spec.output(&Out<double>::torque_in, "torque_in", "N*m", "that the driving shaft must give");
  spec.param(&Params<double>::ratio, "ratio", "", "turns of the driving shaft for one of the driven").positive();
  describe_contact(spec, "N*m", "rad");
}

void Belt::describe(BlockSpec<Belt>& spec) {
  spec.name("belt", "belt or rack that a pulley moves: compliance, play, efficiency").in_group("mechanics");
  spec.law(
          "stretch = radius angle - position; force = stiffness stretch + damping stretch' (beyond a gap as in gear); "
          "torque = radius force over the efficiency where it drives, times it where it is driven")
      .from(source_of_transmissions);
  remarks(spec, "the pulley an \"inertia\", the carriage a \"mass_spring_damper\" of stiffness 0.");
  describe_shaft_and_carriage(spec);
  spec.param(&Params<double>::radius, "radius", "m", "of the pulley, to the middle of the belt").positive();
  describe_contact(spec, "N", "m");
}

void BallScrew::describe(BlockSpec<BallScrew>& spec) {
  spec.name("ball_screw", "screw that moves a nut: pitch and its errors, compliance, play, efficiency")
      .in_group("mechanics");
  spec.law(
          "ahead = pitch (1 + pitch_error) angle/(2 pi) + wobble sin(angle + wobble_phase) - position; force = "
          "stiffness ahead + damping ahead' (beyond a gap as in gear); torque = force pitch/(2 pi) over the efficiency "
          "where it drives, times it where it is driven")
      .from(source_of_transmissions);
  remarks(spec, "the screw an \"inertia\", the table a \"mass_spring_damper\" of stiffness 0.");
  describe_shaft_and_carriage(spec);
  spec.param(&Params<double>::pitch, "pitch", "m", "way of the nut in one turn, e.g. \"5 mm\"").positive();
  describe_contact(spec, "N", "m");
  spec.param(&Params<double>::pitch_error, "pitch_error", "", "by how much the pitch is longer, e.g. \"20 um/m\"")
      .optional("0");
  spec.param(&Params<double>::wobble, "wobble", "m", "error that comes again each turn").optional("0");
  spec.param(&Params<double>::wobble_phase, "wobble_phase", "deg", "of it at angle 0").optional("0 deg");
}

Kernel gear_block() { return kernel<Gear>(); }
Kernel belt_block() { return kernel<Belt>(); }
Kernel ball_screw_block() { return kernel<BallScrew>(); }

}  // namespace hysteron::blocks
