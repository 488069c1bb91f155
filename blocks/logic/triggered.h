// Decides the blocks that something true sets going: "sample_and_hold", "counter", "timer". Edges are located; between
// them the states of these blocks are quiet, or run with the time.
#pragma once

#include "engine/block/block.h"
#include "models/logic/logic.h"

namespace hysteron::blocks {

struct SampleAndHold {
  static constexpr Smoothness smoothness = Smoothness::jumps;
  template <class T>
  struct Params {
    T initial, edge;
  };
  template <class T>
  struct In {
    T u, trigger;
  };
  template <class T>
  struct Out {
    T y;
  };
  template <class T>
  struct State {
    T held;
  };
  static void describe(BlockSpec<SampleAndHold>& spec);
  template <class T>
  static Out<T> output(const Params<T>&, const State<T>& s) {
    return {s.held};
  }
  template <class T>
  static State<T> derivative(const Params<T>&, const State<T>&, const In<T>&) {
    return {T(0.0)};
  }
  template <class T>
  static T guard(const Params<T>&, const In<T>& in, Mode mode) {
    return logic::distance(logic::Side(mode.is), in.trigger);
  }
  static Mode next(const Params<double>&, const In<double>& in, Mode mode) {
    return {logic::side_of(logic::Side(mode.is), in.trigger)};
  }
  template <class T>
  static State<T> reset(const Params<T>& p, const State<T>& s, const In<T>& in, Mode before, Mode after) {
    const auto edge = logic::Edge(static_cast<int>(plain(p.edge)));
    return {logic::is_edge(edge, logic::Side(before.is), logic::Side(after.is)) ? in.u : s.held};
  }
  static State<double> initial(const Params<double>& p) { return {p.initial}; }
};

struct Counter {
  static constexpr Smoothness smoothness = Smoothness::jumps;
  template <class T>
  struct Params {
    T initial, by, edge;
  };
  template <class T>
  struct In {
    T u, reset;
  };
  template <class T>
  struct Out {
    T y;
  };
  template <class T>
  struct State {
    T count;
  };
  static void describe(BlockSpec<Counter>& spec);
  /// The sides of both inputs in one mode.
  static logic::Side counted(Mode mode) { return logic::Side(mode.is % 3); }
  static logic::Side cleared(Mode mode) { return logic::Side(mode.is / 3); }

  template <class T>
  static Out<T> output(const Params<T>&, const State<T>& s) {
    return {s.count};
  }
  template <class T>
  static State<T> derivative(const Params<T>&, const State<T>&, const In<T>&) {
    return {T(0.0)};
  }
  template <class T>
  static T guard(const Params<T>&, const In<T>& in, Mode mode) {
    using std::min;
    return min(logic::distance(counted(mode), in.u), logic::distance(cleared(mode), in.reset));
  }
  static Mode next(const Params<double>&, const In<double>& in, Mode mode) {
    return {logic::side_of(counted(mode), in.u) + 3 * logic::side_of(cleared(mode), in.reset)};
  }
  template <class T>
  static State<T> reset(const Params<T>& p, const State<T>& s, const In<T>&, Mode before, Mode after) {
    if (cleared(after) == logic::high) return {p.initial};
    const auto edge = logic::Edge(static_cast<int>(plain(p.edge)));
    return {logic::is_edge(edge, counted(before), counted(after)) ? s.count + p.by : s.count};
  }
  static State<double> initial(const Params<double>& p) { return {p.initial}; }
};

struct Timer {
  static constexpr Smoothness smoothness = Smoothness::jumps;
  template <class T>
  struct In {
    T u;
  };
  template <class T>
  struct Out {
    T y;
  };
  template <class T>
  struct State {
    T elapsed;
  };
  static void describe(BlockSpec<Timer>& spec);
  template <class T>
  static Out<T> output(const Nothing&, const State<T>& s) {
    return {s.elapsed};
  }
  template <class T>
  static State<T> derivative(const Nothing&, const State<T>&, const In<T>&, Mode mode) {
    return {T(mode.is == logic::high ? 1.0 : 0.0)};
  }
  template <class T>
  static T guard(const Nothing&, const In<T>& in, Mode mode) {
    return logic::distance(logic::Side(mode.is), in.u);
  }
  static Mode next(const Nothing&, const In<double>& in, Mode mode) {
    return {logic::side_of(logic::Side(mode.is), in.u)};
  }
  template <class T>
  static State<T> reset(const Nothing&, const State<T>&, const In<T>&, Mode, Mode) {
    return {T(0.0)};
  }
};

Kernel sample_and_hold_block();
Kernel counter_block();
Kernel timer_block();

}  // namespace hysteron::blocks
