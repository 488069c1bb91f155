// Decides the block "expression": a law that the diagram itself writes. Does not decide what the text means
// (models/math/expression_tree.h), nor which units it has (expression_units.h).
#pragma once

#include <string>

#include "engine/block/block.h"
#include "engine/block/instance.h"
#include "models/math/expression_code.h"

namespace hysteron::blocks {

struct Expression {
  enum Parameter { y, unit, first_of_its_own };

  static void describe(Declaration& d);
  static Declaration instance(const Declaration& type, const Node& block);
  static Sizes sizes(const Shape& shape);
  static void units(const Shape& shape, InstanceUnits& units);
  template <class T>
  static void output(const View<T>& v) {
    v.out[0] = evaluated(v, nullptr);
  }
  static void kinks(const View<double>& v) { evaluated(v, v.out); }
  static void rows(const RowsView& r);

 private:
  template <class T>
  static T evaluated(const View<T>& v, double* kinks) {
    if constexpr (std::is_same_v<T, double>) {
      double slots[expression::Code::most_slots];
      return evaluated_in(v, slots, kinks);
    } else {
      thread_local std::vector<T> slots(expression::Code::most_slots);
      return evaluated_in(v, slots.data(), kinks);
    }
  }
  template <class T>
  static T evaluated_in(const View<T>& v, T* slots, double* kinks) {
    const int parameters = expression::Code::count(v.c, expression::Code::parameters);
    std::copy(v.u, v.u + v.n_u, slots);
    for (int i = 0; i < parameters; ++i) slots[v.n_u + i] = v.parameter(first_of_its_own + i);
    return expression::evaluate(v.c, slots, kinks);
  }
};

Kernel expression_block();

}  // namespace hysteron::blocks
