#include "fit/wander.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace hysteron {
namespace {

constexpr double spacing = 2;            // [s] between knots
constexpr double given_away = 1.0 / 20;  // of the rows, at most

/// Knots over the duration of the rows; 0: rows are too few for two.
int knots(std::span<const double> t, int harmonics) {
  const double most = given_away * static_cast<double>(t.size()) / (2 * harmonics);
  if (most < 2 || !(t.back() > t.front())) return 0;
  return static_cast<int>(std::min(most, std::max(2.0, std::ceil((t.back() - t.front()) / spacing) + 1)));
}

}  // namespace

LineColumns line_columns(std::span<const double> t, const WanderingLine& line, const Whitener& whitener) {
  const int n = t.empty() ? 0 : knots(t, line.harmonics);
  if (n == 0) return {{whitener.size(), 0}, {whitener.size(), 0}};
  const auto columns = static_cast<std::size_t>(2 * line.harmonics);
  Dense steady(whitener.size(), columns), moving(whitener.size(), columns * static_cast<std::size_t>(n));
  const double every = (t.back() - t.front()) / (n - 1);
  std::vector<double> wave(t.size()), rows(t.size());
  for (std::size_t c = 0; c < columns; ++c) {
    const double turns = static_cast<double>(c / 2 + 1) * line.frequency, quarter = c % 2 == 0 ? 0 : 0.25;
    for (std::size_t i = 0; i < t.size(); ++i) wave[i] = std::cos(2 * std::numbers::pi * (turns * t[i] - quarter));
    whitener.apply(wave, steady.col(c));
    for (int k = 0; k < n; ++k) {
      for (std::size_t i = 0; i < t.size(); ++i)
        rows[i] = wave[i] * std::max(0.0, 1 - std::abs((t[i] - t.front()) / every - k));
      whitener.apply(rows, moving.col(c * static_cast<std::size_t>(n) + static_cast<std::size_t>(k)));
    }
  }
  LineColumns line_is{orthonormal_basis(steady, 1e-8), {}};
  for (std::size_t j = 0; j < moving.cols; ++j) clear_of(line_is.steady, moving.col(j));
  line_is.wandering = orthonormal_basis(moving, 1e-6);
  return line_is;
}

}  // namespace hysteron
