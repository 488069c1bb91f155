// Decides the block "tank": a level with an outlet and a brim. Does not decide its law: models/continuous/tank.h.
#pragma once

#include <limits>
#include <string>

#include "engine/block/block.h"
#include "models/continuous/tank.h"

namespace hysteron::blocks {

struct Tank {
  template <class T>
  struct Params {
    T area, outlet, reference, law, exponent, brim, initial;
  };
  template <class T>
  struct In {
    T inflow;
  };
  template <class T>
  struct State {
    T level, spilled;
  };
  template <class T>
  struct Out {
    T level, outflow, spilled;
  };
  static void describe(BlockSpec<Tank>& spec);
  template <class T>
  static tank::Outlet outlet_of(const Params<T>& p) {
    return tank::Outlet(static_cast<int>(value_of(p.law)));
  }
  template <class T>
  static tank::Params<T> numbers(const Params<T>& p) {
    return {p.area, p.outlet, p.reference, p.brim > T{0} ? p.brim : T{std::numeric_limits<double>::infinity()},
            p.exponent};
  }
  template <class T>
  static Out<T> output(const Params<T>& p, const State<T>& s) {
    return {s.level, tank::outflow(outlet_of(p), numbers(p), s.level), s.spilled};
  }
  template <class T>
  static State<T> derivative(const Params<T>& p, const State<T>& s, const In<T>& in, Mode mode) {
    const auto m = tank::Mode(mode.is);
    return {tank::rate(outlet_of(p), numbers(p), m, s.level, in.inflow),
            tank::overflow(outlet_of(p), numbers(p), m, in.inflow)};
  }
  template <class T>
  static T guard(const Params<T>& p, const State<T>& s, const In<T>& in, Mode mode) {
    return tank::guard(outlet_of(p), numbers(p), tank::Mode(mode.is), s.level, in.inflow);
  }
  static Mode next(const Params<double>& p, const State<double>& s, const In<double>& in, Mode mode) {
    if (guard(p, s, in, mode) > 0) return mode;
    return {tank::next(tank::Mode(mode.is), s.level)};
  }
  template <class T>
  static State<T> reset(const Params<T>& p, const State<T>& s, const In<T>&, Mode, Mode) {
    return {tank::held_level(numbers(p), s.level), s.spilled};
  }
  /// Row by row, as measurements are compared: without events.
  struct OwnStep {
    tank::Outlet outlet;
    tank::Params<double> law;
    explicit OwnStep(const Params<double>& p) : outlet(outlet_of(p)), law(numbers(p)) {}
    bool takes(double) const { return true; }
    State<double> operator()(const State<double>& s, const In<double>& from, const In<double>& to, double h) const {
      const auto f = tank::after(outlet, law, {s.level, s.spilled}, from.inflow, to.inflow, h);
      return {f.level, f.spilled};
    }
  };
  static State<double> rest(const Params<double>& p, const In<double>& in) {
    return {tank::rest(outlet_of(p), numbers(p), in.inflow), 0};
  }
  static State<double> initial(const Params<double>& p) { return {p.initial, 0}; }
  static std::string check(const Params<double>& p);
};

Kernel tank_block();

}  // namespace hysteron::blocks
