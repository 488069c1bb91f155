// Decides the block "multisine": many sines with random phases. Does not decide the random numbers: models/random.h.
#pragma once

#include <string>

#include "engine/block/block.h"
#include "models/sources/signals.h"

namespace hysteron::blocks {

struct Multisine {
  template <class T>
  struct Params {
    T rms, offset, lowest, highest, spacing, seed;
  };
  template <class T>
  struct Out {
    T y;
  };

  static void describe(BlockSpec<Multisine>& spec);
  template <class T>
  static Out<T> output(const Params<T>& p, const Time<T>& time) {
    const double count = signals::multisine_count(value_of(p.lowest), value_of(p.highest), value_of(p.spacing));
    const auto seed = static_cast<std::uint64_t>(value_of(p.seed));
    return {p.offset + p.rms * signals::multisine(time.t, p.lowest, p.spacing, count, seed)};
  }
  static double shortest_period(const Params<double>& p) { return 1 / p.highest; }
  static std::string check(const Params<double>& p);
};

Kernel multisine_block();

}  // namespace hysteron::blocks
