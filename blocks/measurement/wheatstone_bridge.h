// Decides the blocks "wheatstone_bridge" and "wheatstone_bridge_inverse". Does not decide their law:
// models/measurement/wheatstone_bridge.h.
#pragma once

#include "engine/block/block.h"
#include "models/measurement/wheatstone_bridge.h"

namespace hysteron::blocks {

struct WheatstoneBridge {
  template <class T>
  struct Params {
    T supply, resistance, gauge_factor;
  };
  template <class T>
  struct In {
    T strain;
  };
  template <class T>
  struct Out {
    T u, gauge;
  };
  static void describe(BlockSpec<WheatstoneBridge>& spec);
  template <class T>
  static Out<T> output(const Params<T>& p, const In<T>& in) {
    const T gauge = wheatstone_bridge::gauge_resistance(p.resistance, p.gauge_factor, in.strain);
    return {wheatstone_bridge::voltage(p.supply, p.resistance, gauge), gauge};
  }
};

struct WheatstoneBridgeInverse {
  template <class T>
  struct Params {
    T supply, resistance, gauge_factor;
  };
  template <class T>
  struct In {
    T u;
  };
  template <class T>
  struct Out {
    T strain, gauge;
  };
  static void describe(BlockSpec<WheatstoneBridgeInverse>& spec);
  template <class T>
  static Out<T> output(const Params<T>& p, const In<T>& in) {
    const T gauge = wheatstone_bridge::gauge_from_voltage(p.supply, p.resistance, in.u);
    return {wheatstone_bridge::strain_from_gauge(p.resistance, p.gauge_factor, gauge), gauge};
  }
};

Kernel wheatstone_bridge_block();
Kernel wheatstone_bridge_inverse_block();

}  // namespace hysteron::blocks
