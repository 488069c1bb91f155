// Decides the block "bearing_friction": dry friction beside a damping. Does not decide its law:
// models/mechanics/bearing.h.
#pragma once

#include <string>

#include "engine/block/block.h"
#include "models/mechanics/bearing.h"

namespace hysteron::blocks {

struct BearingFriction {
  template <class T>
  struct Params {
    T level, slip_distance, excess, stribeck_velocity;
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
  static void describe(BlockSpec<BearingFriction>& spec);
  template <class T>
  static bearing::Params<T> law(const Params<T>& p) {
    return {p.level, p.slip_distance, p.excess, p.stribeck_velocity};
  }
  template <class T>
  static Out<T> output(const Params<T>& p, const State<T>& s, const In<T>& in) {
    return {bearing::braking_speed(law(p), s.share, in.u)};
  }
  template <class T>
  static State<T> derivative(const Params<T>& p, const State<T>& s, const In<T>& in) {
    return {bearing::share_rate(law(p), s.share, in.u)};
  }
  struct OwnStep {
    bearing::Params<double> law_;
    explicit OwnStep(const Params<double>& p) : law_(law(p)) {}
    bool takes(double) const { return true; }
    State<double> operator()(const State<double>& s, const In<double>& from, const In<double>& to, double h) const {
      return {bearing::share_after(law_, s.share, from.u, to.u, h)};
    }
  };
  /// It holds nothing at rest; a recording that begins in motion finds it sliding.
  static State<double> rest(const Params<double>&, const In<double>& in) {
    return {presliding::sliding_share(0, in.u)};
  }
  static std::string check(const Params<double>& p);
};

Kernel bearing_friction_block();

}  // namespace hysteron::blocks
