#include "fit/model/colour.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hysteron {
namespace {

constexpr double most_share = 10;  // beyond, it is no sensor's noise but what the model lacks

/// Coefficients that share their weight: of one output on one recording.
struct Band {
  int output = 0;        ///< -1: rows of priors, whose weight is known
  double k = 0;          ///< mean index of the cosine
  std::size_t rows = 0;  ///< of the recording
  double share = 0;      ///< with which they were whitened
  double count = 0;
  Dense products;  ///< [J r]' [J r], whitened as they were
};

class Likelihood {
 public:
  Likelihood(const DataModel& model, const Judge& judge, const Neighbourhood& around)
      : n_outputs_(model.outputs().size()), p_(around.jacobian.cols), counts_(n_outputs_, 0.0) {
    scale_columns(around);
    std::size_t row = 0;
    for (const int r : around.recordings) {
      const double weight = std::sqrt(model.recording(r).weight);
      for (std::size_t o = 0; o < n_outputs_; ++o) {
        const auto& noise = judge.noise().outputs[o];
        const std::size_t rows = model.measured(r, static_cast<int>(o)).size();
        const std::size_t first = model.zero_per_recording(static_cast<int>(o)) ? 1 : 0;
        for (std::size_t k = first; k < rows;) {
          // One by one where the colour is steep, then a tenth of an octave.
          const std::size_t end =
              std::min(rows, std::max(k + 1, static_cast<std::size_t>(static_cast<double>(k) * 1.07)));
          Band band{static_cast<int>(o), 0.5 * static_cast<double>(k + end - 1), rows,
                    noise.one_over_f,    static_cast<double>(end - k),           {}};
          band.products = products(around, row, row + (end - k), weight);
          counts_[o] += band.count;
          bands_.push_back(std::move(band));
          row += end - k;
          k = end;
        }
      }
    }
    if (row < around.residual.size()) {
      Band priors{-1, 0, 1, 0, static_cast<double>(around.residual.size() - row), {}};
      priors.products = products(around, row, around.residual.size(), 1);
      bands_.push_back(std::move(priors));
    }
    find_independent();
  }

  double count(std::size_t output) const { return counts_[output]; }
  double parameters() const { return static_cast<double>(kept_.size()); }

  /// -2 ln L at these shares; `level` (variance over the one that was used in whitening) is improved on the way, within
  /// its limits.
  double operator()(const std::vector<double>& share, std::vector<double>& level, const std::vector<double>& least,
                    const std::vector<double>& most) const {
    double value = 0;
    for (int pass = 0; pass < 3; ++pass) {
      std::vector<double> error;
      value = evaluate(share, level, error);
      double all = 0;
      for (const double c : counts_) all += c;
      for (std::size_t o = 0; o < n_outputs_; ++o) {
        const double freedom = counts_[o] * (1 - std::min(0.9, parameters() / std::max(1.0, all)));
        if (freedom > 0) level[o] = std::clamp(level[o] * error[o] / freedom, least[o], most[o]);
      }
    }
    return value;
  }

 private:
  void scale_columns(const Neighbourhood& around) {
    for (std::size_t j = 0; j < p_; ++j) {
      const double l = length(around.jacobian.col(j), around.jacobian.rows);
      scale_.push_back(l > 0 ? 1 / l : 0);
    }
  }

  Dense products(const Neighbourhood& around, std::size_t begin, std::size_t end, double weight) const {
    Dense g(p_ + 1, p_ + 1);
    const auto column = [&](std::size_t j) {
      return (j < p_ ? around.jacobian.col(j) : around.residual.data()) + begin;
    };
    for (std::size_t i = 0; i <= p_; ++i)
      for (std::size_t j = 0; j <= i; ++j) {
        const double f = (i < p_ ? scale_[i] : 1) * (j < p_ ? scale_[j] : 1) / (weight * weight);
        g(i, j) = g(j, i) = f * dot(column(i), column(j), end - begin);
      }
    return g;
  }

  /// Columns that others explain are left out, for all shares alike.
  void find_independent() {
    Dense sum(p_ + 1, p_ + 1);
    for (const auto& band : bands_)
      for (std::size_t i = 0; i < sum.a.size(); ++i) sum.a[i] += band.products.a[i];
    // Cholesky; what is left of a diagonal of one tells how much is its own.
    Dense l(p_, p_);
    for (std::size_t j = 0; j < p_; ++j) {
      double rest = sum(j, j);
      std::vector<double> row;
      for (const std::size_t i : kept_) {
        double x = sum(j, i);
        for (std::size_t k = 0; k < row.size(); ++k) x -= row[k] * l(i, k);
        row.push_back(x / l(i, row.size()));
        rest -= row.back() * row.back();
      }
      if (!(rest > 1e-9 * sum(j, j)) || sum(j, j) == 0) continue;
      for (std::size_t k = 0; k < row.size(); ++k) l(j, k) = row[k];
      l(j, row.size()) = std::sqrt(rest);
      kept_.push_back(j);
    }
  }

  /// -2 ln L and, per output, r' V^-1 r.
  double evaluate(const std::vector<double>& share, const std::vector<double>& level,
                  std::vector<double>& error) const {
    const std::size_t m = kept_.size();
    Dense sum(m + 1, m + 1);
    std::vector<double> factor;
    double value = 0;
    for (const auto& band : bands_) {
      double variance = 1;
      if (band.output >= 0) {
        const auto o = static_cast<std::size_t>(band.output);
        variance = level[o] * coloured(band.k, band.rows, share[o]) / coloured(band.k, band.rows, band.share);
        value += band.count * std::log(variance);
      }
      factor.push_back(1 / variance);
      for (std::size_t i = 0; i <= m; ++i)
        for (std::size_t j = 0; j <= i; ++j)
          sum(i, j) += factor.back() * band.products(i < m ? kept_[i] : p_, j < m ? kept_[j] : p_);
    }
    // Cholesky in place; the last pivot is what no change of the parameters takes away.
    for (std::size_t j = 0; j <= m; ++j) {
      for (std::size_t i = j; i <= m; ++i) {
        for (std::size_t k = 0; k < j; ++k) sum(i, j) -= sum(i, k) * sum(j, k);
        if (i == j && j < m) sum(j, j) = std::sqrt(std::max(sum(j, j), 1e-300));
        if (i > j) sum(i, j) /= sum(j, j);
      }
      if (j < m) value += 2 * std::log(sum(j, j));
    }
    value += std::max(0.0, sum(m, m));
    // The change of the parameters that this weighting asks for, and the error that it leaves in each output.
    std::vector<double> step(p_ + 1, 0.0);
    step[p_] = 1;
    for (std::size_t j = m; j-- > 0;) {
      double x = -sum(m, j);
      for (std::size_t k = j + 1; k < m; ++k) x -= sum(k, j) * step[kept_[k]];
      step[kept_[j]] = x / sum(j, j);
    }
    error.assign(n_outputs_, 0.0);
    for (std::size_t b = 0; b < bands_.size(); ++b) {
      if (bands_[b].output < 0) continue;
      double e = 0;
      for (std::size_t i = 0; i <= p_; ++i)
        for (std::size_t j = 0; j <= p_; ++j) e += step[i] * bands_[b].products(i, j) * step[j];
      error[static_cast<std::size_t>(bands_[b].output)] += factor[b] * e;
    }
    return value;
  }

  std::size_t n_outputs_, p_;
  std::vector<double> counts_, scale_;
  std::vector<Band> bands_;
  std::vector<std::size_t> kept_;  ///< columns that are independent
};

/// Least value of a function of one share over a grid, then by golden section between the neighbours of the best.
template <class F>
double best_share(const F& value_at) {
  std::vector<double> grid{0};
  for (double a = 0.03; a < most_share * 1.01; a *= 1.35) grid.push_back(std::min(a, most_share));
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < grid.size(); ++i)
    if (const double v = value_at(grid[i]); v < least) least = v, best = i;
  double low = grid[best > 0 ? best - 1 : 0], high = grid[std::min(best + 1, grid.size() - 1)];
  constexpr double golden = 0.6180339887498949;
  for (int i = 0; i < 12; ++i) {
    const double a = high - golden * (high - low), b = low + golden * (high - low);
    (value_at(a) < value_at(b) ? high : low) = value_at(a) < value_at(b) ? b : a;
  }
  const double refined = 0.5 * (low + high);
  return value_at(refined) < least ? refined : grid[best];
}

}  // namespace

NoiseModel noise_from_likelihood(const DataModel& model, const Judge& judge, const Neighbourhood& around) {
  NoiseModel noise = judge.noise();
  const std::size_t n = noise.outputs.size();
  const Likelihood likelihood(model, judge, around);
  std::vector<double> share(n), level(n, 1.0), least(n, 1e-12), most(n, 1e12);
  for (std::size_t o = 0; o < n; ++o) {
    share[o] = noise.outputs[o].one_over_f;
    if (!noise.outputs[o].white_is_stated()) continue;
    least[o] = least_change_of_data_sheet;
    most[o] = most_change_of_data_sheet;
  }
  std::vector<bool> estimated(n, false);
  for (int sweep = 0; sweep < (n > 1 ? 2 : 1); ++sweep)
    for (std::size_t o = 0; o < n; ++o) {
      if (noise.outputs[o].share_is_stated || likelihood.count(o) < 32 + likelihood.parameters()) continue;
      estimated[o] = true;
      share[o] = best_share([&](double a) {
        auto shares = share;
        auto levels = level;
        shares[o] = a;
        return likelihood(shares, levels, least, most);
      });
    }
  likelihood(share, level, least, most);
  for (std::size_t o = 0; o < n; ++o) {
    NoiseOfOutput& of = noise.outputs[o];
    if (likelihood.count(o) < 32 + likelihood.parameters()) continue;
    of.white = std::max(of.white * std::sqrt(level[o]), noise_floor(model, static_cast<int>(o), of.resolution));
    of.source = of.white_is_stated() ? NoiseSource::corrected : NoiseSource::estimated;
    of.one_over_f = share[o];
    of.share_estimated = estimated[o];
    of.remark = of.white_is_stated()
                    ? ""
                    : "the data set does not say how noisy this output is: estimated from the residual of the best fit";
  }
  return noise;
}

std::vector<double> row_variances(const DataModel& model, const Judge& judge, const NoiseModel& noise,
                                  const std::vector<int>& recordings) {
  std::vector<double> variances;
  for (const int r : recordings)
    for (std::size_t o = 0; o < noise.outputs.size(); ++o) {
      const auto &before = judge.noise().outputs[o], &now = noise.outputs[o];
      const std::size_t rows = model.measured(r, static_cast<int>(o)).size();
      const double level = model.recording(r).weight * now.white * now.white / (before.white * before.white);
      for (std::size_t k = model.zero_per_recording(static_cast<int>(o)) ? 1 : 0; k < rows; ++k)
        variances.push_back(level * coloured(static_cast<double>(k), rows, now.one_over_f) /
                            coloured(static_cast<double>(k), rows, before.one_over_f));
    }
  return variances;
}

}  // namespace hysteron
