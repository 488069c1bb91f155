// Decides a repetitive controller: what was wrong a cycle ago is put right in advance. Does not decide when samples
// come.
#pragma once

#include <cstddef>
#include <span>

namespace hysteron::repetitive {

/// The line holds w_(k-n-1) ... w_(k-1), the oldest first, n + 1 of them for a cycle of n samples; w_k = e_k + keep
/// S(w)_(k-n), S smoothing over three samples without delay: S(w)_i = w_i + smoothing/4 (w_(i-1) - 2 w_i + w_(i+1)).
/// Source: Longman, Int. J. Control 73 (2000) 930-954.
template <class T>
T smoothed(std::span<const T> line, const T& smoothing, std::size_t behind_oldest) {
  const T &before = line[behind_oldest - 1], &here = line[behind_oldest], &after = line[behind_oldest + 1];
  return here + 0.25 * smoothing * (before - 2.0 * here + after);
}

/// Command: gain keep S(w)_(k-n+lead): `lead` samples early, for as many as the plant takes to answer.
template <class T>
T output(std::span<const T> line, const T& gain, const T& keep, const T& smoothing, int lead) {
  return gain * keep * smoothed(line, smoothing, 1 + static_cast<std::size_t>(lead));
}

/// Line behind the instant with the error e_k.
template <class T>
void update(std::span<const T> line, const T& keep, const T& smoothing, const T& error, T* after) {
  const T newest = error + keep * smoothed(line, smoothing, 1);
  for (std::size_t i = 0; i + 1 < line.size(); ++i) after[i] = line[i + 1];
  after[line.size() - 1] = newest;
}

}  // namespace hysteron::repetitive
