// Decides the block "relay": two outputs, switched with hysteresis. Does not decide its law: models/hysteresis/relay.h.
#pragma once

#include <string>

#include "engine/block/block.h"
#include "models/hysteresis/relay.h"

namespace hysteron::blocks {

struct Relay {
  static constexpr Smoothness smoothness = Smoothness::jumps;
  template <class T>
  struct Params {
    T on_at, off_at, on_value, off_value, initial;
  };
  template <class T>
  struct In {
    T u;
  };
  template <class T>
  struct Out {
    T y;
  };
  static void describe(BlockSpec<Relay>& spec);
  template <class T>
  static relay::Params<T> law(const Params<T>& p) {
    return {p.on_at, p.off_at, p.on_value, p.off_value};
  }
  template <class T>
  static Out<T> output(const Params<T>& p, const In<T>&, Mode mode) {
    return {relay::output(law(p), relay::Mode(mode.is))};
  }
  template <class T>
  static T guard(const Params<T>& p, const In<T>& in, Mode mode) {
    return relay::guard(law(p), relay::Mode(mode.is), in.u);
  }
  static Mode next(const Params<double>& p, const In<double>& in, Mode mode) {
    return guard(p, in, mode) > 0 ? mode : Mode{relay::next(relay::Mode(mode.is))};
  }
  static Mode initial_mode(const Params<double>& p) { return {p.initial == 0 ? relay::off : relay::on}; }
  static std::string check(const Params<double>& p);
};

Kernel relay_block();

}  // namespace hysteron::blocks
