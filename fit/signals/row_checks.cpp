#include "fit/signals/row_checks.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fit/numerics/median.h"
#include "fit/signals/branches.h"

namespace hysteron {
namespace {

std::vector<double> differences(std::span<const double> v) {
  std::vector<double> d;
  d.reserve(v.size());
  for (std::size_t i = 1; i < v.size(); ++i) d.push_back(v[i] - v[i - 1]);
  return d;
}

constexpr std::size_t neighbours = 4;  // rows on each side that must agree before a row is called odd

/// Differences around difference `i`, itself left out, if they all have one sign; else none.
std::vector<double> steady_motion(const std::vector<double>& d, std::size_t i) {
  std::vector<double> around;
  if (i < neighbours || i + neighbours >= d.size()) return {};
  for (std::size_t k = i - neighbours; k <= i + neighbours; ++k)
    if (k != i) around.push_back(d[k]);
  const bool up = around.front() > 0;
  for (const double x : around)
    if (x == 0 || (x > 0) != up) return {};
  return around;
}

/// True if the steps below `longest` have two lengths only: a uniform clock whose times were rounded.
bool two_lengths(const std::vector<double>& steps, double longest) {
  double first = 0, second = 0;
  for (const double s : steps) {
    const auto same = [&](double other) { return std::abs(s - other) < 1e-6 * s; };
    if (s > longest || same(first) || same(second)) continue;
    if (first == 0)
      first = s;
    else if (second == 0)
      second = s;
    else
      return false;
  }
  return true;
}

/// True if values come back after others stood between: levels of a converter that are not evenly spaced.
bool meets_its_values_again(std::span<const double> values) {
  std::vector<double> runs;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (i == 0 || values[i] != values[i - 1]) runs.push_back(values[i]);
  const auto n = static_cast<double>(runs.size());
  std::sort(runs.begin(), runs.end());
  const auto distinct = std::unique(runs.begin(), runs.end()) - runs.begin();
  return static_cast<double>(distinct) < 0.9 * n;
}

Plateau plateau(std::span<const double> values, double finest, const std::vector<bool>& moving, double sign) {
  Plateau p;
  if (values.size() < 50) return p;
  double end = -std::numeric_limits<double>::infinity(), other = end;
  for (const double v : values) {
    end = std::max(end, sign * v);
    other = std::max(other, -sign * v);
  }
  const double span = end + other;
  if (!(span > 0)) return p;
  // Levels of the converter; a column without any has as many as rows could tell.
  const double level = std::max(finest, span / static_cast<double>(values.size()));
  const double same = std::max(0.25 * finest, 1e-9 * span);
  constexpr int next = 10;
  std::size_t near = 0, run = 0, longest = 0, in_runs = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double below = end - sign * values[i];
    const bool counts = moving.empty() || moving[i];
    run = counts && below <= same ? run + 1 : 0;
    longest = std::max(longest, run);
    if (run > 0) ++p.rows;
    if (run == 2) in_runs += 2;
    if (run > 2) ++in_runs;
    if (counts && below > same && below < (next + 0.5) * level) ++near;
  }
  const double usual = static_cast<double>(near) / next;
  p.level = sign * end;
  // A signal that is stopped stays for some rows; one that turns there every period meets the same value once.
  p.found = static_cast<double>(p.rows) > 8 * usual + 5 * std::sqrt(usual) + 5 && longest >= 3 && 2 * in_runs >= p.rows;
  return p;
}

}  // namespace

long Clock::missing() const {
  long sum = 0;
  for (const auto& gap : gaps) sum += gap.missing;
  return sum;
}

Clock clock_of(std::span<const double> t) {
  Clock c;
  const auto steps = differences(t);
  if (steps.empty()) return c;
  c.step = median(steps);
  const auto [shortest, longest] = std::minmax_element(steps.begin(), steps.end());
  c.shortest = *shortest;
  c.longest = *longest;
  if (!(c.step > 0)) return c;
  std::size_t usual = 0;
  for (const double s : steps) usual += std::abs(s - c.step) <= 0.2 * c.step ? 1U : 0U;
  c.regular = 10 * usual >= 9 * steps.size();
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const double ratio = steps[i] / c.step;
    if (c.regular && ratio > 1.5)
      c.gaps.push_back({i + 1, t[i + 1], std::lround(ratio) - 1});
    else
      c.jitter = std::max(c.jitter, std::abs(ratio - 1));
  }
  c.uniform = c.regular && (c.jitter <= 1e-3 || two_lengths(steps, 1.5 * c.step));
  return c;
}

double finest_step(std::span<const double> values) {
  std::vector<double> level(values.begin(), values.end());
  std::sort(level.begin(), level.end());
  if (level.size() < 8) return 0;
  const double span = level.back() - level.front();
  if (!(span > 0)) return 0;
  const double same = 1e-9 * span;  // equal but for the rounding of a unit conversion
  level.erase(std::unique(level.begin(), level.end(), [&](double a, double b) { return b - a <= same; }), level.end());
  if (level.size() < 2) return 0;
  const auto gaps = differences(level);
  const double least = *std::min_element(gaps.begin(), gaps.end());
  double first = 0, n = 0;
  for (const double g : gaps)
    if (g < 1.3 * least) first += g, n += 1;
  first /= n;
  if (span / first > 1e7) return 0;
  // Counted upwards; the longer the way, the sharper the step. Over a gap so wide that the count is lost a new way
  // begins: nothing is known of the levels between.
  struct Way {
    double from, q, steps;
  };
  Way way{level.front(), first, 0}, best = way;
  std::vector<double> begin{level.front()};
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    const double steps = std::max(1.0, std::round(gaps[i] / way.q));
    if (steps > 4 * std::max(4.0, way.steps)) {
      way = {level[i + 1], best.q, 0};
    } else {
      way.steps += steps;
      // A short way from a rounded first level would spoil what is known.
      if (way.steps >= 16 && way.steps >= best.steps) way.q = (level[i + 1] - way.from) / way.steps;
    }
    if (way.steps > best.steps) best = way;
    begin.push_back(way.from);
  }
  if (best.steps < 2) return 0;
  for (std::size_t i = 0; i < level.size(); ++i) {
    const double k = (level[i] - begin[i]) / best.q;
    if (std::abs(k - std::round(k)) > 0.2) return 0;
  }
  return best.q;
}

std::vector<std::size_t> repeats_in_motion(std::span<const double> values, double finest) {
  std::vector<std::size_t> rows;
  const auto d = differences(values);
  // Beyond seven standard deviations of a difference no noise takes a step back to nothing.
  const double least = std::max(4 * finest, 7 * std::sqrt(2.0) * roughness(values));
  for (std::size_t i = 0; i < d.size(); ++i) {
    if (d[i] != 0) continue;
    const auto around = steady_motion(d, i);
    if (around.empty()) continue;
    const double pace = median(around);
    // The step behind a reading that was not fetched makes up for it.
    const double caught_up = d[i + 1] / pace;
    std::size_t steady = 0;
    for (const double x : around) steady += std::abs(x / pace - 1) < 0.3 ? 1U : 0U;
    const bool all_but_that = steady == around.size() || (steady + 1 == around.size() && caught_up > 1.3);
    if (std::abs(pace) > least && all_but_that && caught_up < 2.5) rows.push_back(i + 1);
  }
  return rows;
}

std::vector<std::size_t> leaps_in_motion(std::span<const double> values, double finest) {
  std::vector<std::size_t> rows;
  const auto d = differences(values);
  const double least = std::max(10 * finest, 7 * std::sqrt(2.0) * roughness(values));
  for (std::size_t i = 0; i < d.size(); ++i) {
    const auto around = steady_motion(d, i);
    if (around.empty()) continue;
    const double pace = median(around);
    const double ratio = d[i] / pace;
    if (ratio < 1.7 || ratio > 20 || std::abs(pace) <= least) continue;
    if (std::all_of(around.begin(), around.end(), [&](double x) { return std::abs(x / pace - 1) < 0.15; }))
      rows.push_back(i + 1);
  }
  return rows;
}

std::vector<std::size_t> rows_apart(std::span<const double> values) {
  constexpr double outside = 0.5;  // of the range of the others; the largest of 1e5 rows of noise stands out by 0.1
  const std::size_t n = values.size();
  std::vector<std::size_t> rows;
  if (n < 16) return rows;
  // Among many rows those that stand apart are few: what hundreds reach belongs to the signal.
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  const std::size_t few = std::max<std::size_t>(1, n / 500);
  const double low = sorted[few], high = sorted[n - 1 - few], range = high - low;
  const auto is_out = [&](std::size_t i) {
    return values[i] > high + outside * range || values[i] < low - outside * range;
  };
  for (std::size_t i = 0; i < n; ++i)
    if (is_out(i) && (i == 0 || !is_out(i - 1)) && (i + 1 == n || !is_out(i + 1))) rows.push_back(i);
  return rows.size() <= few ? rows : std::vector<std::size_t>{};
}

long unexplained_repeats(std::span<const double> values, double finest) {
  const double noise = roughness(values);
  if (!(noise > 2 * finest)) return 0;  // on few levels a repeat is the rule
  if (finest == 0 && meets_its_values_again(values)) return 0;
  const double level = finest > 0 ? finest : noise * 1e-3;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  double none = 0, next = 0;
  for (std::size_t i = 1; i < values.size(); ++i) {
    const double d = values[i] - values[i - 1], k = std::abs(d) / level;
    if (k < 0.5 && (finest > 0 || d == 0))
      none += values[i] == *low || values[i] == *high ? 0 : 1;  // what clips repeats as well, and is told apart
    else if (k < 2.5)
      next += 1;
  }
  // Four levels (one and two up or down) where the column has levels, else two and a half of either sign.
  const double usual = next / (finest > 0 ? 4 : 5);
  return none > 1.25 * usual + 6 * std::sqrt(usual) + 5 ? std::lround(none - usual) : 0;
}

Plateau plateau_at_top(std::span<const double> values, double finest, const std::vector<bool>& moving) {
  return plateau(values, finest, moving, 1);
}
Plateau plateau_at_bottom(std::span<const double> values, double finest, const std::vector<bool>& moving) {
  return plateau(values, finest, moving, -1);
}

}  // namespace hysteron
