#include "engine/diagram/series.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hysteron {

std::string to_text(Between between) {
  return between == Between::hold ? "hold" : between == Between::smooth ? "smooth" : "linear";
}

Between between_of(const std::string& text) {
  return text == "hold" ? Between::hold : text == "smooth" ? Between::smooth : Between::linear;
}

long Series::piece(double time) const {
  const auto n = static_cast<long>(t.size());
  if (n == 0 || time < t.front()) return -1;
  if (time >= t.back()) return n - 1;
  // Most recordings are uniform: guess, then walk; a binary search where the guess is far off.
  auto k = static_cast<long>((time - t.front()) / (t.back() - t.front()) * static_cast<double>(n - 1));
  k = std::clamp(k, 0L, n - 2);
  for (int step = 0; step < 4; ++step) {
    if (time < t[static_cast<std::size_t>(k)]) {
      --k;
    } else if (time >= t[static_cast<std::size_t>(k) + 1]) {
      ++k;
    } else {
      return k;
    }
  }
  return static_cast<long>(std::upper_bound(t.begin(), t.end(), time) - t.begin()) - 1;
}

double Series::value(double time, double branch) const {
  const long k = piece(branch);
  if (k < 0) return v.empty() ? 0.0 : v.front();
  const auto i = static_cast<std::size_t>(k);
  if (between == Between::hold || i + 1 >= t.size()) return v[i];
  return v[i] + (v[i + 1] - v[i]) * ((time - t[i]) / (t[i + 1] - t[i]));
}

double Series::slope(double branch) const {
  const long k = piece(branch);
  const auto i = static_cast<std::size_t>(std::max(k, 0L));
  if (k < 0 || between == Between::hold || i + 1 >= t.size()) return 0.0;
  return (v[i + 1] - v[i]) / (t[i + 1] - t[i]);
}

double Series::next_breakpoint(double time) const {
  const long k = piece(time);
  const auto i = static_cast<std::size_t>(k + 1);
  return i < t.size() ? t[i] : std::numeric_limits<double>::infinity();
}

}  // namespace hysteron
