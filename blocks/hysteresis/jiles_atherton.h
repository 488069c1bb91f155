// Decides the blocks of the Jiles-Atherton law: "jiles_atherton", "jiles_atherton_inverse" (continuous) and
// "sampled_jiles_atherton_inverse". Does not decide the law: models/hysteresis/jiles_atherton.h.
#pragma once

#include <string>

#include "engine/block/block.h"
#include "models/hysteresis/jiles_atherton.h"

namespace hysteron::blocks {

/// The law behind the parameters of a block, its curve by the place among the choices of "anhysteretic".
template <class P>
auto jiles_atherton_law(const P& p) {
  jiles_atherton::Params<decltype(p.p_s)> law{
      p.p_s, p.a, p.alpha,
      p.k,   p.c, value_of(p.anhysteretic) == 0 ? jiles_atherton::Curve::tanh : jiles_atherton::Curve::langevin};
  if constexpr (requires { p.upright; }) law.past_upright = value_of(p.upright) != 0;
  return law;
}

struct JilesAtherton {
  template <class T>
  struct Params {
    T p_s, a, alpha, k, c, anhysteretic, initial, scale, upright;
  };
  template <class T>
  struct In {
    T u;
  };
  template <class T>
  struct State {
    T p;
  };
  template <class T>
  struct Out {
    T y;
  };
  static void describe(BlockSpec<JilesAtherton>& spec);
  template <class T>
  static Out<T> output(const Params<T>& p, const State<T>& s) {
    return {p.scale * s.p};
  }
  template <class T>
  static State<T> derivative(const Params<T>& p, const State<T>& s, const In<T>& in, const In<T>& rate) {
    return {jiles_atherton::polarisation_rate(jiles_atherton_law(p), s.p, in.u, rate.u)};
  }
  static State<double> initial(const Params<double>& p) { return {p.initial}; }
  static std::string check(const Params<double>& p);
};

struct JilesAthertonInverse {
  template <class T>
  struct Params {
    T p_s, a, alpha, k, c, anhysteretic, initial, origin, scale;
  };
  template <class T>
  struct In {
    T y;
  };
  template <class T>
  struct State {
    T u;
  };
  template <class T>
  struct Out {
    T u;
  };
  static void describe(BlockSpec<JilesAthertonInverse>& spec);
  template <class T>
  static Out<T> output(const Params<T>&, const State<T>& s) {
    return {s.u};
  }
  template <class T>
  static State<T> derivative(const Params<T>& p, const State<T>& s, const In<T>& in, const In<T>& rate) {
    const auto law = jiles_atherton::scaled(jiles_atherton_law(p), p.scale);
    return {jiles_atherton::field_rate(law, s.u, T{in.y + p.origin}, rate.y)};
  }
  static State<double> initial(const Params<double>& p) { return {p.initial}; }
  static std::string check(const Params<double>& p);
};

struct SampledJilesAthertonInverse {
  template <class T>
  struct Params {
    T p_s, a, alpha, k, c, anhysteretic, initial, origin, scale, period, offset;
  };
  template <class T>
  struct In {
    T y;
  };
  template <class T>
  struct State {
    T u, y;  // the last command, and the displacement that it was for
  };
  template <class T>
  struct Out {
    T u;
  };
  static void describe(BlockSpec<SampledJilesAthertonInverse>& spec);
  template <class T>
  static Out<T> output(const Params<T>& p, const State<T>& s, const In<T>& in) {
    const auto law = jiles_atherton::scaled(jiles_atherton_law(p), p.scale);
    return {jiles_atherton::field_after(law, s.u, T{s.y + p.origin}, T{in.y + p.origin})};
  }
  template <class T>
  static State<T> update(const Params<T>&, const State<T>&, const In<T>& in, const Out<T>& out) {
    return {out.u, in.y};
  }
  static State<double> initial(const Params<double>& p) { return {p.initial, 0}; }
  static std::string check(const Params<double>& p);
};

Kernel jiles_atherton_block();
Kernel jiles_atherton_inverse_block();
Kernel sampled_jiles_atherton_inverse_block();

}  // namespace hysteron::blocks
