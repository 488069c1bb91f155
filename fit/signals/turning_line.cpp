#include "fit/signals/turning_line.h"

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace hysteron {
namespace {

using std::numbers::pi;
using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

/// Steps by which the angle is followed: what is left of it is squared in each.
constexpr int rounds = 4;
constexpr double farthest = 1;  ///< [rad] in one of them: the tangent turns no further

/// Squares that a sine of this frequency takes away.
double power_at(std::span<const double> t, std::span<const double> rows, double frequency) {
  double cc = 0, cs = 0, ss = 0, c_row = 0, s_row = 0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double turn = 2 * pi * frequency * (t[i] - t.front()), c = std::cos(turn), s = std::sin(turn);
    cc += c * c;
    cs += c * s;
    ss += s * s;
    c_row += c * rows[i];
    s_row += s * rows[i];
  }
  const double determinant = cc * ss - cs * cs;
  if (!(determinant > in_common * cc * cc)) return 0;
  return (ss * c_row * c_row - 2 * cs * c_row * s_row + cc * s_row * s_row) / determinant;
}

}  // namespace

ShownSine strongest_about(std::span<const double> t, std::span<const double> rows, double frequency, double astray,
                          const std::function<bool(double)>& allowed) {
  const double apart = 1 / (t.back() - t.front());  // Rows tell frequencies apart by one over their duration.
  ShownSine best{frequency, allowed(frequency) ? power_at(t, rows, frequency) : 0};
  const auto look = [&](double at) {
    if (!allowed(at)) return;
    if (const double now = power_at(t, rows, at); now > best.squares) best = {at, now};
  };
  for (double off = apart / 4; off <= astray; off += apart / 4)
    for (const double side : {-1, 1}) look(frequency + side * off);
  for (double step = apart / 8; step > apart / 1000; step /= 2)
    for (const double from = best.frequency; const double side : {-1, 1}) look(from + side * step);
  return best;
}

double known_frequency(std::span<const double> t, std::span<const double> rows, double frequency, double white) {
  if (t.size() < 2 || rows.size() != t.size() || !(white > 0)) return 0;
  const double duration = t.back() - t.front();
  if (2 * frequency * duration > static_cast<double>(t.size() - 1)) return 0;
  const double turns = pi * duration / white;
  return power_at(t, rows, frequency) * turns * turns / 3;
}

/// Of the normal equations: a band of the knots, and the waves beside it.
struct TurningLine::Factor {
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>, Eigen::Lower, Eigen::NaturalOrdering<int>> cholesky;
};

TurningLine::TurningLine(std::span<const double> t, std::span<const double> shown, double frequency,
                         std::vector<bool> follows, std::size_t knots)
    : follows_(std::move(follows)), waves_(2 * follows_.size()), knots_(knots) {
  const double every = (t.back() - t.front()) / static_cast<double>(knots_ - 1);
  for (const double now : t) {
    phase_.push_back(2 * pi * frequency * (now - t.front()));
    const double place = (now - t.front()) / every;
    knot_.push_back(std::min(static_cast<std::size_t>(place), knots_ - 2));
    beyond_.push_back(place - static_cast<double>(knot_.back()));
  }
  wave_.resize(t.size() * waves_);
  turned_.resize(t.size());
  for (int round = 0; round < rounds; ++round) {
    settle(shown);
    follow(shown);
  }
  settle(shown);
}

/// Waves at the present phase, the amplitudes that fit best, and with these how the line turns.
void TurningLine::settle(std::span<const double> shown) {
  const auto w = static_cast<Eigen::Index>(waves_);
  Matrix products = Matrix::Zero(w, w);
  Vector seen = Vector::Zero(w);
  for (std::size_t i = 0; i < phase_.size(); ++i) {
    double* wave = wave_.data() + i * waves_;
    for (std::size_t k = 0; k < waves_; k += 2) {
      const double turn = static_cast<double>(k / 2 + 1) * phase_[i];
      wave[k] = std::cos(turn);
      wave[k + 1] = std::sin(turn);
    }
    const Eigen::Map<const Vector> here(wave, w);
    products += here * here.transpose();
    seen += here * shown[i];
  }
  products.diagonal().array() += in_common * products.diagonal().maxCoeff();
  const Vector amplitude = products.llt().solve(seen);
  double squares = 0;
  for (std::size_t i = 0; i < phase_.size(); ++i) {
    const double* wave = wave_.data() + i * waves_;
    double line = 0;
    turned_[i] = 0;
    for (std::size_t k = 0; k < waves_; k += 2) {
      const double cosine = amplitude[static_cast<Eigen::Index>(k)], sine = amplitude[static_cast<Eigen::Index>(k + 1)];
      line += cosine * wave[k] + sine * wave[k + 1];
      if (follows_[k / 2]) turned_[i] += static_cast<double>(k / 2 + 1) * (sine * wave[k] - cosine * wave[k + 1]);
    }
    squares += line * line;
  }
  rms_ = std::sqrt(squares / static_cast<double>(phase_.size()));
  // Columns of about one length: an angle is counted in turns of the line's own size.
  for (double& turned : turned_) turned /= rms_ > 0 ? rms_ : 1;
  make_factor();
}

/// Products of the columns with each other: a knot has some with itself, with the next one, and with all waves.
void TurningLine::make_factor() {
  std::vector<double> same(knots_, 0.0), next(knots_, 0.0), across(knots_ * waves_, 0.0), waves(waves_ * waves_, 0.0);
  for (std::size_t i = 0; i < phase_.size(); ++i) {
    const double* wave = wave_.data() + i * waves_;
    const double ahead = beyond_[i] * turned_[i], behind = (1 - beyond_[i]) * turned_[i];
    const std::size_t k = knot_[i];
    same[k] += behind * behind;
    same[k + 1] += ahead * ahead;
    next[k] += behind * ahead;
    for (std::size_t v = 0; v < waves_; ++v) {
      across[k * waves_ + v] += behind * wave[v];
      across[(k + 1) * waves_ + v] += ahead * wave[v];
      for (std::size_t u = 0; u <= v; ++u) waves[v * waves_ + u] += wave[v] * wave[u];
    }
  }
  std::vector<Eigen::Triplet<double>> entries;
  const auto at = [](std::size_t k) { return static_cast<int>(k); };
  for (std::size_t k = 0; k < knots_; ++k) {
    entries.emplace_back(at(k), at(k), same[k]);
    if (k + 1 < knots_) entries.emplace_back(at(k + 1), at(k), next[k]);
    for (std::size_t v = 0; v < waves_; ++v) entries.emplace_back(at(knots_ + v), at(k), across[k * waves_ + v]);
  }
  for (std::size_t v = 0; v < waves_; ++v)
    for (std::size_t u = 0; u <= v; ++u) entries.emplace_back(at(knots_ + v), at(knots_ + u), waves[v * waves_ + u]);
  const int size = at(knots_ + waves_);
  Eigen::SparseMatrix<double> normal(size, size);
  normal.setFromTriplets(entries.begin(), entries.end());
  const double more = in_common * normal.diagonal().maxCoeff();
  for (int j = 0; j < size; ++j) normal.coeffRef(j, j) += more;
  auto factor = std::make_shared<Factor>();
  factor->cholesky.compute(normal);
  factor_ = std::move(factor);
}

std::vector<double> TurningLine::fitted(std::span<const double> rows) const {
  std::vector<double> seen(knots_ + waves_, 0.0);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double turned = turned_[i] * rows[i];
    seen[knot_[i]] += (1 - beyond_[i]) * turned;
    seen[knot_[i] + 1] += beyond_[i] * turned;
    for (std::size_t v = 0; v < waves_; ++v) seen[knots_ + v] += wave_[i * waves_ + v] * rows[i];
  }
  const auto size = static_cast<Eigen::Index>(seen.size());
  std::vector<double> values(seen.size());
  Eigen::Map<Vector>(values.data(), size) = factor_->cholesky.solve(Eigen::Map<const Vector>(seen.data(), size));
  return values;
}

/// One step of Gauss and Newton: the phase goes on by the angle that the rows show.
void TurningLine::follow(std::span<const double> shown) {
  if (!(rms_ > 0)) return;
  auto angle = fitted(shown);
  // The waves hold the mean of it: a common angle of all knots is theirs.
  double mean = 0;
  for (std::size_t k = 0; k < knots_; ++k) mean += angle[k] / static_cast<double>(knots_);
  for (std::size_t k = 0; k < knots_; ++k) angle[k] = std::clamp((angle[k] - mean) / rms_, -farthest, farthest);
  for (std::size_t i = 0; i < phase_.size(); ++i)
    phase_[i] += (1 - beyond_[i]) * angle[knot_[i]] + beyond_[i] * angle[knot_[i] + 1];
}

void TurningLine::take_out(std::span<double> rows) const {
  const auto values = fitted(rows);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    double line = turned_[i] * ((1 - beyond_[i]) * values[knot_[i]] + beyond_[i] * values[knot_[i] + 1]);
    for (std::size_t v = 0; v < waves_; ++v) line += wave_[i * waves_ + v] * values[knots_ + v];
    rows[i] -= line;
  }
}

}  // namespace hysteron
