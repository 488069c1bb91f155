// Decides the block "bouc_wen". Does not decide its law: models/hysteresis/bouc_wen.h.
#pragma once

#include <string>

#include "engine/block/block.h"
#include "models/hysteresis/bouc_wen.h"

namespace hysteron::blocks {

struct BoucWen {
  template <class T>
  struct Params {
    T alpha, beta, gamma, d_p, exponent, scale, initial;
  };
  template <class T>
  struct In {
    T u;
  };
  template <class T>
  struct State {
    T z;
  };
  template <class T>
  struct Out {
    T y;
  };
  static void describe(BlockSpec<BoucWen>& spec);
  template <class T>
  static Out<T> output(const Params<T>& p, const State<T>& s, const In<T>& in) {
    return {p.d_p * in.u - s.z};
  }
  template <class T>
  static State<T> derivative(const Params<T>& p, const State<T>& s, const In<T>&, const In<T>& rate) {
    const bouc_wen::Params<T> law{p.alpha, p.beta, p.gamma, p.d_p, value_of(p.exponent), value_of(p.scale)};
    return {bouc_wen::z_rate(law, s.z, rate.u)};
  }
  /// Only for exponent 1 is there a closed form.
  struct OwnStep {
    bouc_wen::Params<double> law;
    explicit OwnStep(const Params<double>& p) : law{p.alpha, p.beta, p.gamma, p.d_p, p.exponent, p.scale} {}
    bool takes(double) const { return law.exponent == 1; }
    State<double> operator()(const State<double>& s, const In<double>& from, const In<double>& to, double) const {
      return {bouc_wen::z_in_closed_form(law, s.z, to.u - from.u)};
    }
  };
  static State<double> initial(const Params<double>& p) { return {p.initial}; }
  static std::string check(const Params<double>& p);
};

/// "" or why these numbers leave z without a limit, and the cure. Of every block of the law.
std::string bouc_wen_limit_check(double alpha, double beta, double gamma);

Kernel bouc_wen_block();

}  // namespace hysteron::blocks
