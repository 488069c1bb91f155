#include "engine/analysis/poles.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/matrices/decompositions.h"
#include "engine/program/components.h"

namespace hysteron {
namespace {

constexpr double safety = 16;  // times the rounding of one operation: what n of them make of it, and more
constexpr int sweeps_allowed = 100;

/// Of a part whose states all need each other.
void add_part(Eigen::MatrixXd a, std::vector<Eigenvalue>& list) {
  if (a.rows() == 1) {
    list.push_back({a(0, 0), 0});
    return;
  }
  const Eigen::MatrixXd rows = a.transpose();
  const auto f = balancing({rows.data(), static_cast<std::size_t>(rows.size())}, static_cast<int>(a.rows()));
  const Eigen::Map<const Eigen::VectorXd> factors(f.data(), a.rows());
  a = (factors.cwiseInverse().asDiagonal() * a * factors.asDiagonal()).eval();
  const EigenPairs pairs = eigen_pairs(a);
  const Eigen::MatrixXcd left = pairs.vectors.partialPivLu().inverse();
  const double rounding = safety * std::numeric_limits<double>::epsilon() * a.norm();
  // A multiple eigenvalue has no condition: what rounding splits is as large as the root of it.
  const double most = std::sqrt(std::numeric_limits<double>::epsilon()) * a.norm();
  for (Eigen::Index i = 0; i < a.rows(); ++i) {
    const double condition = left.row(i).norm();
    const double error = rounding * condition;
    list.push_back({pairs.values(i), std::isfinite(error) ? std::min(error, most) : most});
  }
}

PoleCount count(std::span<const Eigenvalue> list, double (*distance_beyond)(std::complex<double>)) {
  PoleCount result;
  for (const auto& e : list) {
    const double distance = distance_beyond(e.value);
    if (distance > e.error)
      ++result.outside;
    else if (distance >= -e.error)
      ++result.on_the_limit;
  }
  return result;
}

}  // namespace

std::vector<double> balancing(std::span<const double> a, int n) {
  const auto size = static_cast<std::size_t>(n);
  std::vector<double> f(size, 1.0);
  bool changed = true;
  for (int sweep = 0; changed && sweep < sweeps_allowed; ++sweep) {
    changed = false;
    for (std::size_t i = 0; i < size; ++i) {
      double row = 0, column = 0;
      for (std::size_t j = 0; j < size; ++j) {
        if (j == i) continue;
        row += std::abs(a[i * size + j]) * f[j] / f[i];
        column += std::abs(a[j * size + i]) * f[i] / f[j];
      }
      if (column == 0 || row == 0) continue;
      const double factor = std::exp2(std::round(std::log2(row / column) / 2));
      if (column * factor + row / factor >= 0.95 * (column + row)) continue;
      f[i] *= factor;
      changed = true;
    }
  }
  return f;
}

std::vector<Eigenvalue> eigenvalues(std::span<const double> a, int n) {
  const auto entry = [&](int i, int j) {
    return a[static_cast<std::size_t>(i) * static_cast<std::size_t>(n) + static_cast<std::size_t>(j)];
  };
  std::vector<std::vector<int>> needs(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      if (i != j && entry(i, j) != 0) needs[static_cast<std::size_t>(i)].push_back(j);
  std::vector<Eigenvalue> list;
  for (auto part : strong_components(needs)) {
    std::sort(part.begin(), part.end());
    const auto size = static_cast<Eigen::Index>(part.size());
    Eigen::MatrixXd own(size, size);
    for (Eigen::Index i = 0; i < size; ++i)
      for (Eigen::Index j = 0; j < size; ++j)
        own(i, j) = entry(part[static_cast<std::size_t>(i)], part[static_cast<std::size_t>(j)]);
    add_part(std::move(own), list);
  }
  std::stable_sort(list.begin(), list.end(), [](const Eigenvalue& x, const Eigenvalue& y) {
    return x.value.real() != y.value.real() ? x.value.real() > y.value.real() : x.value.imag() > y.value.imag();
  });
  return list;
}

PoleCount right_of_the_axis(std::span<const Eigenvalue> list) {
  return count(list, [](std::complex<double> p) { return p.real(); });
}

PoleCount outside_the_circle(std::span<const Eigenvalue> list) {
  return count(list, [](std::complex<double> p) { return std::abs(p) - 1; });
}

}  // namespace hysteron
