// Decides the block "fmu": a co-simulation unit of the Functional Mock-up Interface as a sampled block. What it takes
// and gives stands in its file (io/fmi reads it); its state is a node of fmu_runs.h.
#pragma once

#include "engine/block/block.h"
#include "engine/block/instance.h"

namespace hysteron::blocks {

struct Fmu {
  enum Parameter { file, interface, period, offset, first_of_its_own };
  static constexpr bool uses_time = true;

  static void describe(Declaration& d);
  static Declaration instance(const Declaration& type, const Node& block);
  static Sizes sizes(const Shape& shape);
  template <class T>
  static void output(const View<T>& v) {
    if constexpr (std::is_same_v<T, double>)
      give(v);
    else
      refuse_slopes();
  }
  template <class T>
  static void update(const View<T>& v) {
    if constexpr (std::is_same_v<T, double>)
      go_on(v);
    else
      refuse_slopes();
  }

 private:
  static void give(const View<double>& v);
  static void go_on(const View<double>& v);
  [[noreturn]] static void refuse_slopes();
};

Kernel fmu_block();

}  // namespace hysteron::blocks
