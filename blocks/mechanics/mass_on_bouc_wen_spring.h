// Decides the block "mass_on_bouc_wen_spring": a mass on a spring beside which a Bouc-Wen law holds it back. Does not
// decide that law: models/hysteresis/bouc_wen.h.
#pragma once

#include "blocks/mechanics/step_under_memory.h"
#include "engine/block/block.h"
#include "models/hysteresis/bouc_wen.h"

namespace hysteron::blocks {

/// What the law holds back in a row (step_under_memory.h): alpha [N/m], beta and gamma [1/m], z [N], exponent 1.
class HeldByBoucWen {
 public:
  explicit HeldByBoucWen(bouc_wen::Params<double> law) : law_(law) {}

  double pull_at(const double* x) const { return -x[2]; }
  void place(const double* x, double) { z_ = x[2]; }
  double pull(double way) const { return -bouc_wen::z_in_closed_form(law_, z_, way); }
  mass_motion::Force force(double way) const;
  void move(double way, double* x) const { x[2] = bouc_wen::z_in_closed_form(law_, z_, way); }

 private:
  bouc_wen::Params<double> law_;
  double z_ = 0;
};

struct MassOnBoucWenSpring {
  enum Parameter {
    mass,
    damping,
    stiffness,
    hysteretic_share,
    beta,
    gamma,
    initial_position,
    initial_velocity,
    stiffening,
    quadratic,
    quintic,
    drag
  };

  static void describe(Declaration& d);
  static Sizes sizes(const Shape& shape);

  template <class T>
  static void output(const View<T>& v) {
    v.out[0] = v.x[0];
    v.out[1] = v.x[1];
  }
  /// The spring that remembers.
  template <class T>
  static bouc_wen::Params<T> remembering(const View<T>& v) {
    bouc_wen::Params<T> law;
    law.alpha = v.parameter(hysteretic_share) * v.parameter(stiffness);
    law.beta = v.parameter(beta);
    law.gamma = v.parameter(gamma);
    return law;
  }
  /// The mass on the rest of its spring.
  template <class T>
  static mass_spring_damper::Params<T> elastic(const View<T>& v) {
    auto law = bent_law<MassOnBoucWenSpring>(v);
    law.stiffness = T((T(1.0) - v.parameter(hysteretic_share)) * v.parameter(stiffness));
    return law;
  }
  template <class T>
  static void derivative(const View<T>& v) {
    v.out[0] = v.x[1];
    v.out[1] = mass_spring_damper::acceleration(elastic(v), T(v.x[0]), T(v.x[1]), T(v.u[0] - v.x[2]));
    v.out[2] = bouc_wen::z_rate(remembering(v), T(v.x[2]), T(v.x[1]));
  }
  struct OwnStep : StepUnderMemory<HeldByBoucWen> {
    explicit OwnStep(const View<double>& v);
  };
  static void rest(const View<double>& v);
  static void initial_states(const View<double>& v);
};

Kernel mass_on_bouc_wen_spring_block();

}  // namespace hysteron::blocks
