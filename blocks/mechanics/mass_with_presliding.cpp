#include "blocks/mechanics/mass_with_presliding.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hysteron::blocks {

void describe_contacts(Declaration& d, const MotionWords& words) {
  d.state("deflection", words.place_unit, "deflection of each element");
  d.list("contact_stiffness", words.per_place(), "stiffness of each element while it sticks").not_negative();
  d.list("slip_distance", words.place_unit,
         "deflection at which each element slips; its friction is contact_stiffness times slip_distance")
      .positive()
      .difference()
      .as_long_as("contact_stiffness");
  d.parameter("excess", "", "Stribeck effect: friction at low speed over Coulomb friction, minus 1")
      .optional("0")
      .not_negative();
  d.parameter("stribeck_velocity", words.speed_unit(), "Stribeck velocity: speed over which the excess decays")
      .optional("1 " + words.speed_unit())
      .positive();
}

void describe_elements(Declaration& d, const MotionWords& words) {
  auto& stiffness = describe_motion(d, words);
  if (words.body == rotation.body) stiffness.optional("0");  // a shaft turns freely
  describe_contacts(d, words);
  describe_start(d, words);
  describe_beyond_linear(d, words);
}

void describe_contact_time(Declaration& d) {
  d.parameter("contact_time", "s", "damping of a contact divided by its stiffness; acts while it sticks")
      .optional("0 s")
      .not_negative();
}

template <>
void MassWithElements<DahlElement>::describe(Declaration& d) {
  d.name("mass_with_presliding", "mass on a spring with presliding friction, driven by a force");
  d.law(
       "mass dv/dt = force - damping v - stiffness x - sum contact_stiffness_i (z_i + contact_time dz_i/dt), dx/dt = "
       "v, dz_i/dt = v - |v| z_i/(slip_distance_i (1 + excess exp(-(v/stribeck_velocity)^2)))")
      .from(
          "Dahl, AIAA J. 14 (1976) 1675-1682; several elements: Lampaert, Al-Bender, Swevers, PhysCon (2003) "
          "1170-1178; excess and contact_time: Canudas de Wit et al., IEEE Trans. Autom. Control 40 (1995) 419-425");
  d.remark("One element is enough for a guide with friction.");
  d.remark(
      "Unlike mass_with_friction it yields elastically before it slides, and under a vibrating force it "
      "drifts instead of sticking.");
  describe_elements(d);
  describe_contact_time(d);
}

template <>
void MassWithElements<SlipElement>::describe(Declaration& d) {
  d.name("mass_on_hysteretic_spring", "mass on a spring with rate-independent hysteresis, driven by a force");
  d.law(
       "mass dv/dt = force - damping v - stiffness x - sum contact_stiffness_i z_i, dx/dt = v, dz_i/dt = v (1 - "
       "(z_i/slip_distance_i)^4) while v z_i > 0, else v; excess as in mass_with_presliding")
      .from("Iwan, J. Appl. Mech. 33 (1966) 893-900: elements that yield, in parallel");
  d.remark(
      "With several elements, soft and stiff ones, minor loops nearly close at their turning points, as "
      "with play operators.");
  d.remark("With contact_stiffness 0 the block equals mass_spring_damper.");
  describe_elements(d);
}

std::string elements_error(const Shape& shape) {
  const int n = shape.length("contact_stiffness");
  if (n >= 1 && n == shape.length("slip_distance")) return "";
  return "\"contact_stiffness\" and \"slip_distance\" must be lists of one length; give one of each per element";
}

template <class Element>
Sizes MassWithElements<Element>::sizes(const Shape& shape) {
  Sizes s;
  const int n = shape.length("contact_stiffness");
  s.states = 2 + n;
  s.outputs = 2;
  s.feedthrough = false;
  s.error = elements_error(shape);
  return s;
}

template <class Element>
HeldByElements<Element>::HeldByElements(std::span<const double> stiffness, std::span<const double> distance,
                                        double excess, double stribeck_velocity, double contact_time)
    : stiffness_(stiffness),
      distance_(distance),
      excess_(excess),
      stribeck_velocity_(stribeck_velocity),
      contact_time_(contact_time) {
  for (const double d : distance_) elements_.emplace_back(d, 0.0);
}

template <class Element>
mass_motion::Force HeldByElements<Element>::damped(double distance, double z, double velocity) const {
  if (!Element::damped || contact_time_ == 0) return {0, 0};
  const double rate = Element::rate(distance, z, velocity), along = velocity < 0 ? -1 : 1;
  // dz/dt falls by |v|/distance for each metre of z (Dahl).
  return {contact_time_ * rate,
          -contact_time_ * std::fabs(velocity) / distance * along * Element::rate(distance, z, along)};
}

template <class Element>
double HeldByElements<Element>::pull_at(const double* x) const {
  const double level = excess_ > 0 ? presliding::stribeck_level(excess_, stribeck_velocity_, x[1]) : 1.0;
  double force = 0;
  for (std::size_t i = 0; i < stiffness_.size(); ++i)
    force -= stiffness_[i] * (x[i + 2] + damped(distance_[i] * level, x[i + 2], x[1]).value);
  return force;
}

/// What slips fast is not stiff then. What the last step left is known.
template <class Element>
void HeldByElements<Element>::place(const double* x, double speed) {
  speed_ = speed;
  const double share = excess_ > 0 ? presliding::stribeck_level(excess_, stribeck_velocity_, speed) : 1.0;
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    const double distance = distance_[i] * share;
    if (elements_[i].z() != x[i + 2] || elements_[i].distance() != distance)
      elements_[i] = typename Element::OnItsWay(distance, x[i + 2]);
  }
}

template <class Element>
double HeldByElements<Element>::pull(double way) const {
  const double velocity = way == 0 ? speed_ : std::copysign(speed_, way);
  double force = 0;
  for (std::size_t i = 0; i < stiffness_.size(); ++i) {
    const double z = elements_[i].after(way);
    force -= stiffness_[i] * (z + damped(elements_[i].distance(), z, velocity).value);
  }
  return force;
}

template <class Element>
mass_motion::Force HeldByElements<Element>::force(double way) const {
  const double side = way < 0 ? -1 : 1;
  mass_motion::Force force{pull(way), 0};
  for (std::size_t i = 0; i < stiffness_.size(); ++i) {
    const double z = elements_[i].after(way), distance = elements_[i].distance();
    force.slope -= stiffness_[i] *
                   (side * Element::rate(distance, z, side) + damped(distance, z, std::copysign(speed_, side)).slope);
  }
  return force;
}

template <class Element>
void HeldByElements<Element>::move(double way, double* x) {
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    elements_[i].move(way);
    x[i + 2] = elements_[i].z();
  }
}

template <class Element>
MassWithElements<Element>::OwnStep::OwnStep(const View<double>& v)
    : StepUnderMemory<HeldByElements<Element>>(bent_law<MassWithElements>(v),
                                               {v.list(contact_stiffness), v.list(slip_distance), v.parameter(excess),
                                                v.parameter(stribeck_velocity), time_of_contact(v)}) {}

template class HeldByElements<DahlElement>;  // of an inertia, too

Kernel mass_with_presliding_block() { return kernel<MassWithElements<DahlElement>>(); }
Kernel mass_on_hysteretic_spring_block() { return kernel<MassWithElements<SlipElement>>(); }

}  // namespace hysteron::blocks
