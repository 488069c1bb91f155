#include "engine/diagram/smooth_series.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace hysteron {
namespace {

/// Into how many straight pieces the way between two samples is cut, by how far its chord lies beside it (of the
/// range).
int pieces_of(double beside) { return beside < 1e-4 ? 1 : beside < 1e-2 ? 2 : 4; }

/// Second derivatives of the spline at the samples, at least four: a tridiagonal system for those inside. The outermost
/// two pieces at each end are one cubic ("not a knot").
std::vector<double> bends_of(const Series& s) {
  const std::size_t n = s.t.size();
  const auto step = [&](std::size_t i) { return s.t[i + 1] - s.t[i]; };
  const auto slope = [&](std::size_t i) { return (s.v[i + 1] - s.v[i]) / step(i); };
  std::vector<double> bend(n), behind(n);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    double left = step(i - 1), middle = 2 * (step(i - 1) + step(i)), right = step(i);
    if (i == 1) {  // the bend at the end goes on as between the next two
      middle += left * (1 + left / step(i));
      right -= left * left / step(i);
      left = 0;
    }
    if (i + 2 == n) {
      middle += step(i) * (1 + step(i) / step(i - 1));
      left -= step(i) * step(i) / step(i - 1);
      right = 0;
    }
    const double pivot = middle - left * behind[i - 1];
    behind[i] = right / pivot;
    bend[i] = (6 * (slope(i) - slope(i - 1)) - left * bend[i - 1]) / pivot;
  }
  for (std::size_t i = n - 2; i-- > 1;) bend[i] -= behind[i] * bend[i + 1];
  bend[0] = bend[1] + (bend[1] - bend[2]) * step(0) / step(1);
  bend[n - 1] = bend[n - 2] + (bend[n - 2] - bend[n - 3]) * step(n - 2) / step(n - 3);
  return bend;
}

}  // namespace

Series in_straight_pieces(Series series) {
  if (series.between != Between::smooth) return series;
  series.between = Between::linear;
  const std::size_t n = series.t.size();
  if (n < 4) return series;
  const auto [low, high] = std::minmax_element(series.v.begin(), series.v.end());
  const double range = *high - *low;
  if (!(range > 0)) return series;
  const auto bend = bends_of(series);
  Series pieces;
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const double h = series.t[i + 1] - series.t[i];
    // A chord lies at most h^2/8 of the second derivative beside the curve.
    const int k = pieces_of(std::max(std::abs(bend[i]), std::abs(bend[i + 1])) * h * h / 8 / range);
    pieces.t.push_back(series.t[i]);
    pieces.v.push_back(series.v[i]);
    for (int j = 1; j < k; ++j) {
      const double b = static_cast<double>(j) / k, a = 1 - b;
      const double on_it = a * series.v[i] + b * series.v[i + 1] +
                           ((a * a * a - a) * bend[i] + (b * b * b - b) * bend[i + 1]) * h * h / 6;
      // In the mean a chord lies a twelfth of (h/k)^2 u'' inside; the points between the samples bring all of it back.
      pieces.t.push_back(series.t[i] + b * h);
      pieces.v.push_back(on_it - (a * bend[i] + b * bend[i + 1]) * h * h / (12.0 * k * (k - 1)));
    }
  }
  pieces.t.push_back(series.t.back());
  pieces.v.push_back(series.v.back());
  return pieces;
}

}  // namespace hysteron
