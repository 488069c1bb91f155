#include "fit/signals/line_spectrum.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fit/signals/whiten.h"

namespace hysteron {
namespace {

using std::numbers::pi;
constexpr std::size_t surroundings = 101;  // frequencies over which the median is taken

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

}  // namespace

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

Spectrum spectrum_of(const std::vector<double>& rows) {
  Spectrum s;
  s.power = power_of(rows);
  s.ratio = standing_out(s.power);
  // The power of three cosines is chi-square with three degrees of freedom, its tail exp(-x/2), its median 2.37.
  s.least = 2 * std::log(1e6 * static_cast<double>(rows.size())) / 2.37;
  return s;
}

bool sharp(const std::vector<double>& power, std::size_t k) {
  double beside = 0;
  for (std::size_t j = 6; j <= 15; ++j) {
    if (k >= j) beside = std::max(beside, power[k - j]);
    if (k + j < power.size()) beside = std::max(beside, power[k + j]);
  }
  return power[k] > 10 * beside;
}

std::vector<std::size_t> peaks(const std::vector<double>& ratio, double least, std::size_t most) {
  std::vector<std::size_t> list;
  for (std::size_t k = 2; k + 2 < ratio.size(); ++k)
    if (ratio[k] > least && ratio[k] >= ratio[k - 1] && ratio[k] > ratio[k + 1]) list.push_back(k);
  std::sort(list.begin(), list.end(), [&](std::size_t a, std::size_t b) { return ratio[a] > ratio[b]; });
  if (list.size() > most) list.resize(most);
  return list;
}

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

}  // namespace hysteron
