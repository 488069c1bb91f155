// Decides the block "state_machine": states one at a time, conditions that lead from one to another, values that each
// state gives. Does not decide what its texts say: models/logic/state_machine.h.
#pragma once

#include "engine/block/block.h"
#include "engine/block/instance.h"
#include "models/logic/logic.h"
#include "models/logic/state_machine.h"
#include "models/math/expression_code.h"

namespace hysteron::blocks {

struct StateMachine {
  enum Parameter { states, transitions, outputs, first_of_its_own };

  static void describe(Declaration& d);
  static Declaration instance(const Declaration& type, const Node& block);
  static Sizes sizes(const Shape& shape);
  static void units(const Shape& shape, InstanceUnits& units);

  /// The state, then the value that it gives at each further output.
  template <class T>
  static void output(const View<T>& v) {
    v.out[0] = T(static_cast<double>(v.mode));
    for (int i = 1; i < v.n_y; ++i) v.out[i] = v.list(first_of_its_own + i - 1)[static_cast<std::size_t>(v.mode)];
  }
  template <class T>
  static void derivative(const View<T>& v) {
    v.out[0] = T(1.0);  // the time in the state
  }
  template <class T>
  static void guard(const View<T>& v) {
    v.out[0] = T(followed(v) < 0 ? 1.0 : -1.0);
  }
  static int next_mode(const View<double>& v) {
    const int next = followed(v);
    return next < 0 ? v.mode : next;
  }
  template <class T>
  static void reset(const View<T>& v) {
    v.out[0] = T(0.0);
  }
  static void kinks(const View<double>& v);

 private:
  /// Of one transition in Sizes::code: the states, its length, how many symbols its condition has, then for each the
  /// input or parameter that it is, then the condition.
  enum Head { from, to, length, symbols, head_size };
  static constexpr int time_in_state = -1;

  static double symbol(const View<double>& v, int place) {
    return place == time_in_state ? v.x[0] : place < v.n_u ? v.u[place] : v.parameter(place - v.n_u);
  }
  template <class T>
  static double symbol(const View<T>& v, int place) {
    return plain(place == time_in_state ? v.x[0] : place < v.n_u ? v.u[place] : v.parameter(place - v.n_u));
  }

  /// visit(transition, code of its condition, slots with its symbols); ends where that is true.
  template <class T, class Visit>
  static bool any_of(const View<T>& v, const Visit& visit) {
    double slots[expression::Code::most_slots];
    for (const double* t = v.c; t < v.c + v.n_c; t += static_cast<int>(t[length])) {
      const int n = static_cast<int>(t[symbols]);
      for (int i = 0; i < n; ++i) slots[i] = symbol(v, static_cast<int>(t[head_size + i]));
      if (visit(t, t + head_size + n, slots)) return true;
    }
    return false;
  }

  /// The state to which the first condition that holds leads; -1 where none does.
  template <class T>
  static int followed(const View<T>& v) {
    int next = -1;
    any_of(v, [&](const double* t, const double* code, double* slots) {
      const int begin = static_cast<int>(t[from]), end = static_cast<int>(t[to]);
      if ((begin >= 0 && begin != v.mode) || end == v.mode) return false;
      if (!logic::is_true(expression::evaluate(code, slots))) return false;
      next = end;
      return true;
    });
    return next;
  }
};

Kernel state_machine_block();

}  // namespace hysteron::blocks
