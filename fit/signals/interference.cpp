#include "fit/signals/interference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <numeric>

#include "fit/signals/excitation.h"
#include "fit/signals/line_spectrum.h"
#include "fit/signals/periodic_part.h"

namespace hysteron {
namespace {

using std::numbers::pi;
constexpr std::size_t shortest = 256;  // rows: fewer hold no surroundings to stand out of
constexpr double fewest_cycles = 12;   // two in each of the six parts
constexpr std::size_t parts = 6;

/// Sizes that fall evenly: what rings on its own dies away.
bool dies_away(const std::array<double, parts>& sizes) {
  constexpr double middle = (parts - 1) / 2.0, times = parts * (parts * parts - 1.0) / 12;
  double mean = 0, slope = 0, scatter = 0;
  for (std::size_t p = 0; p < parts; ++p) {
    mean += sizes[p] / parts;
    slope += sizes[p] * (static_cast<double>(p) - middle) / times;
  }
  for (std::size_t p = 0; p < parts; ++p)
    scatter += std::pow(sizes[p] - mean - slope * (static_cast<double>(p) - middle), 2) / parts;
  const double fall = -slope * (parts - 1);
  return fall > 0.2 * mean && std::sqrt(scatter) < 0.2 * fall;
}

/// One phase and one amplitude through all parts of the recording.
bool steady(const std::vector<double>& rows, double f) {
  std::complex<double> sum = 0;
  std::array<double, parts> sizes{};
  for (std::size_t p = 0; p < parts; ++p) {
    const auto a = amplitude_at(rows, p * rows.size() / parts, (p + 1) * rows.size() / parts, f);
    sizes[p] = std::abs(a);
    sum += a;
  }
  const auto [least, most] = std::minmax_element(sizes.begin(), sizes.end());
  return std::abs(sum) > 0.9 * std::accumulate(sizes.begin(), sizes.end(), 0.0) && *least > 0.5 * *most &&
         !dies_away(sizes);
}

/// Lines of the drives, and what a distorting device makes of them.
class OfDrives {
 public:
  OfDrives(const std::vector<std::span<const double>>& drives, double least) {
    for (const auto& u : drives) {
      const auto rows = without_trend(u);
      const Spectrum seen = spectrum_of(rows);
      const auto& power = seen.power;
      ratios_.push_back(seen.ratio);
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

/// Candidates of a spectrum that `explained` does not take away, steady ones, strongest first.
std::vector<SpectralLine> steady_lines(const std::vector<double>& rows, const Spectrum& seen, double step,
                                       const std::function<bool(std::size_t k)>& explained) {
  std::vector<SpectralLine> found;
  auto candidates = peaks(seen.ratio, seen.least, seen.power.size());
  // Before the strongest are taken: a strong tone has more shoulders than that.
  std::erase_if(candidates,
                [&](std::size_t k) { return static_cast<double>(k) < 2 * fewest_cycles || !sharp(seen.power, k); });
  candidates.resize(std::min<std::size_t>(candidates.size(), 12));
  for (const auto k : candidates) {
    if (explained(k)) continue;
    const double f = refined(rows, k);
    if (!steady(rows, f)) continue;
    const SpectralLine line{f / step, std::abs(amplitude_at(rows, 0, rows.size(), f)), seen.ratio[k]};
    const double apart = 4 / (static_cast<double>(rows.size()) * step);  // a line has shoulders
    if (std::none_of(found.begin(), found.end(),
                     [&](const SpectralLine& l) { return std::abs(l.frequency - line.frequency) < apart; }))
      found.push_back(line);
  }
  return found;
}

/// What drives that repeat together say of the lines of a signal: all that repeats with them is theirs.
class BesidePeriod {
 public:
  /// `period`: of all drives that repeat.
  BesidePeriod(std::span<const double> y, const std::vector<std::span<const double>>& repeating, const Period& period)
      : period_(period) {
    const auto whole = [&](std::span<const double> v) {
      return without_drift(v.subspan(period.first, period.last - period.first), period.rows);
    };
    const auto response = whole(y);
    const PeriodicPart part(response, period.rows);
    rows_ = without(response, part);
    // What a harmonic has from elsewhere is no part of what the drive makes. Of several drives nobody knows whose
    // harmonic it is.
    if (repeating.size() == 1) foreign_ = foreign_harmonics(part, PeriodicPart(whole(repeating.front()), period.rows));
    for (const auto& f : foreign_) {
      const auto excess = part.harmonic(f.order) - f.expected;
      const double turn = 2 * pi * static_cast<double>(f.order) / period.rows;
      for (std::size_t i = 0; i < rows_.size(); ++i)
        rows_[i] += std::real(excess * std::polar(1.0, turn * static_cast<double>(i)));
    }
    for (const auto& u : repeating) {
      const auto drive = whole(u);
      beside_.push_back({spectrum_of(without(drive, PeriodicPart(drive, period.rows))),
                         squares(response) / std::max(squares(drive), 1e-300)});
    }
  }
  const std::vector<double>& rows() const { return rows_; }

  /// `k` counts half a cycle of the rows.
  bool explain(std::size_t k, const Spectrum& seen) const {
    constexpr double slight = 1e-6;  // in power: what rounding leaves of a drive explains nothing
    // In half cycles. What is slow in the device's answer (creep, warming) stands as close to its harmonics.
    constexpr double near = 1.5;
    const double grid = 2 * static_cast<double>(rows_.size()) / period_.rows;
    const double order = std::round(static_cast<double>(k) / grid);
    if (std::abs(static_cast<double>(k) - order * grid) < near &&
        std::none_of(foreign_.begin(), foreign_.end(),
                     [&](const auto& f) { return static_cast<double>(f.order) == order; }))
      return true;
    for (const auto& drive : beside_)
      for (std::size_t i = k > 2 ? k - 2 : 0; i <= k + 2 && i < seen.power.size(); ++i)
        if (drive.seen.ratio[i] > drive.seen.least && drive.gain * drive.seen.power[i] > slight * seen.power[k])
          return true;
    return is_of_a_comb(k, grid, seen.power);
  }

 private:
  static std::vector<double> without(std::vector<double> rows, const PeriodicPart& part) {
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i] -= part.at_row(i);
    return rows;
  }
  /// Jumps of a device have harmonics far above half the rate of the rows. They come as lines anywhere, but many at
  /// once, as far apart as the multiples of the period.
  static bool is_of_a_comb(std::size_t k, double grid, const std::vector<double>& power) {
    constexpr double comparable = 0.01;
    constexpr std::size_t shoulders = 8;  // of the line itself
    for (int j = 1; j <= 4; ++j) {
      const auto way = static_cast<std::size_t>(std::lround(j * grid));
      if (way < shoulders) continue;
      for (std::size_t i = way - 1; i <= way + 1; ++i)
        if ((i <= k && power[k - i] > comparable * power[k]) ||
            (k + i < power.size() && power[k + i] > comparable * power[k]))
          return true;
    }
    return false;
  }
  static double squares(const std::vector<double>& rows) {
    return std::inner_product(rows.begin(), rows.end(), rows.begin(), 0.0);
  }
  /// What of a drive does not repeat, and how many times larger the signal is (in power).
  struct DriveBeside {
    Spectrum seen;
    double gain = 1;
  };
  Period period_;
  std::vector<double> rows_;
  std::vector<ForeignHarmonic> foreign_;
  std::vector<DriveBeside> beside_;
};

/// The drives that repeat, if they do so together and often enough; the others are left in `drives`.
struct Repeating {
  std::vector<std::span<const double>> drives;
  Period period;
};
Repeating take_repeating(std::vector<std::span<const double>>& drives) {
  constexpr double fewest = 4;  // of fewer, so much goes with the mean that the rest is no measure of the noise
  Repeating all;
  std::vector<std::span<const double>> others;
  for (const auto& u : drives) {
    const Period p = sharp_period(u, fewest);
    if (!p.found()) {
      others.push_back(u);
      continue;
    }
    if (!all.drives.empty() && std::abs(all.period.rows - p.rows) > 1e-3 * p.rows) return {};
    if (all.drives.empty()) all.period = p;
    all.period.first = std::max(all.period.first, p.first);
    all.period.last = std::min(all.period.last, p.last);
    all.drives.push_back(u);
  }
  if (all.drives.empty() || all.period.last <= all.period.first || all.period.count() < fewest ||
      all.period.last - all.period.first < shortest)
    return {};
  drives = others;
  return all;
}

}  // namespace

std::vector<SpectralLine> lines_of(std::span<const double> y, const std::vector<std::span<const double>>& drives,
                                   double step) {
  if (y.size() < shortest || !(step > 0)) return {};
  auto others = drives;
  const Repeating repeating = take_repeating(others);
  if (repeating.drives.empty()) {
    const auto rows = without_trend(y);
    const Spectrum seen = spectrum_of(rows);
    const OfDrives drive(drives, seen.least);
    return steady_lines(rows, seen, step, [&](std::size_t k) { return drive.explain(k, seen.least, seen.power); });
  }
  const BesidePeriod beside(y, repeating.drives, repeating.period);
  const Spectrum seen = spectrum_of(beside.rows());
  for (auto& u : others) u = u.subspan(repeating.period.first, beside.rows().size());
  const OfDrives other(others, seen.least);
  return steady_lines(beside.rows(), seen, step, [&](std::size_t k) {
    return beside.explain(k, seen) || other.explain(k, seen.least, seen.power);
  });
}

}  // namespace hysteron
