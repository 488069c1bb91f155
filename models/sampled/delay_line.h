// Decides a delay by a whole number of samples: a line of past values. Does not decide when samples come.
#pragma once

#include <cstddef>
#include <span>

namespace hysteron::delay_line {

/// The line of a delay of n samples holds u_(k-n) ... u_(k-1), the oldest first. n = 0: no delay.
template <class T>
T output(std::span<const T> line, const T& u) {
  return line.empty() ? u : line[0];
}

/// The line behind the instant at which u_k came. `after` may be the line itself.
template <class T>
void push(std::span<const T> line, const T& u, T* after) {
  for (std::size_t i = 0; i + 1 < line.size(); ++i) after[i] = line[i + 1];
  if (!line.empty()) after[line.size() - 1] = u;
}

}  // namespace hysteron::delay_line
