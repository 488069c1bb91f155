// Decides the block "guide_friction": friction on a wire that carries a motion. Does not decide its law:
// models/mechanics/guide.h.
#pragma once

#include <string>

#include "engine/block/block.h"
#include "models/mechanics/guide.h"

namespace hysteron::blocks {

struct GuideFriction {
  template <class T>
  struct Params {
    T level, slip_distance, excess, stribeck_velocity, initial;
  };
  template <class T>
  struct In {
    T u;
  };
  template <class T>
  struct State {
    T share;
  };
  template <class T>
  struct Out {
    T y;
  };
  static void describe(BlockSpec<GuideFriction>& spec);
  template <class T>
  static guide::Params<T> law(const Params<T>& p) {
    return {p.level, p.slip_distance, p.excess, p.stribeck_velocity};
  }
  template <class T>
  static Out<T> output(const Params<T>& p, const State<T>& s, const In<T>& in) {
    return {in.u - p.level * s.share};
  }
  template <class T>
  static State<T> derivative(const Params<T>& p, const State<T>& s, const In<T>&, const In<T>& rate) {
    return {guide::share_rate(law(p), s.share, rate.u)};
  }
  struct OwnStep {
    guide::Params<double> law_;
    explicit OwnStep(const Params<double>& p) : law_(law(p)) {}
    bool takes(double) const { return true; }
    State<double> operator()(const State<double>& s, const In<double>& from, const In<double>& to, double h) const {
      return {guide::share_after(law_, s.share, to.u - from.u, h)};
    }
  };
  static State<double> initial(const Params<double>& p) { return {p.initial}; }
  static std::string check(const Params<double>& p);
};

Kernel guide_friction_block();

}  // namespace hysteron::blocks
