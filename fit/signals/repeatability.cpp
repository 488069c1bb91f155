#include "fit/signals/repeatability.h"

#include <algorithm>
#include <cmath>

namespace hysteron {

Repeatability between_takes(std::span<const double> a, std::span<const double> b) {
  Repeatability r;
  r.rows = std::min(a.size(), b.size());
  if (r.rows == 0) return r;
  const auto n = static_cast<double>(r.rows);
  double sum = 0, squares = 0;
  for (std::size_t i = 0; i < r.rows; ++i) sum += b[i] - a[i];
  const double offset = sum / n;
  for (std::size_t i = 0; i < r.rows; ++i) squares += std::pow(b[i] - a[i] - offset, 2);
  r.without_offset = std::sqrt(squares / n / 2);
  r.rms = std::sqrt((squares / n + offset * offset) / 2);
  return r;
}

Repeatability between_periods(std::span<const double> y, std::span<const double> u, const Period& period) {
  if (!period.found()) return {};
  const auto lag = static_cast<std::size_t>(std::lround(period.rows));
  const double part = static_cast<double>(lag) - period.rows;
  const std::size_t first = period.first + (period.count() >= 3 ? lag : 0);
  const std::size_t last = std::min(period.last, y.size());
  // Where the clock does not divide the period, the later row stands `part` of a row too late.
  const auto later = [&](std::span<const double> v, std::size_t k) {
    const double slope = k + 1 < v.size() && k > 0 ? (v[k + 1] - v[k - 1]) / 2 : 0;
    return v[k] - part * slope;
  };
  std::vector<double> before, behind, drive;
  double uu = 0, uy = 0;
  for (std::size_t i = first; i + lag < last; ++i) {
    before.push_back(y[i]);
    behind.push_back(later(y, i + lag));
    drive.push_back(later(u, i + lag) - u[i]);
    uu += drive.back() * drive.back();
    uy += drive.back() * (behind.back() - before.back());
  }
  for (std::size_t i = 0; i < behind.size() && uu > 0; ++i) behind[i] -= uy / uu * drive[i];
  return between_takes(before, behind);
}

bool same_drive(std::span<const double> a, std::span<const double> b) {
  if (a.size() != b.size() || a.empty()) return false;
  const auto [low, high] = std::minmax_element(a.begin(), a.end());
  const double allowed = 1e-3 * (*high - *low);
  double squares = 0;
  for (std::size_t i = 0; i < a.size(); ++i) squares += (a[i] - b[i]) * (a[i] - b[i]);
  return squares <= allowed * allowed * static_cast<double>(a.size());
}

}  // namespace hysteron
