// Decides the blocks "bouc_wen_inverse" (continuous) and "sampled_bouc_wen_inverse". Does not decide their law:
// models/compensators/bouc_wen_compensator.h.
#pragma once

#include <string>

#include "engine/block/block.h"
#include "models/compensators/bouc_wen_compensator.h"

namespace hysteron::blocks {

struct BoucWenInverse {
  template <class T>
  struct Params {
    T alpha, beta, gamma, d_p, exponent, scale, initial, origin;
  };
  template <class T>
  struct In {
    T y;
  };
  template <class T>
  struct State {
    T z;
  };
  template <class T>
  struct Out {
    T u;
  };
  static void describe(BlockSpec<BoucWenInverse>& spec);
  template <class T>
  static bouc_wen::Params<T> law(const Params<T>& p) {
    return {p.alpha, p.beta, p.gamma, p.d_p, value_of(p.exponent), value_of(p.scale)};
  }
  template <class T>
  static Out<T> output(const Params<T>& p, const State<T>& s, const In<T>& in) {
    return {bouc_wen::command(law(p), T{in.y + p.origin}, s.z)};
  }
  template <class T>
  static State<T> derivative(const Params<T>& p, const State<T>& s, const In<T>&, const In<T>& rate) {
    return {bouc_wen::compensator_rate(law(p), s.z, rate.y)};
  }
  static State<double> initial(const Params<double>& p) { return {p.initial}; }
  static std::string check(const Params<double>& p);
};

struct SampledBoucWenInverse {
  template <class T>
  struct Params {
    T alpha, beta, gamma, d_p, exponent, scale, initial, origin, period, offset;
  };
  template <class T>
  struct In {
    T y;
  };
  template <class T>
  struct State {
    T z, y;  // hysteretic part, and the wanted displacement that it is for
  };
  template <class T>
  struct Out {
    T u;
  };
  static void describe(BlockSpec<SampledBoucWenInverse>& spec);
  template <class T>
  static bouc_wen::Params<T> law(const Params<T>& p) {
    return {p.alpha, p.beta, p.gamma, p.d_p, value_of(p.exponent), value_of(p.scale)};
  }
  template <class T>
  static State<T> update(const Params<T>& p, const State<T>& s, const In<T>& in) {
    return {bouc_wen::compensator_after(law(p), s.z, T{in.y - s.y}), in.y};
  }
  template <class T>
  static Out<T> output(const Params<T>& p, const State<T>& s, const In<T>& in) {
    return {bouc_wen::command(law(p), T{in.y + p.origin}, update(p, s, in).z)};
  }
  static State<double> initial(const Params<double>& p) { return {p.initial, 0}; }
  static std::string check(const Params<double>& p);
};

Kernel bouc_wen_inverse_block();
Kernel sampled_bouc_wen_inverse_block();

}  // namespace hysteron::blocks
