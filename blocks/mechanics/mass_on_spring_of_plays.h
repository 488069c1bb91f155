// Decides the block "mass_on_spring_of_plays": a mass on a spring that remembers turning points, unevenly over its
// travel. Does not decide the law of the plays: models/mechanics/uneven_plays.h.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "blocks/mechanics/step_under_memory.h"
#include "engine/block/block.h"
#include "models/mechanics/uneven_plays.h"

namespace hysteron::blocks {

/// What the plays give way to in a row (step_under_memory.h).
class HeldByPlays {
 public:
  HeldByPlays(uneven_plays::Range<double> range, std::span<const double> radius, std::span<const double> at_lower,
              std::span<const double> in_middle, std::span<const double> at_upper);

  double pull_at(const double* x) const;
  void place(const double* x, double speed);
  double pull(double way);
  mass_motion::Force force(double way);
  void move(double way, double* x);

 private:
  void turn(double way);
  double passed_on(std::size_t i, double w) const { return w == places_[i] ? passed_[i] : law_[i](w); }

  uneven_plays::Range<double> range_;
  std::span<const double> radius_;
  std::vector<uneven_plays::Strength<double>> strength_;
  std::vector<uneven_plays::PassedOn> law_;
  double from_ = 0;                             ///< [m] the mass
  double side_ = 0;                             ///< the direction in which it moves from there; 0: not asked yet
  std::vector<double> places_;                  ///< [m] the plays
  std::vector<double> passed_;                  ///< [N] by each where it stands
  std::vector<uneven_plays::Carried> carried_;  ///< in that direction
};

struct MassOnSpringOfPlays {
  enum Parameter {
    mass,
    damping,
    stiffness,
    thresholds,
    at_lower,
    in_middle,
    at_upper,
    lower,
    upper,
    initial_position,
    initial_velocity,
    stiffening,
    quadratic,
    quintic,
    drag
  };

  static void describe(Declaration& d);
  static Sizes sizes(const Shape& shape);
  static std::string check(const View<double>& v);

  template <class T>
  static void output(const View<T>& v) {
    v.out[0] = v.x[0];
    v.out[1] = v.x[1];
  }
  template <class T>
  static uneven_plays::Range<T> range(const View<T>& v) {
    return {v.parameter(lower), v.parameter(upper)};
  }
  template <class T>
  static uneven_plays::Strength<T> strength(const View<T>& v, std::size_t i) {
    return {v.list(at_lower)[i], v.list(in_middle)[i], v.list(at_upper)[i]};
  }
  template <class T>
  static void derivative(const View<T>& v) {
    const auto radius = v.list(thresholds);
    T force = v.u[0];
    for (std::size_t i = 0; i < radius.size(); ++i) {
      force += uneven_plays::passed_on(range(v), strength(v, i), T(v.x[i + 2]));
      v.out[i + 2] = uneven_plays::rate(T(radius[i]), T(v.x[i + 2]), T(v.x[0]), T(v.x[1]));
    }
    v.out[0] = v.x[1];
    v.out[1] = mass_spring_damper::acceleration(bent_law<MassOnSpringOfPlays>(v), T(v.x[0]), T(v.x[1]), force);
  }
  struct OwnStep : StepUnderMemory<HeldByPlays> {
    explicit OwnStep(const View<double>& v);
  };
  static void rest(const View<double>& v);
  static void initial_states(const View<double>& v);
};

Kernel mass_on_spring_of_plays_block();

}  // namespace hysteron::blocks
