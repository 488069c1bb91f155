// Decides the block "duffing", one resonance whose spring gets harder or softer: resonance (blocks/linear) on a bent
// spring. For what is known by its frequency only, or is no mass at all, as an electrical circuit; with mass and
// stiffness known, mass_on_stiffening_spring says more. Does not decide its law: models/mechanics/mass_spring_damper.h.
#pragma once

#include <numbers>

#include "blocks/mechanics/mass_spring_damper.h"
#include "engine/block/block.h"

namespace hysteron::blocks {

struct Duffing {
  template <class T>
  struct Params {
    T frequency, damping, stiffening, quadratic, quintic;
  };
  template <class T>
  struct In {
    T u;
  };
  template <class T>
  struct State {
    T y, rate;
  };
  template <class T>
  struct Out {
    T y;
  };
  static void describe(BlockSpec<Duffing>& spec);
  template <class T>
  static Out<T> output(const Params<T>&, const State<T>& s) {
    return {s.y};
  }
  template <class T>
  static State<T> derivative(const Params<T>& p, const State<T>& s, const In<T>& in) {
    return {s.rate, mass_spring_damper::acceleration(law(p), s.y, s.rate, in.u)};
  }
  static State<double> rest(const Params<double>& p, const In<double>& in) {
    return {mass_spring_damper::rest(law(p), in.u), 0};
  }
  /// That of the mass with this law.
  class OwnStep {
   public:
    explicit OwnStep(const Params<double>& p);
    bool takes(double h) const { return step_.takes(h); }
    State<double> operator()(const State<double>& s, const In<double>& from, const In<double>& to, double h) {
      const auto then = step_({s.y, s.rate}, {from.u}, {to.u}, h);
      return {then.position, then.velocity};
    }

   private:
    MassOnStiffeningSpring::OwnStep step_;
  };

 private:
  /// y''/w^2 + 2 damping/w y' + spring = u: mass 1/w^2 [s^2], damping 2 damping/w [s], stiffness 1.
  template <class T>
  static mass_spring_damper::Params<T> law(const Params<T>& p) {
    const T w = 2 * std::numbers::pi * p.frequency;
    return {1.0 / (w * w), 2.0 * p.damping / w, T{1}, p.stiffening, p.quadratic, p.quintic, T{0}};
  }
};

Kernel duffing_block();

}  // namespace hysteron::blocks
