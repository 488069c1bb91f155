#include "blocks/mass_with_presliding.h"

#include <algorithm>
#include <array>

namespace hysteron::blocks {

namespace {

void describe_elements(Declaration& d) {
  describe_motion(d);
  d.state("deflection", "m", "deflection of each element");
  d.list("contact_stiffness", "N/m", "stiffness of each element while it sticks").not_negative();
  d.list("slip_distance", "m", "deflection at which each element slips; its friction is stiffness times distance")
      .positive()
      .difference()
      .as_long_as("contact_stiffness");
  d.parameter("excess", "", "by how much more it holds before it slides fast, over its friction")
      .optional("0")
      .not_negative();
  d.parameter("stribeck_velocity", "m/s", "speed at which that is gone").optional("1 m/s").positive();
  describe_start(d);
}

}  // namespace

template <>
void MassWithElements<DahlElement>::describe(Declaration& d) {
  d.name("mass_with_presliding", "one mass on a spring beside which elements stick and slip, driven by a force");
  d.law(
       "mass dv/dt = force - damping v - stiffness x - sum contact_stiffness_i z_i, dx/dt = v, dz_i/dt = v - |v| "
       "z_i/(slip_distance_i (1 + excess exp(-(v/stribeck_velocity)^2)))")
      .from(
          "Dahl, AIAA J. 14 (1976) 1675-1682; several elements: Lampaert, Al-Bender, Swevers, PhysCon (2003) "
          "1170-1178; excess: Canudas de Wit et al., IEEE Trans. Autom. Control 40 (1995) 419-425");
  d.remark("One element is a guide with friction.");
  d.remark("Unlike mass_with_friction it gives way a little before it slides, and it never sticks for good.");
  describe_elements(d);
}

template <>
void MassWithElements<SlipElement>::describe(Declaration& d) {
  d.name("mass_on_hysteretic_spring", "one mass on a spring that remembers turning points, driven by a force");
  d.law(
       "mass dv/dt = force - damping v - stiffness x - sum contact_stiffness_i z_i, dx/dt = v, dz_i/dt = v (1 - "
       "(z_i/slip_distance_i)^4) while v z_i > 0, else v; excess as in mass_with_presliding")
      .from("Iwan, J. Appl. Mech. 33 (1966) 893-900: elements that yield, in parallel");
  d.remark("Several elements, soft and stiff ones, nearly close their loops at turning points, as plays do.");
  d.remark("contact_stiffness 0 gives mass_spring_damper.");
  describe_elements(d);
}

template <class Element>
Sizes MassWithElements<Element>::sizes(const Shape& shape) {
  Sizes s;
  const int n = shape.length("contact_stiffness");
  s.states = 2 + n;
  s.outputs = 2;
  s.feedthrough = false;
  if (n < 1 || n != shape.length("slip_distance"))
    s.error = "\"contact_stiffness\" and \"slip_distance\" must be lists of one length; give one of each per element";
  return s;
}

template <class Element>
MassWithElements<Element>::OwnStep::OwnStep(const View<double>& v)
    : law_{v.parameter(mass), v.parameter(damping), v.parameter(stiffness), 0},
      stiffness_(v.list(contact_stiffness)),
      distance_(v.list(slip_distance)),
      excess_(v.parameter(excess)),
      stribeck_velocity_(v.parameter(stribeck_velocity)) {
  for (const double d : distance_) elements_.emplace_back(d, 0.0);
}

template <class Element>
void MassWithElements<Element>::OwnStep::operator()(double* x, const double* from, const double* to, double h) {
  const int steps = mass_motion::steps_of_row(law_.mass, law_.stiffness, h);
  if (steps == 0) return long_row(x, *from, *to, h);
  for (int i = 0; i < steps; ++i) {
    const double begin = *from + (*to - *from) * i / steps;
    const double end = i + 1 == steps ? *to : *from + (*to - *from) * (i + 1) / steps;
    short_row(x, begin, end, h / steps);
  }
}

/// Elements at these deflections, their distances `share` times as long. What the last step left is known.
template <class Element>
void MassWithElements<Element>::OwnStep::place_elements(const double* z, double share) {
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    const double distance = distance_[i] * share;
    if (elements_[i].z() != z[i] || elements_[i].distance() != distance)
      elements_[i] = typename Element::OnItsWay(distance, z[i]);
  }
}

template <class Element>
void MassWithElements<Element>::OwnStep::move_elements(double* z, double way) {
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    elements_[i].move(way);
    z[i] = elements_[i].z();
  }
}

/// Where the elements stand is a function of the way since the last turning point: what slips fast is not stiff then.
/// A row in which the motion turns is two.
template <class Element>
void MassWithElements<Element>::OwnStep::short_row(double* x, double from, double to, double h) {
  const double rise = (to - from) / h;
  double left = h;
  for (int legs = 0; legs < 4 && left > 0; ++legs) {
    const double begin = to - rise * left;
    const double gain = mass_spring_damper::acceleration(law_, x[0], x[1], begin - held(x));
    place_elements(x + 2, level(x[1] + 0.5 * left * gain));
    double length = left;
    auto end = leg(x, begin, to, length);
    if (legs < 3 && x[1] * end.velocity < 0) {
      for (int i = 0; i < 2; ++i) {
        length = std::min(left, length * std::clamp(x[1] / (x[1] - end.velocity), 0.0, 1.5));
        end = leg(x, begin, begin + rise * length, length);
      }
    }
    move_elements(x + 2, end.position - x[0]);
    x[0] = end.position;
    x[1] = end.velocity;
    left = length < left ? left - length : 0;
  }
}

/// What the elements hold back in these states [N].
template <class Element>
double MassWithElements<Element>::OwnStep::held(const double* x) const {
  double force = 0;
  for (std::size_t i = 0; i < stiffness_.size(); ++i) force += stiffness_[i] * x[i + 2];
  return force;
}

/// What they pull with [N] where the mass has moved by `way` [m].
template <class Element>
double MassWithElements<Element>::OwnStep::pull(double way) const {
  double force = 0;
  for (std::size_t i = 0; i < stiffness_.size(); ++i) force -= stiffness_[i] * elements_[i].after(way);
  return force;
}

/// The mass alone, on a spring of which the elements are a part.
template <class Element>
mass_motion::Motion MassWithElements<Element>::OwnStep::leg(const double* x, double from, double to, double h) {
  const mass_motion::Motion begin{x[0], x[1]};
  const auto at = [&](double place) { return pull(place - x[0]); };
  if (mass_motion::has_exact_step(law_.mass, law_.damping, law_.stiffness, h))
    return mass_motion::step_under(row_.of(law_, h), half_row_.of(law_, h / 2), begin, from, to, at);
  std::array<double, 2> moved{x[0], x[1]};
  std::array<double, 10> work;
  block_detail::runge_kutta(2, moved.data(), h, work.data(), [&](double c, const double* now, double* rate) {
    const double force = from + c * (to - from) + at(now[0]);
    rate[0] = now[1];
    rate[1] = mass_spring_damper::acceleration(law_, now[0], now[1], force);
  });
  return {moved[0], moved[1]};
}

template <class Element>
void MassWithElements<Element>::OwnStep::long_row(double* x, double from, double to, double h) {
  const auto& step = row_.of(law_, h);
  const mass_motion::Motion begin{x[0], x[1]};
  const double before = held(x);
  const double expected = step(begin, from - before, to - before).position;
  // Of the mean speed as it is expected: a force that falls while the speed rises would balance at several places.
  place_elements(x + 2, level((expected - x[0]) / h));
  const auto end = mass_motion::step_to_balance(step, begin, from, to, [&](double place) {
    const double way = place - x[0], side = way < 0 ? -1 : 1;
    mass_motion::Force force{pull(way), 0};
    for (std::size_t i = 0; i < stiffness_.size(); ++i)
      force.slope -= stiffness_[i] * side * Element::rate(elements_[i].distance(), elements_[i].after(way), side);
    return force;
  });
  move_elements(x + 2, end.position - x[0]);
  x[0] = end.position;
  x[1] = end.velocity;
}

Kernel mass_with_presliding_block() { return kernel<MassWithElements<DahlElement>>(); }
Kernel mass_on_hysteretic_spring_block() { return kernel<MassWithElements<SlipElement>>(); }

}  // namespace hysteron::blocks
