// Decides the block "input_shaper". Does not decide its law: models/continuous/input_shaper.h; the engine keeps the
// past of its input.
#pragma once

#include <limits>
#include <string>

#include "blocks/continuous/history.h"
#include "engine/block/block.h"
#include "models/continuous/input_shaper.h"

namespace hysteron::blocks {

struct InputShaper {
  static constexpr bool uses_time = true;
  enum Parameter { frequency, damping };

  static void describe(Declaration& d);
  static Sizes sizes(const Shape&);
  static std::string check(const View<double>& v);
  template <class T>
  static void output(const View<T>& v) {
    const auto shape = input_shaper::zv(v.parameter(frequency), v.parameter(damping));
    const T late = v.history == nullptr
                       ? T{std::numeric_limits<double>::quiet_NaN()}
                       : history_value(*v.history, T{v.t - shape.delay}, v.branch - value_of(shape.delay));
    v.out[0] = late + shape.first * (v.u[0] - late);
  }
  static double reach_back(const View<double>& v) {
    return input_shaper::zv(v.parameter(frequency), v.parameter(damping)).delay;
  }
};

Kernel input_shaper_block();

}  // namespace hysteron::blocks
