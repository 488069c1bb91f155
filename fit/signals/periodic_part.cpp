#include "fit/signals/periodic_part.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace hysteron {
namespace {

/// A cubic through the four samples around a place between them; behind the last comes the first again.
double between(std::span<const double> v, double place) {
  const double below = std::floor(place), x = place - below;
  const auto n = static_cast<long>(v.size());
  const auto sample = [&](long k) { return v[static_cast<std::size_t>(((static_cast<long>(below) + k) % n + n) % n)]; };
  if (x == 0) return sample(0);
  return -x * (x - 1) * (x - 2) / 6 * sample(-1) + (x + 1) * (x - 1) * (x - 2) / 2 * sample(0) -
         (x + 1) * x * (x - 2) / 2 * sample(1) + (x + 1) * x * (x - 1) / 6 * sample(2);
}

/// By what part of a row a signal comes back earlier than after `lag` rows; where it jumps, no slope tells.
double part_of_row(std::span<const double> u, std::size_t lag) {
  const auto slope_at = [&](std::size_t i) { return (u[i + 1] - u[i - 1]) / 2; };
  const auto jumps = [&](std::size_t i) { return std::abs(u[i + 1] - 2 * u[i] + u[i - 1]) > std::abs(slope_at(i)); };
  double es = 0, ss = 0;
  for (std::size_t i = 1; i + lag + 1 < u.size(); ++i) {
    if (jumps(i) || jumps(i + lag)) continue;
    const double slope = slope_at(i + lag);
    es += (u[i + lag] - u[i]) * slope;
    ss += slope * slope;
  }
  return ss > 0 ? es / ss : 0;
}

/// Harmonics of a response and of its drive, and what the orders beside one lead to expect there.
class Orders {
 public:
  Orders(const PeriodicPart& response, const PeriodicPart& drive, std::size_t highest) {
    for (std::size_t h = 0; h <= highest; ++h) {
      response_.push_back(response.sharp_harmonic(h));
      drive_.push_back(drive.sharp_harmonic(h));
    }
    for (const auto& d : drive_) most_ = std::max(most_, std::abs(d));
    for (std::size_t h = 0; h <= highest; ++h) excited_.push_back(share_of_beside(h) > 0.1);
  }
  /// From the orders around `h`, without `left_out`; none where the drive has `h` and too few of those.
  std::optional<std::complex<double>> expected(std::size_t h, std::size_t left_out) const {
    std::vector<std::size_t> around;
    const auto look = [&](int way) {
      std::size_t found = 0;
      for (std::size_t far = 1; far <= reach && found < 2; ++far) {
        if (way < 0 && far >= h) break;
        const std::size_t at = way < 0 ? h - far : h + far;
        if (at >= excited_.size()) break;
        if (!excited_[at] || at == left_out) continue;
        around.push_back(at);
        ++found;
      }
      return found == 2;
    };
    if (!look(-1) || !look(1)) return share_of_beside(h) < 1e-3 ? std::optional(std::complex<double>{}) : std::nullopt;
    std::complex<double> ratio = 0;
    for (const auto a : around) {
      double weight = 1;
      for (const auto b : around)
        if (b != a)
          weight *=
              (static_cast<double>(h) - static_cast<double>(b)) / (static_cast<double>(a) - static_cast<double>(b));
      ratio += weight * response_[a] / drive_[a];
    }
    return ratio * drive_[h];
  }
  /// Size of what is beyond that; none as above.
  std::optional<double> excess(std::size_t h, std::size_t left_out) const {
    const auto smooth = expected(h, left_out);
    return smooth ? std::optional(std::abs(response_[h] - *smooth)) : std::nullopt;
  }
  static constexpr std::size_t reach = 4;  ///< orders on each side: two odd and two even ones

 private:
  /// Of the strongest order beside it; 0 where all that the drive has there are its last digits.
  double share_of_beside(std::size_t h) const {
    double beside = 1e-6 * most_;
    for (std::size_t j = h > reach ? h - reach : 1; j <= h + reach && j < drive_.size(); ++j)
      if (j != h) beside = std::max(beside, std::abs(drive_[j]));
    return std::abs(drive_[h]) < 1e-6 * most_ ? 0 : std::abs(drive_[h]) / beside;
  }
  double most_ = 0;
  std::vector<std::complex<double>> response_, drive_;
  std::vector<bool> excited_;
};

}  // namespace

Period sharp_period(std::span<const double> u, double fewest) {
  Period p = period_of(u);
  if (!p.found() || p.count() < fewest) return {};
  const auto rows = u.subspan(p.first, p.last - p.first);
  for (int periods = 1; periods < p.count() - 1; periods *= 2) {
    const auto lag = static_cast<std::size_t>(std::lround(periods * p.rows));
    p.rows = (static_cast<double>(lag) - part_of_row(rows, lag)) / periods;
  }
  return p;
}

std::vector<double> without_drift(std::span<const double> rows, double period) {
  const double periods = std::floor(static_cast<double>(rows.size()) / period / 2);
  const auto half = static_cast<std::size_t>(std::lround(periods * period));
  const auto mean_from = [&](std::size_t begin) {
    double sum = 0;
    for (std::size_t i = begin; i < begin + half; ++i) sum += rows[i];
    return sum / static_cast<double>(half);
  };
  std::vector<double> all(rows.begin(), rows.end());
  if (half == 0 || 2 * half > rows.size()) return all;
  const double first = mean_from(0), second = mean_from(half), slope = (second - first) / static_cast<double>(half);
  for (std::size_t i = 0; i < all.size(); ++i)
    all[i] -= (first + second) / 2 + slope * (static_cast<double>(i) - static_cast<double>(half) + 0.5);
  return all;
}

PeriodicPart::PeriodicPart(std::span<const double> rows, double period) : period_(period) {
  const auto size = static_cast<std::size_t>(std::ceil(period - 1e-3));
  if (std::abs(period - static_cast<double>(size)) < 1e-3) period_ = static_cast<double>(size);
  const auto all = static_cast<double>(rows.size());
  for (std::size_t k = 0; k < size; ++k) {
    double sum = 0, faded = 0, n = 0;
    for (double place = static_cast<double>(k) * period_ / static_cast<double>(size); place <= all - 1;
         place += period_) {
      if (place != std::floor(place) && (place < 1 || place > all - 3)) continue;  // no cubic to be had at the ends
      const double value = between(rows, place);
      sum += value;
      faded += value * std::pow(std::sin(std::numbers::pi * (place + 0.5) / all), 2);
      n += 1;
    }
    mean_.push_back(n > 0 ? sum / n : 0);
    faded_.push_back(faded * 2 * period_ / all);  // the mean of the squared sine is a half
  }
}

double PeriodicPart::at_row(std::size_t row) const {
  const double phase = std::fmod(static_cast<double>(row), period_) / period_;
  const double place = phase * static_cast<double>(mean_.size());
  const double whole = std::round(place);
  return between(mean_, std::abs(place - whole) < 1e-9 ? whole : place);
}

std::complex<double> PeriodicPart::harmonic_of(const std::vector<double>& period, std::size_t order) {
  std::complex<double> sum = 0, at = 1;
  const auto size = static_cast<double>(period.size());
  const auto turn = std::polar(1.0, -2 * std::numbers::pi * static_cast<double>(order) / size);
  for (const double v : period) {
    sum += v * at;
    at *= turn;
  }
  return 2.0 * sum / size;
}

std::vector<ForeignHarmonic> foreign_harmonics(const PeriodicPart& response, const PeriodicPart& drive) {
  constexpr std::size_t low_order = 8;
  constexpr double most_turns = 1e8;  // of what is summed: some tenths of a second
  const auto highest = static_cast<std::size_t>(std::min(static_cast<double>(response.highest_order()),
                                                         most_turns / static_cast<double>(response.highest_order())));
  std::vector<ForeignHarmonic> found;
  const Orders orders(response, drive, highest);
  for (std::size_t h = low_order + 1; h + Orders::reach <= highest; ++h) {
    const auto here = orders.excess(h, h);
    if (!here) continue;
    double beside = 0;
    for (std::size_t j = h - Orders::reach; j <= h + Orders::reach; ++j)
      if (j != h) beside = std::max(beside, orders.excess(j, h).value_or(*here));
    // A resonance of Q = 300 at this order answers 300 * 4 / h times as much as two orders further, where the next odd
    // or even one lies. Far up, too, what a device's corners make rises and falls from order to order.
    const double resonance = std::max(25.0, 1200 / static_cast<double>(h));
    if (*here > 1.3 * resonance * beside) found.push_back({h, *orders.expected(h, h)});
  }
  return found;
}

}  // namespace hysteron
