// Decides the block "enabling", which the engine puts in front of a nested diagram that does not always run: its mode
// says whether that runs.
#pragma once

#include "engine/block/block.h"
#include "engine/program/program.h"
#include "models/logic/logic.h"

namespace hysteron::blocks {

/// Inputs: the signal that enables or triggers, then whether the diagram around it runs. Modes: the side of the level
/// on which the signal is (logic::Side), plus enabled_mode while the diagram runs.
struct EnablingLevel {
  enum Parameter { runs };
  enum Kind { enabled, rising, falling, either };  ///< in the order of the text's choices

  static void describe(Declaration& d);
  static Sizes sizes(const Shape& shape);

  static logic::Side side(int mode) { return logic::Side(mode % enabled_mode); }
  /// What is triggered runs for one instant.
  template <class T>
  static bool has_run(const View<T>& v) {
    return v.choice(runs) != enabled && runs_in_mode(v.mode);
  }
  /// Of a signal that enables: true while the diagram around runs as well.
  template <class T>
  static T signal(const View<T>& v) {
    using std::min;
    T least = v.u[0];
    for (int i = 1; i < v.n_u && v.choice(runs) == enabled; ++i) least = min(least, v.u[i]);
    return least;
  }
  static bool may_run(const View<double>& v) {
    for (int i = 1; i < v.n_u; ++i)
      if (!logic::is_true(v.u[i])) return false;
    return true;
  }

  template <class T>
  static void output(const View<T>& v) {
    v.out[0] = logic::truth<T>(runs_in_mode(v.mode));
  }
  template <class T>
  static void guard(const View<T>& v) {
    v.out[0] = has_run(v) ? T(-1.0) : logic::distance(side(v.mode), signal(v));
  }
  static int next_mode(const View<double>& v) {
    const auto before = side(v.mode);
    if (has_run(v)) return before;
    const auto after = logic::side_of(before, signal(v));
    if (v.choice(runs) == enabled) return after + (after == logic::high ? enabled_mode : 0);
    return after +
           (logic::is_edge(logic::Edge(v.choice(runs) - rising), before, after) && may_run(v) ? enabled_mode : 0);
  }
};

Kernel enabling_block();

}  // namespace hysteron::blocks
