// Small blocks for tests of events: what the engine does with them follows from a line of arithmetic.
#pragma once

#include "blocks/register_all.h"
#include "engine/block/block.h"

namespace hysteron::test {

/// Samples and holds its input.
struct Sampler {
  static constexpr bool is_sampled = true;
  template <class T>
  struct Params {
    T period, offset;
  };
  template <class T>
  struct In {
    T u;
  };
  template <class T>
  struct Out {
    T y;
  };
  static void describe(BlockSpec<Sampler>& spec) {
    spec.name("test_sampler", "holds samples");
    spec.input(&In<double>::u, "u", "$a", "");
    spec.output(&Out<double>::y, "y", "$a", "");
    spec.sampled(&Params<double>::period, &Params<double>::offset);
  }
  template <class T>
  static Out<T> output(const Params<T>&, const In<T>& in) {
    return {in.u};
  }
};

/// s <- s + gain u, puts out s: what it has seen until the instant before.
struct Accumulator {
  template <class T>
  struct Params {
    T gain, period, offset;
  };
  template <class T>
  struct In {
    T u;
  };
  template <class T>
  struct State {
    T s;
  };
  template <class T>
  struct Out {
    T y;
  };
  static void describe(BlockSpec<Accumulator>& spec) {
    spec.name("test_accumulator", "adds up samples");
    spec.input(&In<double>::u, "u", "$a", "");
    spec.output(&Out<double>::y, "y", "$a", "");
    spec.state(&State<double>::s, "s", "$a", "");
    spec.param(&Params<double>::gain, "gain", "", "").optional("1");
    spec.sampled(&Params<double>::period, &Params<double>::offset);
  }
  template <class T>
  static Out<T> output(const Params<T>&, const State<T>& s) {
    return {s.s};
  }
  template <class T>
  static State<T> update(const Params<T>& p, const State<T>& s, const In<T>& in) {
    return {s.s + p.gain * in.u};
  }
};

/// Counts its instants.
struct Counter {
  static void describe(Declaration& d) {
    d.name("test_counter", "number of the instant");
    d.output("y", "", "");
    d.sampled();
  }
  static Sizes sizes(const Shape&) { return {.feedthrough = false}; }
  template <class T>
  static void output(const View<T>& v) {
    v.out[0] = T(static_cast<double>(v.hit));
  }
};

/// +level above `on`, -level below `off`, between them what it was.
struct Relay {
  static constexpr Smoothness smoothness = Smoothness::jumps;
  template <class T>
  struct Params {
    T on, off, level;
  };
  template <class T>
  struct In {
    T u;
  };
  template <class T>
  struct Out {
    T y;
  };
  static void describe(BlockSpec<Relay>& spec) {
    spec.name("test_relay", "two values");
    spec.input(&In<double>::u, "u", "$a", "");
    spec.output(&Out<double>::y, "y", "$b", "");
    spec.param(&Params<double>::on, "on", "$a", "");
    spec.param(&Params<double>::off, "off", "$a", "");
    spec.param(&Params<double>::level, "level", "$b", "");
  }
  template <class T>
  static Out<T> output(const Params<T>& p, const In<T>&, Mode m) {
    return {m.is == 0 ? -p.level : p.level};
  }
  template <class T>
  static T guard(const Params<T>& p, const In<T>& in, Mode m) {
    return m.is == 0 ? p.on - in.u : in.u - p.off;
  }
  static Mode next(const Params<double>&, const In<double>&, Mode m) { return {1 - m.is}; }
};

/// A ball above the floor that bounces: h'' = -g, v -> -restitution v at h = 0. Modes 0 and 1 are alike: each bounce
/// changes them.
struct Ball {
  template <class T>
  struct Params {
    T gravity, restitution, height;
  };
  template <class T>
  struct In {
    T push;
  };
  template <class T>
  struct State {
    T h, v;
  };
  template <class T>
  struct Out {
    T height;
  };
  static void describe(BlockSpec<Ball>& spec) {
    spec.name("test_ball", "bounces");
    spec.input(&In<double>::push, "push", "m/s^2", "");
    spec.output(&Out<double>::height, "height", "m", "");
    spec.state(&State<double>::h, "h", "m", "").nominal(1);
    spec.state(&State<double>::v, "v", "m/s", "").nominal(1);
    spec.param(&Params<double>::gravity, "gravity", "m/s^2", "");
    spec.param(&Params<double>::restitution, "restitution", "", "");
    spec.param(&Params<double>::height, "height", "m", "");
  }
  template <class T>
  static Out<T> output(const Params<T>&, const State<T>& s, Mode) {
    return {s.h};
  }
  template <class T>
  static State<T> derivative(const Params<T>& p, const State<T>& s, const In<T>& in, Mode) {
    return {s.v, in.push - p.gravity};
  }
  template <class T>
  static T guard(const Params<T>&, const State<T>& s, const In<T>&, Mode) {
    return s.h > T(0.0) || s.v > T(0.0) ? T(1e-12) + s.h : s.h;
  }
  static Mode next(const Params<double>&, const State<double>&, const In<double>&, Mode m) { return {1 - m.is}; }
  template <class T>
  static State<T> reset(const Params<T>& p, const State<T>& s, const In<T>&, Mode, Mode) {
    return {T(0.0), -p.restitution * s.v};
  }
  static State<double> initial(const Params<double>& p) { return {p.height, 0}; }
};

/// Driven by the rate of its input, and not homogeneous in it: x' = u'^2.
struct RateSquared {
  template <class T>
  struct In {
    T u;
  };
  template <class T>
  struct State {
    T x;
  };
  template <class T>
  struct Out {
    T y;
  };
  static void describe(BlockSpec<RateSquared>& spec) {
    spec.name("test_rate_squared", "follows no jump");
    spec.input(&In<double>::u, "u", "$a", "");
    spec.output(&Out<double>::y, "y", "$a^2/s", "");
    spec.state(&State<double>::x, "x", "$a^2/s", "");
  }
  template <class T>
  static Out<T> output(const Nothing&, const State<T>& s) {
    return {s.x};
  }
  template <class T>
  static State<T> derivative(const Nothing&, const State<T>&, const In<T>&, const In<T>& rate) {
    return {rate.u * rate.u};
  }
};

/// All blocks that diagrams can name, and these.
inline const Registry& registry_with_events() {
  static const Registry all = [] {
    Registry r = all_blocks();
    r.add(kernel<Sampler>());
    r.add(kernel<Accumulator>());
    r.add(kernel<Counter>());
    r.add(kernel<Relay>());
    r.add(kernel<Ball>());
    r.add(kernel<RateSquared>());
    return r;
  }();
  return all;
}

}  // namespace hysteron::test
