#include "fit/wander.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace hysteron {
namespace {

constexpr double spacing = 2;            // [s] between knots
constexpr double given_away = 1.0 / 20;  // of the rows, at most
/// Of the squared length of a wave about one knot: what waves have in common to five digits (a line at a whole number
/// of half samples has no sine) is nobody's, and costs no more than a rounding error of the rest.
constexpr double in_common = 1e-10;

using Matrix = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;

/// Knots over the duration of the rows; 0: rows are too few for two.
std::size_t knots_over(std::span<const double> t, std::size_t waves) {
  if (t.empty() || !(t.back() > t.front())) return 0;
  const double most = given_away * static_cast<double>(t.size()) / static_cast<double>(waves);
  if (most < 2) return 0;
  return static_cast<std::size_t>(std::min(most, std::max(2.0, std::ceil((t.back() - t.front()) / spacing) + 1)));
}

}  // namespace

/// Of the normal equations of least squares: a band as wide as the waves of two knots.
struct LineSpan::Factor {
  /// `entries` of a square matrix of `size` columns.
  Factor(const std::vector<Eigen::Triplet<double, std::size_t>>& entries, std::size_t size) {
    const auto n = static_cast<Eigen::Index>(size);
    Matrix products(n, n);
    products.setFromTriplets(entries.begin(), entries.end());
    const double more = in_common * products.diagonal().maxCoeff();
    for (Eigen::Index j = 0; j < n; ++j) products.coeffRef(j, j) += more;
    cholesky.compute(products);
  }
  std::vector<double> solve(const std::vector<double>& b) const {
    const auto n = static_cast<Eigen::Index>(b.size());
    std::vector<double> x(b.size());
    Eigen::Map<Vector>(x.data(), n) = cholesky.solve(Eigen::Map<const Vector>(b.data(), n));
    return x;
  }
  Eigen::SimplicialLLT<Matrix, Eigen::Lower, Eigen::NaturalOrdering<int>> cholesky;
};

LineSpan::LineSpan(std::span<const double> t, const WanderingLine& line)
    : waves_(static_cast<std::size_t>(2 * line.harmonics)), knots_(knots_over(t, waves_)) {
  if (knots_ == 0) return;
  const double every = (t.back() - t.front()) / static_cast<double>(knots_ - 1);
  for (const double now : t) {
    for (std::size_t w = 0; w < waves_; ++w) {
      const double turns = static_cast<double>(w / 2 + 1) * line.frequency * now, quarter = w % 2 == 0 ? 0 : 0.25;
      wave_.push_back(std::cos(2 * std::numbers::pi * (turns - quarter)));
    }
    const double place = (now - t.front()) / every;
    knot_.push_back(std::min(static_cast<std::size_t>(place), knots_ - 2));
    beyond_.push_back(place - static_cast<double>(knot_.back()));
  }
  make_factors();
}

void LineSpan::make_factors() {
  // Products of the waves about a knot with each other, and with those about the next one.
  const std::size_t block = waves_ * waves_;
  std::vector<double> same(knots_ * block, 0.0), next(knots_ * block, 0.0), steady(block, 0.0);
  for (std::size_t i = 0; i < knot_.size(); ++i) {
    const double f = beyond_[i], before = (1 - f) * (1 - f), both = (1 - f) * f, behind = f * f;
    const double* wave = wave_.data() + i * waves_;
    for (std::size_t e = 0; e < block; ++e) {
      const double product = wave[e / waves_] * wave[e % waves_];
      same[knot_[i] * block + e] += before * product;
      next[knot_[i] * block + e] += both * product;
      same[(knot_[i] + 1) * block + e] += behind * product;
      steady[e] += product;
    }
  }
  std::vector<Eigen::Triplet<double, std::size_t>> of_moving, of_steady;
  for (std::size_t e = 0; e < block; ++e) {
    const std::size_t v = e / waves_, w = e % waves_;
    of_steady.emplace_back(v, w, steady[e]);
    for (std::size_t k = 0; k < knots_; ++k)
      of_moving.emplace_back(k * waves_ + v, k * waves_ + w, same[k * block + e]);
    for (std::size_t k = 0; k + 1 < knots_; ++k) {
      of_moving.emplace_back(k * waves_ + v, (k + 1) * waves_ + w, next[k * block + e]);
      of_moving.emplace_back((k + 1) * waves_ + w, k * waves_ + v, next[k * block + e]);
    }
  }
  moving_ = std::make_shared<const Factor>(of_moving, knots_ * waves_);
  steady_ = std::make_shared<const Factor>(of_steady, waves_);
}

void LineSpan::take_out(std::span<double> rows, Part part) const {
  if (knots_ == 0) return;
  std::vector<double> seen(knots_ * waves_, 0.0), seen_of_steady(waves_, 0.0);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    double* here = seen.data() + knot_[i] * waves_;
    for (std::size_t w = 0; w < waves_; ++w) {
      const double x = wave_[i * waves_ + w] * rows[i];
      here[w] += (1 - beyond_[i]) * x;
      here[w + waves_] += beyond_[i] * x;
      seen_of_steady[w] += x;
    }
  }
  auto amplitude = moving_->solve(seen);
  if (part == Part::wandering) {  // a steady line has one amplitude at all knots
    const auto steady = steady_->solve(seen_of_steady);
    for (std::size_t k = 0; k < amplitude.size(); ++k) amplitude[k] -= steady[k % waves_];
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double* here = amplitude.data() + knot_[i] * waves_;
    for (std::size_t w = 0; w < waves_; ++w)
      rows[i] -= wave_[i * waves_ + w] * ((1 - beyond_[i]) * here[w] + beyond_[i] * here[w + waves_]);
  }
}

}  // namespace hysteron
