// Decides Preisach's model of relays, its density even within cells of a grid: one kernel per cell. Does not identify
// the density.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <span>

namespace hysteron::preisach {

/// As many cells along the drive as one model has at most.
inline constexpr std::size_t most_cells = 32;

/// Kernels of n + 1 levels: relays that switch up in cell i and down in cell j <= i, in the order (0, 0), (1, 0), (1,
/// 1), (2, 0) ...
constexpr std::size_t kernels(std::size_t levels) { return levels < 2 ? 0 : levels * (levels - 1) / 2; }

/// Part of a cell that a rising drive u has passed, 0 .. 1. lower < upper [u]
template <class T>
T passed(const T& lower, const T& upper, const T& u) {
  using std::max;
  using std::min;
  return max(T{0}, min(T{1}, (u - lower) / (upper - lower)));
}

/// Up to which switching level [u] the relays of one kernel are up, from `lower` to `upper`, the ends of the cell in
/// which they switch up: `rising` = passed() of that cell, `falling` = of that in which they switch down. Exact while u
/// is monotone. Source: Krasnosel'skii, Pokrovskii, Systems with Hysteresis (1989); Banks, Kurdila, Webb, Math. Probl.
/// Eng. 3 (1997) 287-328 (their smoothed Preisach kernel).
template <class T>
T follow(const T& lower, const T& upper, const T& rising, const T& falling, const T& before) {
  using std::max;
  using std::min;
  const T width = upper - lower;
  return max(lower + width * rising, min(lower + width * falling, before));
}

/// Moves every kernel from its memory to the drive u. At most most_cells + 1 levels.
template <class T>
void advance(std::span<const T> levels, std::span<const T> before, const T& u, T* after) {
  assert(levels.size() <= most_cells + 1);
  std::array<T, most_cells> part;
  const std::size_t cells = levels.size() - 1;
  for (std::size_t i = 0; i < cells; ++i) part[i] = passed(levels[i], levels[i + 1], u);
  for (std::size_t i = 0, k = 0; i < cells; ++i)
    for (std::size_t j = 0; j <= i; ++j, ++k) after[k] = follow(levels[i], levels[i + 1], part[i], part[j], before[k]);
}

/// Relays without a history, where a field that swings about `rest` ever less leaves them: up are those whose middle
/// lies below it. Source: Mayergoyz, Mathematical Models of Hysteresis (1991), section 1.2.
template <class T>
void demagnetize(std::span<const T> levels, const T& rest, T* state) {
  const std::size_t cells = levels.size() - 1;
  for (std::size_t i = 0, k = 0; i < cells; ++i)
    for (std::size_t j = 0; j <= i; ++j, ++k)
      state[k] = levels[i] + levels[i + 1] + levels[j] + levels[j + 1] < T{4} * rest ? levels[i + 1] : levels[i];
  advance(levels, std::span<const T>(state, kernels(levels.size())), rest, state);
}

/// y = sum over the kernels, of each its weight times the part of its relays that are up.
template <class T>
T output(std::span<const T> levels, std::span<const T> weights, std::span<const T> state) {
  T y{0};
  for (std::size_t i = 0, k = 0; i + 1 < levels.size(); ++i)
    for (std::size_t j = 0; j <= i; ++j, ++k) y += weights[k] * ((state[k] - levels[i]) / (levels[i + 1] - levels[i]));
  return y;
}

/// Could a drive have left these kernels behind? Who switches at lower levels is up before the others. `slack`, of a
/// cell, forgives rounding.
inline bool can_stand(std::span<const double> level, std::span<const double> state, double slack) {
  const std::size_t levels = level.size();
  const auto at = [&](std::size_t i, std::size_t j) {
    return (state[kernels(i + 1) + j] - level[i]) / (level[i + 1] - level[i]);
  };
  for (std::size_t i = 0; i + 1 < levels; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      if (!(at(i, j) >= -slack && at(i, j) <= 1 + slack)) return false;
      if (i + 2 < levels && at(i + 1, j) > at(i, j) + slack) return false;
      if (j < i && at(i, j + 1) > at(i, j) + slack) return false;
    }
  return true;
}

}  // namespace hysteron::preisach
