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
    in_slots(v, [&](T* slots) { v.out[0] = expression::evaluate(v.c, slots); });
  }
  static void kinks(const View<double>& v) {
    in_slots(v, [&](double* slots) { expression::evaluate(v.c, slots, v.out); });
  }
  static void rows(const RowsView& r);

 private:
  /// Inputs and parameters in the slots of an evaluation.
  template <class T, class Use>
  static void in_slots(const View<T>& v, const Use& use) {
    if constexpr (std::is_same_v<T, double>) {
      double slots[expression::Code::most_slots];
      fill(v, slots);
      use(slots);
    } else {
      thread_local std::vector<T> slots(expression::Code::most_slots);
      fill(v, slots.data());
      use(slots.data());
    }
  }
  template <class T>
  static void fill(const View<T>& v, T* slots) {
    const int parameters = expression::Code::count(v.c, expression::Code::parameters);
    std::copy(v.u, v.u + v.n_u, slots);
    for (int i = 0; i < parameters; ++i) slots[v.n_u + i] = v.parameter(first_of_its_own + i);
  }
};

Kernel expression_block();

}  // namespace hysteron::blocks
