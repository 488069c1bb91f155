// Decides the blocks "mass_with_presliding" (a guide with friction) and "mass_on_hysteretic_spring": a mass on a spring
// beside which elements stick and slip. Does not decide their laws: models/mechanics/presliding.h.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "blocks/mechanics/mass_spring_damper.h"
#include "blocks/mechanics/step_under_memory.h"
#include "engine/block/block.h"
#include "models/mechanics/mass_spring_damper.h"
#include "models/mechanics/presliding.h"

namespace hysteron::blocks {

struct DahlElement {
  static constexpr bool damped = true;  ///< its contact is, by contact_time
  template <class T>
  static T rate(const T& distance, const T& z, const T& velocity) {
    return presliding::deflection_rate(distance, z, velocity);
  }
  using OnItsWay = presliding::SlippingElement;
};
struct SlipElement {
  static constexpr bool damped = false;
  template <class T>
  static T rate(const T& distance, const T& z, const T& velocity) {
    return presliding::slip_rate(distance, z, velocity);
  }
  using OnItsWay = presliding::YieldingElement;
};

/// What elements pull a mass with in a row (step_under_memory.h).
template <class Element>
class HeldByElements {
 public:
  HeldByElements(std::span<const double> stiffness, std::span<const double> distance, double excess,
                 double stribeck_velocity, double contact_time);

  double pull_at(const double* x) const;
  void place(const double* x, double speed);
  double pull(double way) const;
  mass_motion::Force force(double way) const;
  void move(double way, double* x);

 private:
  /// What the damping of a contact adds to its deflection z [m], and how that changes along the way.
  mass_motion::Force damped(double distance, double z, double velocity) const;

  std::span<const double> stiffness_, distance_;
  double excess_, stribeck_velocity_, contact_time_;
  double speed_ = 0;  ///< [m/s] of this row, about
  std::vector<typename Element::OnItsWay> elements_;
};

/// What elements at the deflections z hold a body back with at a velocity [N]; `rates` gets how these change. `level`:
/// see stribeck_level.
template <class Element, class T>
T held_by_elements(std::span<const T> stiffness, std::span<const T> distance, const T& level, const T& contact_time,
                   const T* z, const T& velocity, T* rates) {
  T force{0};
  for (std::size_t i = 0; i < stiffness.size(); ++i) {
    rates[i] = Element::rate(T(distance[i] * level), T(z[i]), velocity);
    force += stiffness[i] * z[i];
    if constexpr (Element::damped) force += stiffness[i] * contact_time * rates[i];
  }
  return force;
}
/// As many elements as `stiffness` has, each with a distance; the error otherwise, "" if it is so.
std::string elements_error(const Shape& shape);

template <class Element>
struct MassWithElements {
  enum Parameter {
    mass,
    damping,
    stiffness,
    contact_stiffness,
    slip_distance,
    excess,
    stribeck_velocity,
    initial_position,
    initial_velocity,
    stiffening,
    quadratic,
    quintic,
    drag,
    contact_time  ///< only of elements whose contact is damped
  };

  static void describe(Declaration& d);
  static Sizes sizes(const Shape& shape);
  template <class T>
  static void output(const View<T>& v) {
    v.out[0] = v.x[0];
    v.out[1] = v.x[1];
  }
  template <class T>
  static void derivative(const View<T>& v) {
    const T velocity = v.x[1];
    const T level = presliding::stribeck_level(v.parameter(excess), v.parameter(stribeck_velocity), velocity);
    const T held = held_by_elements<Element, T>(v.list(contact_stiffness), v.list(slip_distance), level,
                                                time_of_contact(v), v.x + 2, velocity, v.out + 2);
    v.out[0] = velocity;
    v.out[1] = mass_spring_damper::acceleration(bent_law<MassWithElements>(v), v.x[0], velocity, T(v.u[0] - held));
  }
  template <class T>
  static T time_of_contact([[maybe_unused]] const View<T>& v) {
    if constexpr (Element::damped) return v.parameter(contact_time);
    return T{0};
  }
  struct OwnStep : StepUnderMemory<HeldByElements<Element>> {
    explicit OwnStep(const View<double>& v);
  };

  /// The elements at rest hold nothing: as after a long decaying motion.
  static void rest(const View<double>& v) {
    v.out[0] = mass_spring_damper::rest(bent_law<MassWithElements>(v), v.u[0]);
    for (int i = 1; i < v.n_x; ++i) v.out[i] = 0;
  }
  static void initial_states(const View<double>& v) {
    v.out[0] = v.parameter(initial_position);
    v.out[1] = v.parameter(initial_velocity);
    for (int i = 2; i < v.n_x; ++i) v.out[i] = 0;
  }
};

/// What bodies with elements declare behind their name and law.
void describe_elements(Declaration& d, const MotionWords& words = translation);
/// Of these, the elements alone: their state, contact_stiffness .. stribeck_velocity.
void describe_contacts(Declaration& d, const MotionWords& words);
void describe_contact_time(Declaration& d);

Kernel mass_with_presliding_block();
Kernel mass_on_hysteretic_spring_block();

}  // namespace hysteron::blocks
