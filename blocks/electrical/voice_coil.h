// Decides the blocks "winding" and "voice_coil": a current that a voltage drives against what it induces. Does not
// decide their law: models/electrical/winding.h.
#pragma once

#include "engine/block/block.h"
#include "models/electrical/winding.h"

namespace hysteron::blocks {

struct Winding {
  template <class T>
  struct Params {
    T resistance, inductance, initial;
  };
  template <class T>
  struct In {
    T voltage, emf;
  };
  template <class T>
  struct State {
    T current;
  };
  template <class T>
  struct Out {
    T current;
  };
  static void describe(BlockSpec<Winding>& spec);
  template <class T>
  static Out<T> output(const Params<T>&, const State<T>& s) {
    return {s.current};
  }
  template <class T>
  static State<T> derivative(const Params<T>& p, const State<T>& s, const In<T>& in) {
    return {winding::current_rate(p.resistance, p.inductance, in.voltage, in.emf, s.current)};
  }
  static State<double> initial(const Params<double>& p) { return {p.initial}; }
  static State<double> rest(const Params<double>& p, const In<double>& in) {
    return {(in.voltage - in.emf) / p.resistance};
  }
};

struct VoiceCoil {
  template <class T>
  struct Params {
    T force_constant, resistance, inductance;
  };
  template <class T>
  struct In {
    T voltage, velocity;
  };
  template <class T>
  struct State {
    T current;
  };
  template <class T>
  struct Out {
    T force, current;
  };
  static void describe(BlockSpec<VoiceCoil>& spec);
  template <class T>
  static Out<T> output(const Params<T>& p, const State<T>& s) {
    return {p.force_constant * s.current, s.current};
  }
  template <class T>
  static State<T> derivative(const Params<T>& p, const State<T>& s, const In<T>& in) {
    const T emf = p.force_constant * in.velocity;
    return {winding::current_rate(p.resistance, p.inductance, in.voltage, emf, s.current)};
  }
  static State<double> rest(const Params<double>& p, const In<double>& in) {
    return {(in.voltage - p.force_constant * in.velocity) / p.resistance};
  }
};

Kernel winding_block();
Kernel voice_coil_block();

}  // namespace hysteron::blocks
