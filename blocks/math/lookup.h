// Decides the block "lookup": a table over one axis or several. Does not decide what lies between knots:
// models/math/lookup.h.
#pragma once

#include <array>
#include <string>

#include "engine/block/block.h"
#include "engine/block/instance.h"
#include "models/math/lookup.h"

namespace hysteron::blocks {

struct Lookup {
  enum Parameter { values, at, at_2, at_3, at_4, between, outside };

  static void describe(Declaration& d);
  static Declaration instance(const Declaration& type, const Node& block);
  static Sizes sizes(const Shape& shape);
  static std::string check(const View<double>& v);
  template <class T>
  static void output(const View<T>& v) {
    std::array<lookup::Axis<T>, lookup::most_axes> all;
    const auto axes = axes_of(v, all);
    v.out[0] =
        lookup::value(lookup::Between(v.choice(between)), lookup::Outside(v.choice(outside)), axes, v.list(values));
  }
  static void kinks(const View<double>& v);
  static void rows(const RowsView& r);

 private:
  template <class T>
  static std::span<lookup::Axis<T>> knots_of(const View<T>& v, std::array<lookup::Axis<T>, lookup::most_axes>& all) {
    for (int i = 0; i < v.n_u; ++i) all[static_cast<std::size_t>(i)].knots = v.list(at + i);
    return {all.data(), static_cast<std::size_t>(v.n_u)};
  }
  template <class T>
  static std::span<lookup::Axis<T>> axes_of(const View<T>& v, std::array<lookup::Axis<T>, lookup::most_axes>& all) {
    const auto axes = knots_of(v, all);
    for (std::size_t i = 0; i < axes.size(); ++i) axes[i].u = v.u[i];
    return axes;
  }
};

Kernel lookup_block();

}  // namespace hysteron::blocks
