#include "fit/interference.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "fit/excitation.h"
#include "fit/whiten.h"

namespace hysteron {
namespace {

constexpr double pi = std::numbers::pi;
constexpr std::size_t shortest = 256;      // rows: fewer hold no surroundings to stand out of
constexpr std::size_t surroundings = 101;  // frequencies over which the median is taken
constexpr double fewest_cycles = 12;       // two in each of the six parts
constexpr std::size_t parts = 6;

/// Rows without mean and straight line, so that a drift does not hide what is low.
std::vector<double> without_trend(std::span<const double> y) {
  const auto n = static_cast<double>(y.size());
  double mean = 0, slope = 0;
  for (const double v : y) mean += v / n;
  for (std::size_t i = 0; i < y.size(); ++i) slope += (y[i] - mean) * (static_cast<double>(i) - (n - 1) / 2);
  slope /= n * (n * n - 1) / 12;
  std::vector<double> rows(y.size());
  for (std::size_t i = 0; i < y.size(); ++i) rows[i] = y[i] - mean - slope * (static_cast<double>(i) - (n - 1) / 2);
  return rows;
}

/// Power around each frequency k / (2 n step), k = 0 .. n - 1: three neighbouring cosines of the windowed rows.
std::vector<double> power_of(std::span<const double> rows) {
  const std::size_t n = rows.size();
  std::vector<double> c(n), power(n, 0.0);
  for (std::size_t i = 0; i < n; ++i)
    c[i] = rows[i] * std::pow(std::sin(pi * (static_cast<double>(i) + 0.5) / static_cast<double>(n)), 2);
  cosine_transform(c);
  for (std::size_t k = 1; k + 1 < n; ++k) power[k] = c[k - 1] * c[k - 1] + c[k] * c[k] + c[k + 1] * c[k + 1];
  return power;
}

/// Power over the median of its block of frequencies and of the two blocks beside it.
std::vector<double> standing_out(const std::vector<double>& power) {
  const std::size_t blocks = std::max<std::size_t>(1, power.size() / surroundings);
  std::vector<double> usual(blocks);
  for (std::size_t b = 0; b < blocks; ++b) {
    const std::size_t begin = b * power.size() / blocks, end = (b + 1) * power.size() / blocks;
    std::vector<double> part(power.begin() + static_cast<std::ptrdiff_t>(begin),
                             power.begin() + static_cast<std::ptrdiff_t>(end));
    const auto middle = part.begin() + static_cast<std::ptrdiff_t>(part.size() / 2);
    std::nth_element(part.begin(), middle, part.end());
    usual[b] = *middle;
  }
  std::vector<double> ratio(power.size(), 0.0);
  for (std::size_t k = 1; k + 1 < power.size(); ++k) {
    const std::size_t b = std::min(blocks - 1, k * blocks / power.size());
    const double around = std::max({usual[b], usual[b > 0 ? b - 1 : b], usual[std::min(b + 1, blocks - 1)]});
    ratio[k] = around > 0 ? power[k] / around : 0;
  }
  return ratio;
}

/// A line is a few frequencies wide; what still rings, or what a resonance makes of a dense drive, is wider.
bool sharp(const std::vector<double>& power, std::size_t k) {
  double beside = 0;
  for (std::size_t j = 6; j <= 15; ++j) {
    if (k >= j) beside = std::max(beside, power[k - j]);
    if (k + j < power.size()) beside = std::max(beside, power[k + j]);
  }
  return power[k] > 10 * beside;
}

/// Largest ratios that are peaks, as k, largest first.
std::vector<std::size_t> peaks(const std::vector<double>& ratio, double least, std::size_t most) {
  std::vector<std::size_t> list;
  for (std::size_t k = 2; k + 2 < ratio.size(); ++k)
    if (ratio[k] > least && ratio[k] >= ratio[k - 1] && ratio[k] > ratio[k + 1]) list.push_back(k);
  std::sort(list.begin(), list.end(), [&](std::size_t a, std::size_t b) { return ratio[a] > ratio[b]; });
  if (list.size() > most) list.resize(most);
  return list;
}

/// Amplitude and phase of exp(2 pi i f row) over rows [begin, end), windowed.
std::complex<double> amplitude_at(const std::vector<double>& rows, std::size_t begin, std::size_t end, double f) {
  std::complex<double> sum = 0, turn = std::polar(1.0, -2 * pi * f),
                       at = std::polar(1.0, -2 * pi * f * static_cast<double>(begin));
  double weight = 0;
  const auto n = static_cast<double>(end - begin);
  for (std::size_t i = begin; i < end; ++i) {
    const double w = std::pow(std::sin(pi * (static_cast<double>(i - begin) + 0.5) / n), 2);
    sum += w * rows[i] * at;
    weight += w;
    at *= turn;
  }
  return 2.0 * sum / weight;
}

/// The frequency [1/row] of a peak, sharper than the grid of cosines.
double refined(const std::vector<double>& rows, std::size_t k) {
  const double grid = 0.5 / static_cast<double>(rows.size());
  double f = static_cast<double>(k) * grid, width = 1.5 * grid;
  for (int round = 0; round < 6; ++round) {
    double best = f, most = -1;
    for (int j = -4; j <= 4; ++j) {
      const double tried = f + j * width / 4;
      if (const double a = std::abs(amplitude_at(rows, 0, rows.size(), tried)); a > most) {
        most = a;
        best = tried;
      }
    }
    f = best;
    width /= 3;
  }
  return f;
}

/// One phase and one amplitude through all parts of the recording.
bool steady(const std::vector<double>& rows, double f) {
  std::complex<double> sum = 0;
  double sizes = 0, least = 0, most = 0;
  for (std::size_t p = 0; p < parts; ++p) {
    const auto a = amplitude_at(rows, p * rows.size() / parts, (p + 1) * rows.size() / parts, f);
    const double size = std::abs(a);
    least = p == 0 ? size : std::min(least, size);
    most = std::max(most, size);
    sizes += size;
    sum += a;
  }
  return std::abs(sum) > 0.9 * sizes && least > 0.5 * most;
}

/// Lines of the drives, and what a distorting device makes of them.
class OfDrives {
 public:
  OfDrives(const std::vector<std::span<const double>>& drives, double least) {
    for (const auto& u : drives) {
      const auto rows = without_trend(u);
      const auto power = power_of(rows);
      ratios_.push_back(standing_out(power));
      // All lines of a drive that has few; of a broad one those that stand out.
      const auto high = peaks(power, 1e-4 * *std::max_element(power.begin(), power.end()), 40);
      const bool few = holds_most(power, high, few_lines, 0.9);
      const double cycles = 2 * static_cast<double>(u.size());  // k of one cycle per row
      const double tone = holds_most(power, high, 1, 0.75) ? cycles * refined(rows, high.front()) : 0;
      for (std::size_t i = 0; i < high.size(); ++i)
        if (few && i < few_lines)
          lines_.push_back({cycles * refined(rows, high[i]), tone});
        else if (ratios_.back()[high[i]] > least)
          lines_.push_back({static_cast<double>(high[i]), tone});
      if (const Period p = period_of(u); p.found()) grids_.push_back({cycles / p.rows, tone});
    }
  }
  /// `k` counts half a cycle per recording, `power` is that of the measured signal. Aliases of harmonics are not looked
  /// for: they are weak.
  bool explain(std::size_t at, double least, const std::vector<double>& power) const {
    const auto k = static_cast<double>(at);
    const auto near = [&](double other) { return std::abs(k - std::abs(other)) < width; };
    for (const auto& ratio : ratios_)
      for (int j = -2; j <= 2; ++j)
        if (const auto i = static_cast<std::size_t>(std::max(0.0, k + j)); i < ratio.size() && ratio[i] > least)
          return true;
    for (const auto& [grid, tone] : grids_)
      if (std::abs(k / grid - std::round(k / grid)) * grid < width && !alone(at, tone, power)) return true;
    for (const auto& [a, tone] : lines_) {
      // Each multiple is known as sharply as the line itself, times its order.
      const double order = std::round(k / a);
      if (order >= 1 && order < 60 && std::abs(k - order * a) < std::max(width, 0.5 * order) && !alone(at, tone, power))
        return true;
      for (const auto& [b, other_tone] : lines_)
        if (near(a + b) || near(a - b) || near(2 * a + b) || near(2 * a - b)) return true;
    }
    return false;
  }

 private:
  static constexpr std::size_t few_lines = 3;
  /// A line of a drive or the frequency of its period, and the tone that is most of that drive; 0 = there is none.
  struct Line {
    double k = 0, tone = 0;
  };
  /// Whatever bends a tone, its harmonics fall with their order, or rise and fall about a resonance: a strong one has
  /// neighbours, at the least the next odd or the next even ones. A multiple of high order that towers over all of them
  /// comes from elsewhere.
  static bool alone(std::size_t k, double tone, const std::vector<double>& power) {
    constexpr double low_order = 8;  // up to here a bend of few powers makes a single harmonic
    constexpr double towers = 1000;  // in power; a resonance of Q = 300 at the 50th multiple leaves a 576th two further
    constexpr int neighbours = 4;    // two odd and two even ones
    constexpr std::size_t apart = 8;   // beyond the shoulders of the line itself
    constexpr std::size_t beside = 1;  // a multiple lies between two frequencies
    if (!(tone > 0) || static_cast<double>(k) <= low_order * tone) return false;
    const int first = std::max(1, static_cast<int>(std::ceil(static_cast<double>(apart) / tone)));
    // Near the end of the spectrum lie aliases, whose neighbours are folded to other places.
    if (static_cast<double>(k) + (first + neighbours) * tone > static_cast<double>(power.size())) return false;
    double most = 0;
    for (int j = first; j < first + neighbours; ++j) {
      const auto way = static_cast<std::size_t>(std::lround(j * tone));
      for (std::size_t i = way - beside; i <= way + beside; ++i)
        most = std::max({most, i <= k ? power[k - i] : 0, k + i < power.size() ? power[k + i] : 0});
    }
    return power[k] > towers * most;
  }
  /// So many of the strongest lines, with their shoulders, hold this share of the power.
  static bool holds_most(const std::vector<double>& power, const std::vector<std::size_t>& high, std::size_t lines,
                         double share) {
    double all = 0, held = 0;
    for (std::size_t k = 0; k < power.size(); ++k) {
      all += power[k];
      for (std::size_t i = 0; i < std::min(lines, high.size()); ++i)
        if (k + 6 > high[i] && k < high[i] + 6) {
          held += power[k];
          break;
        }
    }
    return held > share * all;
  }
  static constexpr double width = 5;  // of a windowed line, in half cycles per recording
  std::vector<std::vector<double>> ratios_;
  std::vector<Line> lines_, grids_;
};

}  // namespace

std::vector<SpectralLine> lines_of(std::span<const double> y, const std::vector<std::span<const double>>& drives,
                                   double step) {
  std::vector<SpectralLine> found;
  if (y.size() < shortest || !(step > 0)) return found;
  const auto rows = without_trend(y);
  const auto power = power_of(rows);
  const auto ratio = standing_out(power);
  // The power of three cosines is chi-square with three degrees of freedom, its tail exp(-x/2), its median 2.37.
  const double least = 2 * std::log(1e6 * static_cast<double>(y.size())) / 2.37;
  auto candidates = peaks(ratio, least, power.size());
  // Before the strongest are taken: a strong tone has more shoulders than that.
  std::erase_if(candidates,
                [&](std::size_t k) { return static_cast<double>(k) < 2 * fewest_cycles || !sharp(power, k); });
  candidates.resize(std::min<std::size_t>(candidates.size(), 12));
  if (candidates.empty()) return found;
  const OfDrives drive(drives, least);
  for (const auto k : candidates) {
    if (drive.explain(k, least, power)) continue;
    const double f = refined(rows, k);
    if (!steady(rows, f)) continue;
    const SpectralLine line{f / step, std::abs(amplitude_at(rows, 0, rows.size(), f)), ratio[k]};
    const double apart = 4 / (static_cast<double>(y.size()) * step);  // a line has shoulders
    if (std::none_of(found.begin(), found.end(),
                     [&](const SpectralLine& l) { return std::abs(l.frequency - line.frequency) < apart; }))
      found.push_back(line);
  }
  return found;
}

}  // namespace hysteron
