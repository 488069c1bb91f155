#include "fit/numerics/column_span.h"

#include <algorithm>
#include <cmath>

namespace hysteron {
namespace {

constexpr std::size_t rows_at_once = 1024;  // a block of all columns stays in the caches

}  // namespace

ColumnSpan::ColumnSpan(const Dense& columns, std::span<const double> triangle, double tolerance) : columns_(columns) {
  const std::size_t n = columns.cols;
  for (std::size_t j = 0; j < n; ++j) kept_.push_back(j);
  for (bool again = true; again;) {
    again = false;
    triangle_ = Dense(n, kept_.size());
    length_.clear();
    for (std::size_t j = 0; j < kept_.size(); ++j) {
      const double* r = triangle.data() + kept_[j] * n;
      length_.push_back(length(r, n));
      for (std::size_t i = 0; i < n && length_[j] > 0; ++i) triangle_(i, j) = r[i] / length_[j];
    }
    triangularize(triangle_);
    for (std::size_t j = 0; j < kept_.size() && !again; ++j) {
      if (std::abs(triangle_(j, j)) > tolerance) continue;
      kept_.erase(kept_.begin() + static_cast<std::ptrdiff_t>(j));
      again = true;
    }
  }
}

/// (T'T) x = b, of columns of length one: b and x in the columns' own lengths.
void ColumnSpan::solve(std::vector<double>& b) const {
  const std::size_t k = kept_.size();
  for (std::size_t j = 0; j < k; ++j) {
    b[j] /= length_[j];
    for (std::size_t i = 0; i < j; ++i) b[j] -= triangle_(i, j) * b[i];
    b[j] /= triangle_(j, j);
  }
  for (std::size_t j = k; j-- > 0;) {
    for (std::size_t i = j + 1; i < k; ++i) b[j] -= triangle_(j, i) * b[i];
    b[j] /= triangle_(j, j);
  }
  for (std::size_t j = 0; j < k; ++j) b[j] /= length_[j];
}

std::vector<std::vector<double>> ColumnSpan::clear(std::span<double* const> list) const {
  const std::size_t k = kept_.size(), rows = columns_.rows;
  std::vector<std::vector<double>> all(list.size(), std::vector<double>(columns_.cols, 0.0));
  if (k == 0) return all;
  std::vector<std::vector<double>> taken(list.size()), seen(list.size(), std::vector<double>(k));
  for (int round = 0; round <= 2; ++round) {
    if (round > 0) {
      taken = seen;
      for (std::size_t x = 0; x < list.size(); ++x) {
        solve(taken[x]);
        for (std::size_t j = 0; j < k; ++j) all[x][kept_[j]] += taken[x][j];
      }
      for (auto& s : seen) std::fill(s.begin(), s.end(), 0.0);
    }
    for (std::size_t first = 0; first < rows; first += rows_at_once) {
      const std::size_t n = std::min(rows_at_once, rows - first);
      for (std::size_t x = 0; x < list.size(); ++x) {
        double* to = list[x] + first;
        for (std::size_t j = 0; j < k && round > 0; ++j) {
          const double* column = columns_.col(kept_[j]) + first;
          const double f = taken[x][j];
          for (std::size_t i = 0; i < n; ++i) to[i] -= f * column[i];
        }
        for (std::size_t j = 0; j < k && round < 2; ++j) seen[x][j] += dot(columns_.col(kept_[j]) + first, to, n);
      }
    }
  }
  return all;
}

}  // namespace hysteron
