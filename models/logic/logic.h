// Decides what is true and how truths are joined: 1 is true, 0 false, whatever lies above 1/2 counts as true.
#pragma once

#include "models/number.h"

namespace hysteron::logic {

inline constexpr double level = 0.5;

/// Of what switches: true from 1/2 on, false again a little below, so that nothing chatters where a signal rests on the
/// level itself.
inline constexpr double level_down = level - 1e-6;

template <class T>
bool is_true(const T& u) {
  return plain(u) > level;
}
template <class T>
T truth(bool is) {
  return T(is ? 1.0 : 0.0);
}

enum class Relation { less, at_most, equal, not_equal, at_least, greater };

template <class T>
bool holds(Relation relation, const T& a, const T& b) {
  const double x = plain(a), y = plain(b);
  switch (relation) {
    case Relation::less:
      return x < y;
    case Relation::at_most:
      return x <= y;
    case Relation::equal:
      return x == y;
    case Relation::not_equal:
      return x != y;
    case Relation::at_least:
      return x >= y;
    default:
      return x > y;
  }
}

enum class Gate { all, any, not_all, none, odd, opposite };

/// `how_many` of `all` inputs are true. opposite: of a single input.
inline bool joined(Gate gate, int how_many, int all) {
  switch (gate) {
    case Gate::all:
      return how_many == all;
    case Gate::any:
      return how_many > 0;
    case Gate::not_all:
      return how_many < all;
    case Gate::odd:
      return how_many % 2 == 1;
    default:
      return how_many == 0;
  }
}

/// The side of the level on which a switching signal is. `start` is left at once, for the side that the signal has.
enum Side { start, low, high };

/// Positive while the side may stay.
template <class T>
T distance(Side side, const T& u) {
  if (side == start) return T(-1.0);
  return side == low ? T(level) - u : u - T(level_down);
}
/// The side that the signal has, where `before` may not stay.
template <class T>
Side side_of(Side before, const T& u) {
  return plain(u) >= level || (before == high && plain(u) > level_down) ? high : low;
}

enum class Edge { rising, falling, either };

inline bool is_edge(Edge edge, Side before, Side after) {
  if (before == start || before == after) return false;
  return edge == Edge::either || (edge == Edge::rising) == (after == high);
}

}  // namespace hysteron::logic
