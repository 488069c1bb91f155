#include "blocks/mechanics/mass_on_spring_of_plays.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hysteron::blocks {

void MassOnSpringOfPlays::describe(Declaration& d) {
  d.name("mass_on_spring_of_plays", "mass on a spring with Preisach hysteresis, driven by a force");
  d.law(
       "mass dv/dt = force - damping v - stiffness x + sum integral of k_i from 0 to w_i; w_i the two-sided play of x "
       "with thresholds[i]; k_i(w) = (1-p)^2 at_lower[i] + 2 p (1-p) in_middle[i] + p^2 at_upper[i], p = (w - "
       "lower)/(upper - lower) within 0 .. 1")
      .from(
          "Brokate, Sprekels, Hysteresis and Phase Transitions (1996), chapter 2: Preisach's relays as a "
          "superposition of plays");
  d.remark(
      "After a reversal the full stiffness acts; each play that begins to follow the motion reduces it by "
      "k_i.");
  d.remark(
      "If the elements are equally strong over the whole travel, mass_on_hysteretic_spring needs fewer "
      "parameters; those of domains and grains are not.");
  d.remark(
      "The kink at which a play begins to follow is smoothed over a twentieth of its half width, for the "
      "integrator.");
  d.remark("With at_lower, in_middle and at_upper 0 the block equals mass_spring_damper.");
  describe_motion(d);
  d.state("plays", "m", "output w_i of each play");
  d.list("thresholds", "m", "half width (threshold) of each play operator").positive().difference();
  d.list("at_lower", "N/m", "reduction of stiffness by each play at the lower end of the travel")
      .not_negative()
      .as_long_as("thresholds");
  d.list("in_middle", "N/m", "reduction of stiffness by each play in the middle of the travel")
      .not_negative()
      .as_long_as("thresholds");
  d.list("at_upper", "N/m", "reduction of stiffness by each play at the upper end of the travel")
      .not_negative()
      .as_long_as("thresholds");
  d.parameter("lower", "m", "lower end of the travel; beyond it the values of that end hold");
  d.parameter("upper", "m", "upper end of the travel; beyond it the values of that end hold");
  describe_start(d);
  describe_beyond_linear(d);
}

Sizes MassOnSpringOfPlays::sizes(const Shape& shape) {
  Sizes s;
  const int n = shape.length("thresholds");
  s.states = 2 + n;
  s.outputs = 2;
  s.feedthrough = false;
  for (const char* list : {"at_lower", "in_middle", "at_upper"})
    if (shape.length(list) != n)
      s.error = fmt::format("\"{}\" has {} numbers and \"thresholds\" {}; give one of each per play", list,
                            shape.length(list), n);
  return s;
}

std::string MassOnSpringOfPlays::check(const View<double>& v) {
  if (v.parameter(lower) < v.parameter(upper)) return "";
  return fmt::format("lower ({:.4g} m) is not below upper ({:.4g} m); write the smaller one as \"lower\"",
                     v.parameter(lower), v.parameter(upper));
}

HeldByPlays::HeldByPlays(uneven_plays::Range<double> range, std::span<const double> radius,
                         std::span<const double> at_lower, std::span<const double> in_middle,
                         std::span<const double> at_upper)
    : range_(range), radius_(radius), places_(radius.size()), carried_(radius.size()) {
  for (std::size_t i = 0; i < radius.size(); ++i) {
    strength_.push_back({at_lower[i], in_middle[i], at_upper[i]});
    law_.emplace_back(range_, strength_.back());
    passed_.push_back(law_.back()(0));
  }
}

double HeldByPlays::pull_at(const double* x) const {
  double force = 0;
  for (std::size_t i = 0; i < places_.size(); ++i) force += passed_on(i, x[i + 2]);
  return force;
}

void HeldByPlays::place(const double* x, double) {
  from_ = x[0];
  side_ = 0;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    passed_[i] = passed_on(i, x[i + 2]);
    places_[i] = x[i + 2];
  }
}

/// Most ways from one place lead in one direction.
void HeldByPlays::turn(double way) {
  const double side = way < 0 ? -1 : 1;
  if (side == side_) return;
  side_ = side;
  for (std::size_t i = 0; i < places_.size(); ++i)
    carried_[i] = uneven_plays::Carried(radius_[i], places_[i], from_, side);
}

double HeldByPlays::pull(double way) {
  turn(way);
  const double distance = std::fabs(way), to = from_ + way;
  double force = 0;
  for (std::size_t i = 0; i < places_.size(); ++i)
    force += carried_[i].stays(distance) ? passed_[i] : law_[i](carried_[i].at(distance, to));
  return force;
}

mass_motion::Force HeldByPlays::force(double way) {
  mass_motion::Force force{pull(way), 0};
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const double at = carried_[i].at(std::fabs(way), from_ + way);
    force.slope += uneven_plays::strength(range_, strength_[i], at) *
                   std::fabs(uneven_plays::rate(radius_[i], at, from_ + way, way < 0 ? -1.0 : 1.0));
  }
  return force;
}

/// What is passed on there is kept: the next row begins there.
void HeldByPlays::move(double way, double* x) {
  turn(way);
  const double distance = std::fabs(way), to = from_ + way;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    if (!carried_[i].stays(distance)) passed_[i] = law_[i](places_[i] = carried_[i].at(distance, to));
    x[i + 2] = places_[i];
  }
}

MassOnSpringOfPlays::OwnStep::OwnStep(const View<double>& v)
    : StepUnderMemory<HeldByPlays>(bent_law<MassOnSpringOfPlays>(v), {range(v), v.list(thresholds), v.list(at_lower),
                                                                      v.list(in_middle), v.list(at_upper)}) {}

/// Every play stands where the mass does: as after a long decaying motion.
void MassOnSpringOfPlays::rest(const View<double>& v) {
  const auto law = bent_law<MassOnSpringOfPlays>(v);
  const double k = law.stiffness;
  double at = mass_spring_damper::rest(law, v.u[0]);
  if (k > 0)
    at = mass_motion::end_position(v.u[0] / k, 1 / k, at, [&](double place) {
      mass_motion::Force force = BeyondLinear(law).behind_row(place, place, 1);
      for (std::size_t i = 0; i < v.list(thresholds).size(); ++i) {
        force.value += uneven_plays::passed_on(range(v), strength(v, i), place);
        force.slope += uneven_plays::strength(range(v), strength(v, i), place);
      }
      return force;
    });
  v.out[0] = at;
  v.out[1] = 0;
  for (int i = 2; i < v.n_x; ++i) v.out[i] = at;
}

void MassOnSpringOfPlays::initial_states(const View<double>& v) {
  v.out[0] = v.parameter(initial_position);
  v.out[1] = v.parameter(initial_velocity);
  for (std::size_t i = 0; i < v.list(thresholds).size(); ++i)
    v.out[i + 2] = uneven_plays::after(v.list(thresholds)[i], 0, 0, v.out[0]);
}

Kernel mass_on_spring_of_plays_block() { return kernel<MassOnSpringOfPlays>(); }

}  // namespace hysteron::blocks
