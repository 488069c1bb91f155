// Decides the block "maxwell_capacitor": elasto-plastic elements in charge. Does not decide their law:
// models/hysteresis/maxwell_capacitor.h.
#pragma once

#include <string>

#include "engine/block/block.h"
#include "models/hysteresis/maxwell_capacitor.h"
#include "models/hysteresis/prandtl_ishlinskii.h"

namespace hysteron::blocks {

struct MaxwellCapacitor {
  enum Parameter { yield_charges, elastances };

  static void describe(Declaration& d);
  static Sizes sizes(const Shape& shape);
  template <class T>
  static void advance(const View<T>& v) {
    prandtl_ishlinskii::advance(play::Sides::two, v.list(yield_charges), v.memory(), v.u[0], v.out);
  }
  template <class T>
  static void output(const View<T>& v) {
    v.out[0] = maxwell_capacitor::voltage(v.list(elastances), v.memory(), v.u[0]);
  }
  static std::string check_memory(const View<double>& v);
};

Kernel maxwell_capacitor_block();

}  // namespace hysteron::blocks
