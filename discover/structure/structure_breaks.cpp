#include "discover/structure/structure_breaks.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "discover/structure/residual_parts.h"
#include "fit/numerics/median.h"

namespace hysteron {
namespace {

using Part = ResidualPart;

double span_of(const Rows& rows) {
  if (rows.empty()) return 0;
  const auto [low, high] = std::minmax_element(rows.begin(), rows.end());
  return *high - *low;
}

/// The drive moves by more than a tenth of its range within so many rows.
bool drive_jumps(const Part& p, std::size_t k, std::size_t within, double span) {
  if (!(span > 0)) return false;
  for (std::size_t j = k > within ? k - within : 1; j <= std::min(k + within, p.drive.size() - 1); ++j)
    if (std::abs(p.drive[j] - p.drive[j - 1]) > 0.1 * span) return true;
  return false;
}

/// By how much the mean over so many rows from row k on differs from that over as many before it; 0 at the ends.
Rows differences(const Rows& e, std::size_t window) {
  Rows list(e.size(), 0.0);
  double behind = 0, before = 0;
  for (std::size_t k = 0; k < std::min(window, e.size()); ++k) before += e[k];
  for (std::size_t k = window; k < std::min(2 * window, e.size()); ++k) behind += e[k];
  for (std::size_t k = window; k + window <= e.size(); ++k) {
    list[k] = std::abs(behind - before) / static_cast<double>(window);
    before += e[k] - e[k - window];
    if (k + window < e.size()) behind += e[k + window] - e[k];
  }
  return list;
}

/// Do two means explain the rows about row k better than a straight line: what swings slowly has steep places.
bool is_steeper_than_a_line(const Rows& e, std::size_t k, std::size_t window, double jump) {
  double along = 0, lengths = 0;
  for (std::size_t j = k - window; j < k + window; ++j) {
    const double x = static_cast<double>(j) + 0.5 - static_cast<double>(k);
    along += x * e[j];
    lengths += x * x;
  }
  return 0.5 * static_cast<double>(window) * jump * jump > along * along / lengths;
}

/// Of the white noise: six standard deviations of the difference of two means, for what is slow adds to it; of two rows
/// four, for these it leaves alone.
double jump_bar(std::size_t window) { return window == 1 ? 6 : 6 * std::sqrt(2 / static_cast<double>(window)); }

/// Rows at which the mean over so many rows jumps, most there, alone among its neighbours, and not with the drive.
std::vector<std::size_t> jumps_of_means(const Part& p, std::size_t window, double white) {
  const Rows d = differences(p.e, window);
  const double span = span_of(p.drive), bar = jump_bar(window) * white;
  std::vector<std::size_t> found;
  for (std::size_t k = 1; k < d.size(); ++k) {
    if (d[k] < bar || drive_jumps(p, k, window, span)) continue;
    bool most = true;
    std::vector<double> around;
    const std::size_t reach = window + 5;
    for (std::size_t j = k > reach ? k - reach : 1; j <= std::min(k + reach, d.size() - 1); ++j) {
      const std::size_t off = j > k ? j - k : k - j;
      if (off >= window) around.push_back(d[j]);
      if (off > 0 && off < window) most = most && (d[j] < d[k] || (d[j] == d[k] && j > k));
    }
    if (most && d[k] > 4 * median(std::move(around)) && (window == 1 || is_steeper_than_a_line(p.e, k, window, d[k])))
      found.push_back(k);
  }
  return found;
}

/// Rows behind which the residual jumps: of single rows what stands out of their noise, of means what is smaller.
std::vector<std::size_t> jumps_of(const Part& p, double white) {
  std::vector<std::size_t> found;
  for (const std::size_t window : {1, 4, 16}) {
    std::vector<std::size_t> more;
    for (const std::size_t k : jumps_of_means(p, window, white))
      if (std::none_of(found.begin(), found.end(), [&](std::size_t j) { return (j > k ? j - k : k - j) <= window; }))
        more.push_back(k);
    found.insert(found.end(), more.begin(), more.end());
  }
  std::sort(found.begin(), found.end());
  if (found.size() * 10 > p.e.size()) found.clear();  // that many are no jumps but a rough residual
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

/// What a level is at the jumps, and what it is anywhere in the recordings that jump, each as often as it jumps.
struct AtJumps {
  std::vector<double> at, anywhere;
  void add(const Rows& level, const std::vector<std::size_t>& jumps) {
    constexpr std::size_t looks = 16;
    for (const std::size_t k : jumps) {
      at.push_back(level[k]);
      for (std::size_t i = 0; i < looks; ++i) anywhere.push_back(level[(2 * i + 1) * level.size() / (2 * looks)]);
    }
  }
};

double between(const std::vector<double>& sorted, double from, double to) {
  const auto rank = [&](double share) { return static_cast<std::size_t>(share * static_cast<double>(sorted.size())); };
  return sorted[rank(to)] - sorted[rank(from)];
}

/// Jumps that all happen at one level belong to that level, a threshold, unless it is where the signal stays anyway: a
/// room that warms in one recording stands still in those that jump.
void share_one_level(Structure& s, const Level& level, AtJumps jumps) {
  auto& [at, anywhere] = jumps;
  if (at.size() < 4) return;
  std::sort(at.begin(), at.end());
  std::sort(anywhere.begin(), anywhere.end());
  const double middle_half = between(at, 0.25, 0.75);
  if (between(anywhere, 0.1, 0.9) < 0.1 * level.span()) return;
  if (middle_half > 0.03 * level.span() || middle_half > 0.1 * between(anywhere, 0.25, 0.75)) return;
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

/// The time [s] after its start at which each recording passes the level, if it does so once and everywhere at about
/// the same one (to a twentieth of the shortest); 0 = no such thing. Noise about the level is no passing.
double one_passing(const ResidualParts& parts, std::size_t level, double at) {
  const double about = 0.02 * parts.levels()[level].span();
  double first = std::numeric_limits<double>::infinity(), last = 0, shortest = first;
  for (const auto& p : parts.list()) {
    shortest = std::min(shortest, p.duration());
    int side = 0, passings = 0;
    double when = 0;
    for (std::size_t k = 0; k < p.t.size(); ++k) {
      const double off = p.levels[level][k] - at;
      const int now = off > about ? 1 : off < -about ? -1 : side;
      if (side != 0 && now != side) ++passings, when = p.t[k] - p.t.front();
      side = now;
    }
    if (passings > 1) return 0;
    if (passings == 0) continue;
    first = std::min(first, when);
    last = std::max(last, when);
  }
  return last > 0 && last - first < shortest / 20 ? last : 0;
}

}  // namespace

std::vector<Rows> step_and_slope(const Rows& x, double at) {
  Rows step(x.size()), slope(x.size());
  for (std::size_t k = 0; k < x.size(); ++k) {
    step[k] = x[k] > at ? 1.0 : 0.0;
    slope[k] = std::max(x[k] - at, 0.0);
  }
  return {std::move(step), std::move(slope)};
}

std::optional<Structure> kink_at_level(const ResidualParts& parts, std::size_t level) {
  const Level& over = parts.levels()[level];
  const auto line = parts.whitened([&](const Part& p) {
    return std::vector<Rows>{Rows(p.levels[level].size(), 1.0), p.levels[level]};
  });
  const auto falls_at = [&](double at) {
    const auto kink = [&](const Part& p) { return step_and_slope(p.levels[level], at); };
    return parts.judged(kink, line);
  };
  // Where it is, all recordings say: it is one number.
  const auto fall_at = [&](double at) { return falls_at(at).all(); };
  const double width = over.span() / 40;
  double best = 0, fall = 0;
  for (int i = 2; i < 39; ++i)
    if (const double f = fall_at(over.lowest + i * width); f > fall) best = over.lowest + i * width, fall = f;
  // A step of many times the noise is placed to a row: half a division off, it explains half of itself. From row to row
  // the fall itself goes in steps: the next one up may lie behind one that goes down.
  for (double w = width / 2; fall > 0 && w > width / 200; w /= 2) {
    const double from = best;
    for (const int side : {-1, 1, -2, 2, -3, 3})
      if (const double f = fall_at(from + side * w); f > fall) best = from + side * w, fall = f;
  }
  if (fall <= 0) return std::nullopt;
  Structure s;
  s.kind = "kink_at_level";
  s.variable = over.name;
  s.threshold = best;
  s.has_threshold = true;
  s.unit = over.unit;
  s.passed_once_at = one_passing(parts, level, best);
  s.fall = falls_at(best);
  return s;
}

std::optional<Structure> jumps(const ResidualParts& parts) {
  Structure s;
  s.kind = "jumps";
  s.variable = "t";
  s.unit = parse_unit("s");
  std::vector<AtJumps> at_level(parts.levels().size());
  for (const auto& p : parts.list()) {
    const auto at = jumps_of(p, parts.white());
    if (at.empty()) continue;
    std::vector<std::pair<double, double>> intervals;
    for (const std::size_t k : at) {
      intervals.emplace_back(p.t[k - 1], p.t[k]);
    }
    for (std::size_t l = 0; l < at_level.size(); ++l) at_level[l].add(p.levels[l], at);
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
