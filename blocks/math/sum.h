// Decides the block "sum": any number of signals with their signs. Does not scale them.
#pragma once

#include <string>

#include "engine/block/block.h"

namespace hysteron::blocks {

struct Sum {
  enum Parameter { signs };

  static void describe(Declaration& d);
  static Sizes sizes(const Shape& shape);
  template <class T>
  static void output(const View<T>& v) {
    const auto sign = v.list(signs);  // one character code per wire, or none at all: all plus
    T y{0};
    for (std::size_t i = 0; i < v.inputs().size(); ++i) {
      if (!sign.empty() && value_of(sign[i]) == '-')
        y -= v.u[i];
      else
        y += v.u[i];
    }
    v.out[0] = y;
  }
  static std::string check(const View<double>& v);
};

Kernel sum_block();

}  // namespace hysteron::blocks
