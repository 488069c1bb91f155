// Decides the block "logarithmic_creep": creep by the logarithm of time, told by two numbers. Does not decide its law:
// models/continuous/creep.h.
#pragma once

#include "blocks/continuous/relaxations.h"

namespace hysteron::blocks {

struct LogarithmicCreep : Relaxations<LogarithmicCreep> {
  enum Parameter { per_decade, first_time, times };

  static void describe(Declaration& d);
  static Sizes sizes(const Shape& shape);
  static std::string check(const View<double>& v);
  template <class T>
  static void output(const View<T>& v) {
    const auto tau = v.list(times);
    v.out[0] = v.u[0];
    for (std::size_t k = 0; k < tau.size(); ++k)
      v.out[0] += creep::logarithmic_amount(v.parameter(per_decade), v.parameter(first_time), tau, k) * v.x[k];
  }
};

Kernel logarithmic_creep_block();

}  // namespace hysteron::blocks
