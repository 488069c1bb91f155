#include "blocks/mechanics/mass_spring_damper.h"

#include <cmath>

namespace hysteron::blocks {

namespace {

// What remembers stands beside what bends and beside a fluid.
void describe_memories(Declaration& d) {
  d.variation("presliding", "mass_with_presliding", {{"contact_stiffness", "0 N/m"}, {"slip_distance", "1 m"}})
      .variation("hysteretic_spring", "mass_on_hysteretic_spring",
                 {{"contact_stiffness", "0 N/m"}, {"slip_distance", "1 m"}});
}

}  // namespace

void MassSpringDamper::describe(BlockSpec<MassSpringDamper>& spec) {
  spec.name("mass_spring_damper", "mass on a spring with a damper, driven by a force").linear();
  spec.law("mass dv/dt = force - damping v - stiffness x, dx/dt = v").from("Newton's second law");
  spec.remark(
      "A piezo actuator of free displacement d acts as the force k_a d, where its stiffness k_a is "
      "included in \"stiffness\".");
  spec.variation("stiffening", "mass_on_stiffening_spring", {{"stiffening", "0"}})
      .variation("drag", "mass_with_drag", {{"drag", "0"}})
      .variation("friction", "mass_with_friction", {{"coulomb", "0 N"}, {"breakaway", "0 N"}})
      .variation("resonance", "mass_with_mode", {{"share", "0"}, {"frequency", "1 Hz"}})
      .variation("cogging", "mass_with_cogging", {{"cosine", "0 N"}, {"sine", "0 N"}, {"period", "1 m"}})
      .variation("stops", "mass_with_stops", {{"lower", "-inf m"}, {"upper", "inf m"}});
  describe_memories(spec);
  describe_motion(spec);
  describe_start(spec);
}

void MassOnStiffeningSpring::describe(BlockSpec<MassOnStiffeningSpring>& spec) {
  spec.name("mass_on_stiffening_spring", "mass on a nonlinear spring (Duffing), driven by a force");
  spec.law(
          "mass dv/dt = force - damping v - drag v |v| - stiffness x - quadratic x^2 - stiffening x^3 - quintic x^5, "
          "dx/dt = v")
      .from("Duffing's oscillator; Nayfeh, Mook, Nonlinear Oscillations (1979)");
  spec.remark(
      "With stiffening 0 the block equals mass_spring_damper. Negative values soften the spring: then keep "
      "|x| below sqrt(stiffness/(3 |stiffening|)).");
  describe_motion(spec);
  spec.param(&Params<double>::stiffening, "stiffening", "N/m^3", "cubic stiffness; negative = softening").optional("0");
  spec.param(&Params<double>::quadratic, "quadratic", "N/m^2", "quadratic stiffness, which makes the spring asymmetric")
      .optional("0");
  spec.param(&Params<double>::quintic, "quintic", "N/m^5", "fifth-order stiffness").optional("0");
  describe_drag(spec);
  spec.variation("drag", "mass_on_stiffening_spring", {{"drag", "0"}});
  describe_memories(spec);
  describe_start(spec);
}

void MassWithDrag::describe(BlockSpec<MassWithDrag>& spec) {
  spec.name("mass_with_drag", "mass on a spring with quadratic drag, driven by a force");
  spec.law("mass dv/dt = force - damping v - drag v |v| - stiffness x, dx/dt = v")
      .from("Batchelor, An Introduction to Fluid Dynamics (1967), section 5.11");
  describe_motion(spec);
  describe_drag(spec);
  spec.variation("stiffening", "mass_on_stiffening_spring", {{"stiffening", "0"}});
  describe_memories(spec);
  describe_start(spec);
}

ParameterDeclaration& describe_motion(Declaration& d, const MotionWords& words) {
  d.in_group("mechanics");
  d.input(words.cause, words.cause_unit, std::string(words.cause) + " on the " + words.body);
  d.output(words.place, words.place_unit, words.place);
  d.output("velocity", words.speed_unit(), "velocity");
  d.state(words.place, words.place_unit, words.place);
  d.state("velocity", words.speed_unit(), "velocity");
  d.parameter(words.body, words.body_unit, std::string("moving ") + words.body).positive();
  d.parameter("damping", words.damping_unit(), "viscous damping").optional("0").not_negative();
  return d.parameter("stiffness", words.per_place(), "stiffness of the spring to ground; 0 = none").not_negative();
}
void describe_start(Declaration& d, const MotionWords& words) {
  d.parameter(std::string("initial_") + words.place, words.place_unit, std::string("initial ") + words.place)
      .optional("0");
  d.parameter("initial_velocity", words.speed_unit(), "initial velocity").optional("0");
}
ParameterDeclaration& describe_drag(Declaration& d, const MotionWords& words) {
  return d.parameter("drag", words.drag_unit(), "drag coefficient: drag per squared speed")
      .optional("0")
      .not_negative();
}
void describe_beyond_linear(Declaration& d, const MotionWords& words) {
  d.parameter("stiffening", words.per_place(3), "cubic stiffness; negative = softening").optional("0");
  d.parameter("quadratic", words.per_place(2), "quadratic stiffness, which makes the spring asymmetric").optional("0");
  d.parameter("quintic", words.per_place(5), "fifth-order stiffness").optional("0");
  describe_drag(d, words);
  d.remark("Nonlinear stiffness and drag act as in mass_on_stiffening_spring.");
  d.variation("stiffening", d.type, {{"stiffening", "0"}}).variation("drag", d.type, {{"drag", "0"}});
}

bool BeyondLinear::is_none() const {
  return law_.stiffening == 0 && law_.quadratic == 0 && law_.quintic == 0 && law_.drag == 0;
}

mass_motion::Force BeyondLinear::behind_row(double from, double place, double h) const {
  const double speed = (place - from) / h;
  return {spring(place) + drag(speed),
          law_.stiffness - mass_spring_damper::slope(law_, place) - 2 * law_.drag * std::fabs(speed) / h};
}

const mass_motion::ExactStep& RowStep::of(const mass_spring_damper::Params<double>& law, double length) {
  // Lengths of rows differ by the rounding of their times.
  if (!step || std::fabs(length - h) > 1e-9 * h) {
    step.emplace(law.mass, law.damping, law.stiffness, length);
    h = length;
  }
  return *step;
}

MotionState<double> MassOnStiffeningSpring::OwnStep::operator()(const MotionState<double>& s,
                                                                const ForceIn<double>& from, const ForceIn<double>& to,
                                                                double h) {
  const int steps = mass_motion::steps_of_row(law_.mass, law_.stiffness, h);
  mass_motion::Motion x{s.position, s.velocity};
  if (steps == 0) {
    x = mass_motion::step_to_balance(row_.of(law_, h), x, from.force, to.force, beyond_(x),
                                     [&](double place) { return beyond_.behind_row(s.position, place, h); });
    return {x.position, x.velocity};
  }
  const auto& whole = row_.of(law_, h / steps);
  const auto& half = half_row_.of(law_, h / steps / 2);
  const double rise = (to.force - from.force) / steps;
  for (int i = 0; i < steps; ++i)
    x = mass_motion::step_under(
        whole, half, x, from.force + rise * i, from.force + rise * (i + 1),
        [&](double place) { return beyond_.spring(place); },
        [&](const mass_motion::Motion& m) { return beyond_.drag(m.velocity); }, beyond_.rounds());
  return {x.position, x.velocity};
}

Kernel mass_spring_damper_block() { return kernel<MassSpringDamper>(); }
Kernel mass_on_stiffening_spring_block() { return kernel<MassOnStiffeningSpring>(); }
Kernel mass_with_drag_block() { return kernel<MassWithDrag>(); }

}  // namespace hysteron::blocks
