#include "fit/thesis/slopes_method.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/diagram/error.h"

namespace hysteron {
namespace {

/// Sums of a straight line through points, centred on the first one so that no digits are lost.
struct Line {
  double u0 = 0, y0 = 0, u = 0, y = 0, uu = 0, uy = 0;
  int n = 0;

  void add(double at, double value) {
    if (n == 0) {
      u0 = at;
      y0 = value;
    }
    const double du = at - u0, dy = value - y0;
    u += du;
    y += dy;
    uu += du * du;
    uy += du * dy;
    ++n;
  }
  double spread() const { return uu - u * u / n; }
  double slope() const { return (uy - u * y / n) / spread(); }
  double intercept() const { return y0 + y / n - slope() * (u0 + u / n); }
};

void check_thresholds(std::span<const double> r) {
  const bool rising = std::adjacent_find(r.begin(), r.end(), [](double a, double b) { return !(a < b); }) == r.end();
  if (r.empty() || r[0] != 0 || !rising)
    fail("bad_thresholds", "thresholds", "the slopes need thresholds that begin with 0 and increase",
         "give 0, the linear part, first, then each threshold once");
}

}  // namespace

SlopesFound weights_by_slopes(std::span<const double> u, std::span<const double> y,
                              std::span<const double> thresholds) {
  check_thresholds(thresholds);
  std::vector<Line> lines(thresholds.size());
  if (!u.empty()) {
    const auto [low, high] = std::minmax_element(u.begin(), u.end());
    const double bottom = *low + 0.01 * (*high - *low);
    // A row at a threshold lies on both lines.
    const auto take = [&](std::size_t k) {
      for (auto i = std::upper_bound(thresholds.begin(), thresholds.end(), u[k]) - thresholds.begin(); i-- > 0;) {
        lines[static_cast<std::size_t>(i)].add(u[k], y[k]);
        if (u[k] > thresholds[static_cast<std::size_t>(i)]) break;
      }
    };
    bool counts = false;  // the branch that rises now began at the bottom
    for (std::size_t k = 1; k < u.size(); ++k) {
      if (!(u[k] > u[k - 1])) {
        counts = false;
        continue;
      }
      if (!counts && u[k - 1] <= bottom) {
        counts = true;
        take(k - 1);
      }
      if (counts) take(k);
    }
  }
  SlopesFound found;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].n < 2 || !(lines[i].spread() > 0))
      fail("too_few_rows", fmt::format("thresholds[{}]", i),
           fmt::format(
               "{} rows rise from the bottom of the input between this threshold and the next, and a slope needs "
               "two",
               lines[i].n),
           "leave the threshold out, sample faster, or drive further");
    const double slope = lines[i].slope();
    found.weights.push_back(i == 0 ? slope : slope - found.slopes.back());
    found.slopes.push_back(slope);
    found.intercepts.push_back(lines[i].intercept());
    found.samples.push_back(lines[i].n);
  }
  return found;
}

}  // namespace hysteron
