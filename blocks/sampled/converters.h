// Decides the blocks "sample_hold", "quantizer" and "sampled_noise": what a converter does to a signal at its instants.
// Does not decide their laws: models/sampled/quantizer.h, models/random.h.
#pragma once

#include <string>

#include "engine/block/block.h"
#include "models/random.h"
#include "models/sampled/quantizer.h"

namespace hysteron::blocks {

struct SampleHold {
  static constexpr bool is_sampled = true;
  template <class T>
  struct Params {
    T period, offset;
  };
  template <class T>
  struct In {
    T u;
  };
  template <class T>
  struct Out {
    T y;
  };
  static void describe(BlockSpec<SampleHold>& spec);
  template <class T>
  static Out<T> output(const Params<T>&, const In<T>& in) {
    return {in.u};
  }
};

struct Quantizer {
  static constexpr bool is_sampled = true;
  template <class T>
  struct Params {
    T bits, lower, upper, period, offset;
  };
  template <class T>
  struct In {
    T u;
  };
  template <class T>
  struct Out {
    T y;
  };
  static void describe(BlockSpec<Quantizer>& spec);
  template <class T>
  static Out<T> output(const Params<T>& p, const In<T>& in) {
    return {quantizer::quantize(p.bits, p.lower, p.upper, in.u)};
  }
  static std::string check(const Params<double>& p);
};

struct SampledNoise {
  enum Parameter { rms, seed };

  static void describe(Declaration& d);
  static Sizes sizes(const Shape&);
  template <class T>
  static void output(const View<T>& v) {
    const auto s = static_cast<std::uint64_t>(value_of(v.parameter(seed)));
    v.out[0] = v.u[0] + v.parameter(rms) * T{random::normal(s, v.key + 2, static_cast<std::uint64_t>(v.hit))};
  }
  static std::string check(const View<double>& v);
};

Kernel sample_hold_block();
Kernel quantizer_block();
Kernel sampled_noise_block();

}  // namespace hysteron::blocks
