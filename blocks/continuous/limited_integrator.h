// Decides the blocks "limited_integrator" and "integrator_with_reset". Does not decide their law:
// models/continuous/limited_integrator.h.
#pragma once

#include <string>

#include "engine/block/block.h"
#include "models/continuous/limited_integrator.h"

namespace hysteron::blocks {

template <class T>
limited_integrator::Limits<T> limits_of(const auto& p) {
  return {p.lower, p.upper};
}

/// Inputs and parameters; and, where no signal sets it, the way through a row.
template <bool resets>
struct IntegratorPorts {
  template <class T>
  struct In {
    T u;
  };
  template <class T>
  struct Params {
    T lower, upper, initial;
  };
  struct OwnStep {
    limited_integrator::Limits<double> limit;
    explicit OwnStep(const Params<double>& p) : limit(limits_of<double>(p)) {}
    bool takes(double) const { return true; }
    template <class State>
    State operator()(const State& s, const In<double>& from, const In<double>& to, double h) const {
      return {limited_integrator::after(limit, s.x, from.u, to.u, h)};
    }
  };
};
template <>
struct IntegratorPorts<true> {
  template <class T>
  struct In {
    T u, reset, start;
  };
  template <class T>
  struct Params {
    T lower, upper, initial, kind;
  };
};

template <bool resets>
struct LimitedIntegrator : IntegratorPorts<resets> {
  template <class T>
  using Params = typename IntegratorPorts<resets>::template Params<T>;
  template <class T>
  using In = typename IntegratorPorts<resets>::template In<T>;
  template <class T>
  struct State {
    T x;
  };
  template <class T>
  struct Out {
    T y;
  };
  static void describe(BlockSpec<LimitedIntegrator>& spec);
  static std::string check(const Params<double>& p);
  static bool is_affine_in_modes(const Params<double>&) { return true; }

  template <class T>
  static Out<T> output(const Params<T>&, const State<T>& s) {
    return {s.x};
  }
  template <class T>
  static State<T> derivative(const Params<T>& p, const State<T>&, const In<T>& in, Mode mode) {
    return {limited_integrator::rate(kind(p), limited_integrator::Mode::of(mode.is), in.u)};
  }
  template <class T>
  static T guard(const Params<T>& p, const State<T>& s, const In<T>& in, Mode mode) {
    return limited_integrator::guard(kind(p), limited_integrator::Mode::of(mode.is), limits_of<T>(p), s.x, in.u,
                                     signal(in));
  }
  static Mode next(const Params<double>& p, const State<double>& s, const In<double>& in, Mode mode) {
    if (guard(p, s, in, mode) > 0) return mode;
    const auto now = limited_integrator::Mode::of(mode.is);
    return {limited_integrator::next(kind(p), now, limits_of<double>(p), s.x, signal(in)).number()};
  }
  template <class T>
  static State<T> reset(const Params<T>& p, const State<T>& s, const In<T>& in, Mode before, Mode after) {
    using limited_integrator::Mode;
    const auto limit = limits_of<T>(p);
    T x = s.x;
    if constexpr (resets)
      if (limited_integrator::restarts(kind(p), Mode::of(before.is), Mode::of(after.is))) x = in.start;
    using std::max;
    using std::min;
    return {max(limit.lower, min(limit.upper, x))};
  }
  static State<double> initial(const Params<double>& p) { return {p.initial}; }

 private:
  template <class T>
  static limited_integrator::Reset kind([[maybe_unused]] const Params<T>& p) {
    if constexpr (resets)
      return limited_integrator::Reset(static_cast<int>(value_of(p.kind)));
    else
      return limited_integrator::Reset::rising;
  }
  template <class T>
  static const T* signal([[maybe_unused]] const In<T>& in) {
    if constexpr (resets)
      return &in.reset;
    else
      return nullptr;
  }
};

Kernel limited_integrator_block();
Kernel integrator_with_reset_block();

}  // namespace hysteron::blocks
