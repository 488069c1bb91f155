#include "report/page/decimate.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hysteron {
namespace {

/// What is kept of the points [begin, end).
void keep_of_bucket(std::span<const double> x, std::span<const double> y, std::size_t begin, std::size_t end, bool loop,
                    std::vector<std::size_t>& kept) {
  // The outermost values beside their places: nothing is read twice.
  std::size_t low = begin, high = begin, left = begin, right = begin, gap = begin;
  double y_low = 0, y_high = 0, x_left = 0, x_right = 0;
  bool found = false;
  for (std::size_t i = begin; i < end; ++i) {
    const double x_here = x[i], y_here = y[i];
    if (!std::isfinite(x_here) || !std::isfinite(y_here)) {
      gap = i;
      continue;
    }
    if (!found) {
      low = high = left = right = i;
      y_low = y_high = y_here;
      x_left = x_right = x_here;
      found = true;
    }
    if (y_here < y_low) low = i, y_low = y_here;
    if (y_here > y_high) high = i, y_high = y_here;
    if (loop && x_here < x_left) left = i, x_left = x_here;
    if (loop && x_here > x_right) right = i, x_right = x_here;
  }
  std::array<std::size_t, 7> chosen{begin, end - 1, low, high, left, right, gap};
  std::sort(chosen.begin(), chosen.end());
  kept.insert(kept.end(), chosen.begin(), std::unique(chosen.begin(), chosen.end()));
}

std::vector<std::size_t> with_buckets(std::span<const double> x, std::span<const double> y, std::size_t buckets,
                                      bool loop) {
  const std::size_t n = x.size();
  std::vector<std::size_t> kept;
  std::size_t begin = 0;
  for (std::size_t b = 1; b <= buckets && begin < n; ++b) {
    std::size_t end = n;
    if (b < buckets) {
      const double share = static_cast<double>(b) / static_cast<double>(buckets);
      if (loop)
        end = static_cast<std::size_t>(share * static_cast<double>(n));
      else
        end = static_cast<std::size_t>(
            std::lower_bound(x.begin(), x.end(), x.front() + share * (x.back() - x.front())) - x.begin());
    }
    if (end > begin) keep_of_bucket(x, y, begin, end, loop, kept);
    begin = std::max(begin, end);
  }
  return kept;
}

}  // namespace

bool never_decreases(std::span<const double> x) {
  for (std::size_t i = 0; i < x.size(); ++i)
    if (!std::isfinite(x[i]) || (i > 0 && x[i] < x[i - 1])) return false;
  return true;
}

std::vector<std::size_t> decimate(std::span<const double> x, std::span<const double> y, std::size_t budget) {
  const std::size_t n = std::min(x.size(), y.size());
  x = x.first(n);
  y = y.first(n);
  if (n <= budget || budget < 4) {
    std::vector<std::size_t> all(n);
    for (std::size_t i = 0; i < n; ++i) all[i] = i;
    return all;
  }
  const bool loop = !never_decreases(x);
  // A smooth curve keeps two points of a bucket, a noisy one up to seven: begin with the hope and shrink to the budget.
  std::size_t buckets = budget / 2;
  for (;;) {
    auto kept = with_buckets(x, y, buckets, loop);
    if (kept.size() <= budget || buckets <= 1) return kept;
    const double fit = 0.98 * static_cast<double>(budget) / static_cast<double>(kept.size());
    buckets = std::max<std::size_t>(1, static_cast<std::size_t>(fit * static_cast<double>(buckets)));
  }
}

std::vector<std::size_t> share_budget(const std::vector<std::size_t>& points, std::size_t total) {
  std::vector<std::size_t> order(points.size()), share(points.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return points[a] < points[b]; });
  for (std::size_t k = 0; k < order.size(); ++k) {
    const std::size_t i = order[k];
    share[i] = std::min(points[i], total / (order.size() - k));
    total -= share[i];
  }
  return share;
}

}  // namespace hysteron
