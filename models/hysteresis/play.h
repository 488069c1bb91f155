// Decides the law of one play operator, two-sided and one-sided, and its memory after one monotone move of the input.
// Does not sum operators (prandtl_ishlinskii.h) nor decide when a move counts: the caller commits the memory.
#pragma once

#include <algorithm>

namespace hysteron::play {

/// Two-sided play: w after the input has moved to u, w_before at the start of the move.
///
///   w = max(u - r, min(u + r, w_before))
///
/// r [u] half the width, u and w in the input's unit. Exact while u is monotone. follow(r, follow(r, w, u), u) =
/// follow(r, w, u). Source: thesis Eq. 2.3; Brokate, Sprekels, Hysteresis and Phase Transitions (1996), chapter 2.
template <class T>
T follow(const T& radius, const T& before, const T& u) {
  using std::max;
  using std::min;
  return max(u - radius, min(u + radius, before));
}

/// One-sided play (OSP): follows a falling input at once, a rising one behind the threshold r.
///
///   w = max(u - r, min(u, w_before))
///
/// The same as a two-sided play of radius r/2 driven by u - r/2; with u >= 0 from rest it leaves no remanence.
/// Source: thesis Eq. 2.4.
template <class T>
T follow_one_sided(const T& threshold, const T& before, const T& u) {
  using std::max;
  using std::min;
  return max(u - threshold, min(u, before));
}

/// Backlash: the driven side behind a joint of total gap `gap`, the two-sided play of half of it. The driven side keeps
/// its place while the joint is loose (friction holds it). Source: Nordin, Gutman, Automatica 38 (2002) 1633-1649.
template <class T>
T backlash(const T& gap, const T& before, const T& u) {
  return follow(T{gap / T{2}}, before, u);
}

enum class Sides { two, one };

template <class T>
T follow(Sides sides, const T& width, const T& before, const T& u) {
  return sides == Sides::two ? follow(width, before, u) : follow_one_sided(width, before, u);
}

}  // namespace hysteron::play
