#include "fit/signals/excitation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fit/signals/branches.h"
#include "fit/signals/whiten.h"

namespace hysteron {
namespace {

double range_of(std::span<const double> u) {
  if (u.empty()) return 0;
  const auto [low, high] = std::minmax_element(u.begin(), u.end());
  return *high - *low;
}

/// Slope between the rows beside `i`, per row.
double slope(std::span<const double> u, std::size_t i) {
  const std::size_t a = i > 0 ? i - 1 : 0, b = std::min(i + 1, u.size() - 1);
  return b > a ? (u[b] - u[a]) / static_cast<double>(b - a) : 0;
}

/// Rows of a window that moves most: what stands still matches everything.
struct Window {
  std::size_t begin = 0, size = 0;
};
Window liveliest(std::span<const double> u) {
  Window best{0, std::clamp<std::size_t>(u.size() / 8, 16, 400)};
  double most = -1;
  constexpr std::size_t tried = 16;
  for (std::size_t k = 0; k < tried; ++k) {
    // In the first half, so that a later period can be found behind it.
    const std::size_t begin = k * (u.size() / 2 - best.size) / tried;
    double sum = 0, squares = 0;
    for (std::size_t i = begin; i < begin + best.size; ++i) {
      sum += u[i] - u[0];
      squares += (u[i] - u[0]) * (u[i] - u[0]);
    }
    const double variance = squares - sum * sum / static_cast<double>(best.size);
    if (variance > most) {
      most = variance;
      best.begin = begin;
    }
  }
  return best;
}

/// Mean square of u[i + lag] - u[i] over every `stride`-th row of a window, after the best shift by part of a row, and
/// that shift.
double mismatch(std::span<const double> u, const Window& w, std::size_t lag, std::size_t stride, double& part) {
  double ee = 0, es = 0, ss = 0, n = 0;
  for (std::size_t i = w.begin; i < w.begin + w.size; i += stride) {
    const double e = u[i + lag] - u[i], s = slope(u, i + lag);
    ee += e * e;
    es += e * s;
    ss += s * s;
    n += 1;
  }
  part = ss > 0 ? std::clamp(es / ss, -0.6, 0.6) : 0;
  return (ee - 2 * part * es + part * part * ss) / n;
}

/// Rows around the window over which u repeats with this lag: blocks of a window that match to `limit`.
Period grown(std::span<const double> u, const Window& w, std::size_t lag, double part, double limit) {
  std::size_t first = w.begin, last = w.begin + w.size;
  const std::size_t block = std::max<std::size_t>(8, w.size / 8);
  const auto fits = [&](std::size_t begin) {
    double squares = 0;
    for (std::size_t i = begin; i < begin + block; ++i) {
      const double e = u[i + lag] - u[i] - part * slope(u, i + lag);
      squares += e * e;
    }
    return squares <= 4 * limit * static_cast<double>(block);  // a short block scatters more than the window
  };
  while (first >= block && fits(first - block)) first -= block;
  while (last + block + lag <= u.size() && fits(last)) last += block;
  return {static_cast<double>(lag) - part, first, std::min(u.size(), last + lag)};
}

}  // namespace

Hold longest_hold(std::span<const double> t, std::span<const double> u, double range) {
  Hold longest;
  if (u.empty()) return longest;
  double low = u.front();
  double high = u.front();
  for (std::size_t i = 0; i < u.size();) {
    std::size_t end = i;
    while (end + 1 < u.size() && std::abs(u[end + 1] - u[i]) <= 0.005 * range) ++end;
    const bool moved = std::max(high - u[i], u[i] - low) >= 0.05 * range;
    if (moved && t[end] - t[i] > longest.length) longest = {t[i], t[end] - t[i]};
    for (std::size_t k = i; k <= end; ++k) {
      low = std::min(low, u[k]);
      high = std::max(high, u[k]);
    }
    i = end + 1;
  }
  return longest;
}

Band band_of(std::span<const double> u, double step) {
  const std::size_t n = u.size();
  if (n < 16 || !(step > 0) || !(range_of(u) > 0)) return {};
  std::vector<double> c(n);
  double mean = 0, weight = 0;  // the window's own mean: what is left of a constant would pass for a slow line
  for (std::size_t i = 0; i < n; ++i) {
    c[i] = std::pow(std::sin(std::numbers::pi * (static_cast<double>(i) + 0.5) / static_cast<double>(n)), 2);
    mean += c[i] * u[i];
    weight += c[i];
  }
  for (std::size_t i = 0; i < n; ++i) c[i] *= u[i] - mean / weight;
  cosine_transform(c);
  // A single cosine may miss the phase of a line; two neighbours do not.
  std::vector<double> power(n, 0.0);
  for (std::size_t k = 1; k + 1 < n; ++k) power[k] = c[k] * c[k] + 0.5 * (c[k - 1] * c[k - 1] + c[k + 1] * c[k + 1]);
  const double peak = *std::max_element(power.begin(), power.end());
  Band band;
  for (std::size_t k = 1; k < n; ++k) {
    if (power[k] < 1e-4 * peak) continue;
    const double f = static_cast<double>(k) / (2 * static_cast<double>(n) * step);
    if (band.highest == 0) band.lowest = f;
    band.highest = f;
  }
  return band;
}

std::vector<double> swing_sizes(std::span<const double> u) {
  const double range = range_of(u);
  std::vector<double> swings, sizes;
  if (!(range > 0)) return sizes;
  const auto turns = turning_points(u, turning_threshold(u));
  for (std::size_t k = 1; k < turns.size(); ++k) swings.push_back(std::abs(u[turns[k]] - u[turns[k - 1]]));
  std::sort(swings.begin(), swings.end());
  for (const double s : swings)
    if (sizes.empty() || s - sizes.back() > 0.1 * range) sizes.push_back(s);
  return sizes;
}

std::vector<Swing> swings_of(std::span<const double> t, std::span<const double> u, double threshold) {
  std::vector<Swing> list;
  if (u.size() < 2) return list;
  auto ends = turning_points(u, threshold);
  if (ends.size() < 2) {
    ends.insert(ends.begin(), 0);
    ends.push_back(u.size() - 1);
  }
  for (std::size_t k = 1; k < ends.size(); ++k) {
    const double from = u[ends[k - 1]], to = u[ends[k]];
    Swing swing{std::abs(to - from), 0.5 * (from + to), 0};
    if (!(swing.size > threshold)) continue;
    for (std::size_t i = ends[k - 1] + 1; i <= ends[k]; ++i)
      if (t[i] > t[i - 1]) swing.fastest = std::max(swing.fastest, std::abs(u[i] - u[i - 1]) / (t[i] - t[i - 1]));
    list.push_back(swing);
  }
  return list;
}

Period period_of(std::span<const double> u) {
  const double range = range_of(u);
  if (u.size() < 64 || !(range > 0)) return {};
  const Window w = liveliest(u);
  const double limit = 1e-4 * range * range;  // 1 % of the range
  // Close to its own place everything smooth matches: a period begins once the window has been left.
  bool left = false;
  double part = 0, best = 0, best_part = 0;
  std::size_t best_lag = 0;
  for (std::size_t lag = 2; w.begin + w.size + lag < u.size(); ++lag) {
    // Most lags are far off: a few rows of the window tell.
    double now = mismatch(u, w, lag, 16, part);
    if (now <= 4 * limit) now = mismatch(u, w, lag, 1, part);
    if (now > limit) {
      if (best_lag > 0)
        if (const Period found = grown(u, w, best_lag, best_part, limit); found.count() >= 2) return found;
      left = true;
      best_lag = 0;
    } else if (left && (best_lag == 0 || std::abs(part) < std::abs(best_part) ||
                        (std::abs(part) == std::abs(best_part) && now < best))) {
      best_lag = lag;  // of a valley of lags, the one that needs the least part of a row besides
      best_part = part;
      best = now;
    }
  }
  return best_lag > 0 && grown(u, w, best_lag, best_part, limit).count() >= 2 ? grown(u, w, best_lag, best_part, limit)
                                                                              : Period{};
}

double cycle_frequency(std::span<const double> t, std::span<const double> u) {
  const Period period = period_of(u);
  if (!period.found()) return 0;
  const auto turns = turning_points(u.subspan(period.first, period.last - period.first), 0.05 * range_of(u)).size();
  if (static_cast<double>(turns) > 2 * period.count() + 1) return 0;
  return static_cast<double>(u.size() - 1) / (t.back() - t.front()) / period.rows;
}

int harmonic_order(double frequency, std::span<const double> cycles) {
  constexpr int highest = 15;      // what is further up is small, and any frequency is near one of many multiples
  constexpr double as_one = 0.02;  // of the drive's frequency
  int order = 0;
  for (const double f : cycles) {
    order = f > 0 ? static_cast<int>(std::lround(frequency / f)) : 0;
    if (order < 2 || order > highest || std::abs(frequency / f - order) > as_one) return 0;
  }
  return order;
}

}  // namespace hysteron
