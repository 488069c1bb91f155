// Decides where a structure breaks in: at a level, at instants, for a while. See structures.h.
#include <algorithm>
#include <cmath>
#include <limits>

#include "discover/residual_parts.h"
#include "discover/structures.h"
#include "fit/median.h"

namespace hysteron {
namespace {

using Part = ResidualPart;

double span_of(const Rows& rows) {
  if (rows.empty()) return 0;
  const auto [low, high] = std::minmax_element(rows.begin(), rows.end());
  return *high - *low;
}

/// The drive moves by more than a tenth of its range next to this row.
bool drive_jumps(const Part& p, std::size_t k, double span) {
  if (!(span > 0)) return false;
  for (std::size_t j = k > 1 ? k - 1 : 1; j <= std::min(k + 1, p.drive.size() - 1); ++j)
    if (std::abs(p.drive[j] - p.drive[j - 1]) > 0.1 * span) return true;
  return false;
}

/// Rows behind which the residual jumps: by more than six times the noise, alone among its neighbours, and not with the
/// drive.
std::vector<std::size_t> jumps_of(const Part& p, double white) {
  const std::size_t n = p.e.size();
  const double span = span_of(p.drive);
  std::vector<std::size_t> found;
  for (std::size_t k = 1; k < n; ++k) {
    const double d = std::abs(p.e[k] - p.e[k - 1]);
    if (d < 6 * white || drive_jumps(p, k, span)) continue;
    std::vector<double> around;
    for (std::size_t j = k > 6 ? k - 6 : 1; j <= std::min(k + 6, n - 1); ++j)
      if (j != k) around.push_back(std::abs(p.e[j] - p.e[j - 1]));
    if (d > 4 * median(std::move(around))) found.push_back(k);
  }
  if (found.size() * 10 > n) found.clear();  // that many are no jumps but a rough residual
  return found;
}

/// The residual less its mean between jumps.
Rows without_levels(const Part& p, const std::vector<std::size_t>& at) {
  Rows left = p.e;
  std::size_t begin = 0;
  for (std::size_t j = 0; j <= at.size(); ++j) {
    const std::size_t end = j < at.size() ? at[j] : left.size();
    double mean = 0;
    for (std::size_t k = begin; k < end; ++k) mean += left[k];
    mean /= static_cast<double>(end - begin);
    for (std::size_t k = begin; k < end; ++k) left[k] -= mean;
    begin = end;
  }
  return left;
}

/// Jumps that all happen at one level belong to that level, a threshold, unless it is where the signal stays anyway.
void share_one_level(Structure& s, const Level& level, std::vector<double> at) {
  if (at.size() < 4) return;
  std::sort(at.begin(), at.end());
  const double middle_half = at[at.size() * 3 / 4] - at[at.size() / 4];
  if (middle_half > 0.03 * level.span() || middle_half > 0.1 * level.middle_half) return;
  s.threshold = at[at.size() / 2];
  s.has_threshold = true;
  s.variable = level.name;
  s.unit = level.unit;
}

/// Rows [first, last) in which the whitened residual shakes: its power over nine rows is beyond what noise reaches
/// anywhere in the recording, held together over gaps of as much.
std::vector<std::pair<std::size_t, std::size_t>> shaken(const Rows& z) {
  constexpr std::size_t window = 9;
  std::vector<std::pair<std::size_t, std::size_t>> list;
  if (z.size() < 4 * window) return list;
  std::vector<double> squares;
  for (const double v : z) squares.push_back(v * v);
  const double unit = median(squares) / 0.4549;  // the median of chi2 with one degree of freedom
  // Chance that nine squares reach this: below one in ten thousand windows (chi2, nine degrees of freedom).
  const double bar = 33.7 * std::max(unit, 1.0);
  double power = 0;
  for (std::size_t k = 0; k < z.size(); ++k) {
    power += squares[k] - (k >= window ? squares[k - window] : 0);
    if (k + 1 < window || power < bar) continue;
    const std::size_t first = k + 1 - window;
    if (!list.empty() && first <= list.back().second + window)
      list.back().second = k + 1;
    else
      list.emplace_back(first, k + 1);
  }
  // The windows reach beyond what they saw: ends are where the rows themselves stand out.
  for (auto& [first, last] : list) {
    while (first + 1 < last && squares[first] < 4 * unit) ++first;
    while (last > first + 1 && squares[last - 1] < 4 * unit) --last;
  }
  return list;
}

}  // namespace

std::optional<Structure> kink_at_level(const ResidualParts& parts, std::size_t level) {
  const Level& over = parts.levels()[level];
  const auto line = parts.whitened([&](const Part& p) {
    return std::vector<Rows>{Rows(p.levels[level].size(), 1.0), p.levels[level]};
  });
  const auto falls_at = [&](double at) {
    const auto kink = [&](const Part& p) {
      const Rows& x = p.levels[level];
      Rows step(x.size()), slope(x.size());
      for (std::size_t k = 0; k < x.size(); ++k) {
        step[k] = x[k] > at ? 1.0 : 0.0;
        slope[k] = std::max(x[k] - at, 0.0);
      }
      return std::vector<Rows>{std::move(step), std::move(slope)};
    };
    return parts.judged(kink, line);
  };
  const auto fall_at = [&](double at) { return falls_at(at).validate; };
  const double width = over.span() / 40;
  double best = 0, fall = 0;
  for (int i = 2; i < 39; ++i)
    if (const double f = fall_at(over.lowest + i * width); f > fall) best = over.lowest + i * width, fall = f;
  // A step of many times the noise is placed to a row: half a division off, it explains half of itself.
  for (double w = width / 2; fall > 0 && w > width / 200; w /= 2)
    for (const int side : {-1, 1})
      if (const double f = fall_at(best + side * w); f > fall) {
        best += side * w;
        fall = f;
        break;
      }
  if (fall <= 0) return std::nullopt;
  Structure s;
  s.kind = "kink_at_level";
  s.variable = over.name;
  s.threshold = best;
  s.has_threshold = true;
  s.unit = over.unit;
  s.fall = falls_at(best);
  return s;
}

std::optional<Structure> jumps(const ResidualParts& parts) {
  Structure s;
  s.kind = "jumps";
  s.variable = "t";
  s.unit = parse_unit("s");
  std::vector<std::vector<double>> at_level(parts.levels().size());
  for (const auto& p : parts.list()) {
    const auto at = jumps_of(p, parts.white());
    if (at.empty()) continue;
    std::vector<std::pair<double, double>> intervals;
    for (const std::size_t k : at) {
      intervals.emplace_back(p.t[k - 1], p.t[k]);
      for (std::size_t l = 0; l < at_level.size(); ++l) at_level[l].push_back(p.levels[l][k]);
    }
    s.intervals.emplace_back(parts.model().recording(p.recording).name, std::move(intervals));
    // Each jump is paid for by its place and its height.
    s.fall.of(p.train) += p.w.squaredNorm() - parts.whitened(p, without_levels(p, at)).squaredNorm() -
                          2 * std::log(static_cast<double>(p.e.size())) * static_cast<double>(at.size());
  }
  if (s.intervals.empty()) return std::nullopt;
  for (std::size_t l = 0; l < at_level.size(); ++l) share_one_level(s, parts.levels()[l], std::move(at_level[l]));
  return s;
}

std::optional<Structure> bursts(const ResidualParts& parts) {
  Structure s;
  s.kind = "bursts";
  s.variable = "t";
  s.unit = parse_unit("s");
  for (const auto& p : parts.list()) {
    const Rows z = parts.whitened_in_time(p);
    const double price = 4 * std::log(static_cast<double>(z.size()));  // of its two ends
    std::size_t rows = 0;
    double fall = 0;
    std::vector<std::pair<double, double>> intervals;
    for (const auto& [first, last] : shaken(z)) {
      double above = -price;
      for (std::size_t k = first; k < last; ++k) above += z[k] * z[k] - 1;
      if (above <= 0) continue;
      intervals.emplace_back(p.t[first], p.t[last - 1]);
      rows += last - first;
      fall += above;
    }
    if (intervals.empty() || rows * 2 > z.size()) continue;  // what lasts is no burst
    s.intervals.emplace_back(parts.model().recording(p.recording).name, std::move(intervals));
    s.fall.of(p.train) += fall;
  }
  if (s.intervals.empty()) return std::nullopt;
  return s;
}

}  // namespace hysteron
