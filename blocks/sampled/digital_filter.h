// Decides the block "digital_filter": a filter by kind and corner. Does not decide its coefficients:
// models/sampled/filter_design.h.
#pragma once

#include <string>

#include "engine/block/block.h"
#include "models/sampled/filter_design.h"

namespace hysteron::blocks {

struct DigitalFilter {
  enum Parameter { family, pass, order, corner, upper, ripple, before, period };
  // Constants: b0, b1, b2, a1, a2 of each section; states: two of each.

  static void describe(Declaration& d);
  static Sizes sizes(const Shape& shape);
  static std::string check(const View<double>& v);
  static void prepare(const View<double>& v);
  static void initial_states(const View<double>& v);
  template <class T>
  static void output(const View<T>& v) {
    v.out[0] = through(v, [](int, const sections::Section&, const T&, const T&) {});
  }
  template <class T>
  static void update(const View<T>& v) {
    through(v, [&](int k, const sections::Section& s, const T& u, const T& y) {
      sections::update(s, v.x + 2 * k, u, y, v.out + 2 * k);
    });
  }

 private:
  static sections::Section section(const double* c, int k) {
    return {c[5 * k], c[5 * k + 1], c[5 * k + 2], c[5 * k + 3], c[5 * k + 4]};
  }
  /// The input behind all sections; each is told what it got and gave.
  template <class T, class Each>
  static T through(const View<T>& v, const Each& each) {
    T u = v.u[0];
    for (int k = 0; 2 * k < v.n_x; ++k) {
      const auto s = section(v.c, k);
      const T y = sections::output(s, v.x + 2 * k, u);
      each(k, s, u, y);
      u = y;
    }
    return u;
  }
};

Kernel digital_filter_block();

}  // namespace hysteron::blocks
