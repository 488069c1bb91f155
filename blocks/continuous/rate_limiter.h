// Decides the blocks "rate_limiter" and "current_limit". Does not decide their law: models/continuous/rate_limiter.h.
#pragma once

#include "engine/block/block.h"
#include "models/continuous/rate_limiter.h"

namespace hysteron::blocks {

/// What both blocks do once the law is known.
template <class B>
struct LimitedRate {
  template <class T>
  struct In {
    T u;
  };
  template <class T>
  struct State {
    T y;
  };
  template <class T>
  struct Out {
    T y;
  };
  template <class P, class T>
  static Out<T> output(const P&, const State<T>& s) {
    return {s.y};
  }
  template <class P, class T>
  static State<T> derivative(const P& p, const State<T>& s, const In<T>& in, Mode mode) {
    return {rate_limiter::rate(B::law(p), rate_limiter::Mode(mode.is), s.y, in.u)};
  }
  template <class P, class T>
  static T guard(const P& p, const State<T>& s, const In<T>& in, Mode mode) {
    return rate_limiter::guard(B::law(p), rate_limiter::Mode(mode.is), s.y, in.u);
  }
  template <class P>
  static Mode next(const P& p, const State<double>& s, const In<double>& in, Mode mode) {
    if (guard(p, s, in, mode) > 0) return mode;
    return {rate_limiter::next(B::law(p), s.y, in.u)};
  }
  template <class P>
  static State<double> rest(const P&, const In<double>& in) {
    return {in.u};
  }
  template <class P>
  static State<double> initial(const P& p) {
    return {p.initial};
  }
};

struct RateLimiter : LimitedRate<RateLimiter> {
  template <class T>
  struct Params {
    T rise, fall, time, initial;
  };
  static void describe(BlockSpec<RateLimiter>& spec);
  template <class T>
  static rate_limiter::Params<T> law(const Params<T>& p) {
    return {p.rise, p.fall, p.time};
  }
};

struct CurrentLimit : LimitedRate<CurrentLimit> {
  template <class T>
  struct Params {
    T source, sink, capacitance, time, initial;
  };
  static void describe(BlockSpec<CurrentLimit>& spec);
  template <class T>
  static rate_limiter::Params<T> law(const Params<T>& p) {
    return {p.source / p.capacitance, p.sink / p.capacitance, p.time};
  }
};

Kernel rate_limiter_block();
Kernel current_limit_block();

}  // namespace hysteron::blocks
