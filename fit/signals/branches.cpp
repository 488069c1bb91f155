#include "fit/signals/branches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "fit/numerics/median.h"

namespace hysteron {
namespace {

double span_of(std::span<const double> u) {
  if (u.empty()) return 0;
  const auto [low, high] = std::minmax_element(u.begin(), u.end());
  return *high - *low;
}

}  // namespace

double roughness(std::span<const double> u) {
  // White noise of rms 1 has differences of order m with variance (2m choose m), and median |x| = 0.6745 rms. A smooth
  // signal has differences that fall with the order, so the least of three orders is the noise and hardly ever the
  // signal.
  constexpr std::array variance{2.0, 6.0, 20.0, 70.0, 252.0, 924.0};
  std::vector<double> difference(u.begin(), u.end()), size;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t order = 1; order <= 6 && difference.size() > 8; ++order) {
    for (std::size_t i = 0; i + 1 < difference.size(); ++i) difference[i] = difference[i + 1] - difference[i];
    difference.pop_back();
    if (order % 2 != 0) continue;
    size.resize(difference.size());
    std::transform(difference.begin(), difference.end(), size.begin(), [](double x) { return std::abs(x); });
    least = std::min(least, median_of(size) / 0.6745 / std::sqrt(variance[order - 1]));
  }
  return std::isfinite(least) ? least : 0;
}

double turning_threshold(std::span<const double> u) { return turning_threshold(u, roughness(u)); }

double turning_threshold(std::span<const double> u, double rough) { return std::max(0.02 * span_of(u), 6 * rough); }

std::vector<std::size_t> turning_points(std::span<const double> u, double threshold) {
  std::vector<std::size_t> turns;
  if (u.size() < 3) return turns;
  std::size_t high = 0, low = 0;  // extremes since the last turn
  int direction = 0;
  for (std::size_t i = 1; i < u.size(); ++i) {
    if (u[i] > u[high]) high = i;
    if (u[i] < u[low]) low = i;
    if (direction >= 0 && u[high] - u[i] > threshold) {
      // The very first extreme is a turn only if the signal had really come up to it.
      if (direction > 0 || u[high] - u[0] > threshold) turns.push_back(high);
      direction = -1;
      low = i;
    } else if (direction <= 0 && u[i] - u[low] > threshold) {
      if (direction < 0 || u[0] - u[low] > threshold) turns.push_back(low);
      direction = 1;
      high = i;
    }
  }
  return turns;
}

std::vector<Branch> branches(std::span<const double> u) { return branches(u, roughness(u)); }

std::vector<Branch> branches(std::span<const double> u, double rough) {
  std::vector<Branch> branch(u.size(), Branch::hold);
  const double span = span_of(u);
  if (!(span > 0)) return branch;

  // Legs between turning points give every row a direction ...
  auto ends = turning_points(u, turning_threshold(u, rough));
  ends.push_back(u.size() - 1);
  std::size_t begin = 0;
  for (const std::size_t end : ends) {
    const Branch direction = u[end] >= u[begin] ? Branch::rising : Branch::falling;
    for (std::size_t i = begin; i <= end; ++i) branch[i] = direction;
    begin = end;
  }
  // ... and runs of rows that stay where they are become holds.
  const double flat = std::max(1e-4 * span, 6 * rough);
  constexpr std::size_t shortest = 5;
  for (std::size_t i = 0; i < u.size();) {
    double low = u[i], high = u[i];
    std::size_t j = i + 1;
    for (; j < u.size(); ++j) {
      const double l = std::min(low, u[j]), h = std::max(high, u[j]);
      if (h - l > flat) break;
      low = l;
      high = h;
    }
    if (j - i >= shortest) {
      std::fill(branch.begin() + static_cast<std::ptrdiff_t>(i), branch.begin() + static_cast<std::ptrdiff_t>(j),
                Branch::hold);
      i = j;
    } else {
      ++i;
    }
  }
  return branch;
}

std::size_t first_cycle_end(std::span<const double> u) { return first_cycle_end(u, turning_threshold(u)); }

std::size_t first_cycle_end(std::span<const double> u, double threshold) {
  const auto turns = turning_points(u, threshold);
  return turns.size() < 2 ? u.size() : turns[1];
}

}  // namespace hysteron
