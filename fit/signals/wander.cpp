#include "fit/signals/wander.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace hysteron {
namespace {

constexpr double spacing = 2;            // [s] between knots
constexpr double given_away = 1.0 / 20;  // of the rows, at most
constexpr double given_to_turn =
    1.0 / 6;                      // the same to one angle: by a twentieth, twenty seconds would be a straight line
constexpr double slowest = 10;    // periods over a recording that an expansion has not
constexpr double stands_out = 2;  // times the noise: the hundredths that a smaller line turns by are nobody's
constexpr double shows = 40;      // chi2 of a line that is there: of a thousand frequencies chance makes one of 14

constexpr double hardly = 1e-6;  // of the squared length of a wave: what is left of one that is another's

using SparseMatrix = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;

/// Knots that these rows call for.
double wanted_over(std::span<const double> t) { return std::max(2.0, std::ceil((t.back() - t.front()) / spacing) + 1); }

/// Knots over the duration of the rows, if these give so many numbers away; 0: they are too few for two knots.
std::size_t knots_over(std::span<const double> t, double numbers) {
  if (t.empty() || !(t.back() > t.front()) || numbers < 2) return 0;
  return static_cast<std::size_t>(std::min(numbers, wanted_over(t)));
}

/// Rows too coarse for a line show it at another frequency; where that is so low, what turns the line slowly is all
/// that is slow: an expansion, a drift.
bool looks_slow(std::span<const double> t, double frequency, std::size_t knots) {
  const double duration = t.back() - t.front(), step = duration / static_cast<double>(t.size() - 1);
  const double seen = std::fabs(frequency - std::round(frequency * step) / step);
  const double band = 0.5 * static_cast<double>(knots - 1) / duration;
  return seen < band + slowest / duration;
}

/// Takes a wave of length one out of the rows.
void take_out_of(std::span<double> rows, const std::vector<double>& wave) {
  const double part = std::inner_product(rows.begin(), rows.end(), wave.begin(), 0.0);
  for (std::size_t i = 0; i < wave.size(); ++i) rows[i] -= part * wave[i];
}

}  // namespace

/// Of the normal equations of least squares: a band as wide as the waves of two knots.
struct LineSpan::Factor {
  /// `entries` of a square matrix of `size` columns.
  Factor(const std::vector<Eigen::Triplet<double, std::size_t>>& entries, std::size_t size) {
    const auto n = static_cast<Eigen::Index>(size);
    SparseMatrix products(n, n);
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
  Eigen::SimplicialLLT<SparseMatrix, Eigen::Lower, Eigen::NaturalOrdering<int>> cholesky;
};

LineSpan::LineSpan(std::span<const double> t, const WanderingLine& line, const ShownLine& shown)
    : waves_(static_cast<std::size_t>(2 * line.harmonics)),
      knots_(knots_over(t, given_away * static_cast<double>(t.size()) / static_cast<double>(waves_))) {
  if (!turns(t, line, shown) && knots_ == 0) return;
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

/// Whether one angle is what the rows can follow; then it is made.
bool LineSpan::turns(std::span<const double> t, const WanderingLine& line, const ShownLine& shown) {
  std::size_t knots = knots_over(t, given_to_turn * static_cast<double>(t.size()));
  if (shown.rows.size() != t.size() || knots < 2 || 2 * static_cast<double>(knots_) >= wanted_over(t) ||
      looks_slow(t, line.frequency, knots))
    return false;
  const auto own =
      strongest_about(t, shown.rows, line.frequency, shown.astray, [&](double f) { return !looks_slow(t, f, knots); });
  if (!(own.squares > shows * shown.white * shown.white)) return false;
  const double rms = std::sqrt(own.squares / static_cast<double>(t.size()));
  if (!(rms > stands_out * shown.white)) knots = 2;  // a straight angle: its frequency
  std::vector<bool> follows;
  for (int k = 1; k <= line.harmonics; ++k) follows.push_back(!looks_slow(t, k * own.frequency, knots));
  auto turning = std::make_shared<const TurningLine>(t, shown.rows, own.frequency, std::move(follows), knots);
  turning_ = std::move(turning);
  knots_ = knots;
  return true;
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
  if (!turning_) moving_ = std::make_shared<const Factor>(of_moving, knots_ * waves_);
  steady_ = std::make_shared<const Factor>(of_steady, waves_);
  if (turning_) make_beside();
}

/// What the model's steady waves have that a line of another frequency, and a little turning of it, has not.
void LineSpan::make_beside() {
  auto beside = std::make_shared<std::vector<std::vector<double>>>();
  for (std::size_t w = 0; w < waves_; ++w) {
    std::vector<double> wave(knot_.size());
    for (std::size_t i = 0; i < wave.size(); ++i) wave[i] = wave_[i * waves_ + w];
    const double whole = std::inner_product(wave.begin(), wave.end(), wave.begin(), 0.0);
    turning_->take_out(wave);
    for (const auto& before : *beside) take_out_of(wave, before);
    const double left = std::inner_product(wave.begin(), wave.end(), wave.begin(), 0.0);
    if (!(left > hardly * whole)) continue;
    for (double& x : wave) x /= std::sqrt(left);
    beside->push_back(std::move(wave));
  }
  beside_ = std::move(beside);
}

void LineSpan::take_out_turning(std::span<double> rows, Part part) const {
  std::vector<double> steady(waves_, 0.0);
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t w = 0; w < waves_; ++w) steady[w] += wave_[i * waves_ + w] * rows[i];
  turning_->take_out(rows);
  // What the model draws is steady at a frequency that is not this recording's own: no small turning of the line.
  for (const auto& wave : *beside_) take_out_of(rows, wave);
  if (part == Part::all) return;
  const auto amplitude = steady_->solve(steady);
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t w = 0; w < waves_; ++w) rows[i] += wave_[i * waves_ + w] * amplitude[w];
}

void LineSpan::take_out(std::span<double> rows, Part part) const {
  if (knots_ == 0) return;
  if (turning_) return take_out_turning(rows, part);
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
