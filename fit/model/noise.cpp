#include "fit/model/noise.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fit/numerics/median.h"
#include "fit/signals/branches.h"
#include "fit/signals/row_checks.h"
#include "fit/signals/whiten.h"

namespace hysteron {
namespace {

constexpr double median_of_chi_square = 0.455;  // one degree of freedom

const NoiseNote* note_of(const DataModel& model, int output) {
  const auto found = model.data().notes.find(model.outputs()[static_cast<std::size_t>(output)]);
  return found == model.data().notes.end() ? nullptr : &found->second.noise;
}

double found_resolution(const DataModel& model, int output) {
  double finest = 0;
  for (int r = 0; r < model.n_recordings(); ++r) {
    const double q = finest_step(model.measured(r, output));
    if (q > 0 && (finest == 0 || q < finest)) finest = q;
  }
  return finest;
}

NoiseOfOutput before_fit(const DataModel& model, int output) {
  NoiseOfOutput noise;
  const NoiseNote* note = note_of(model, output);
  if (note != nullptr && note->one_over_f) {
    noise.one_over_f = *note->one_over_f;
    noise.share_is_stated = true;
  }
  if (note != nullptr && note->resolution) noise.resolution = *note->resolution;
  if (note != nullptr && note->white) {
    noise.white = std::max(std::hypot(*note->white, noise.resolution / std::sqrt(12.0)), noise_floor(model, output, 0));
    noise.source = NoiseSource::data_sheet;
    return noise;
  }
  if (noise.resolution == 0) noise.resolution = found_resolution(model, output);
  std::vector<double> rough;
  for (int r = 0; r < model.n_recordings(); ++r)
    if (const Rows& rows = model.measured(r, output); rows.size() > 8) rough.push_back(roughness(rows));
  noise.white = std::max(median(rough), noise_floor(model, output, noise.resolution));
  noise.source = NoiseSource::guessed;
  noise.remark = "the data set does not say how noisy this output is: estimated from the scatter from sample to sample";
  return noise;
}

/// median(w^2) / 0.455 of whitened rows in part of the band.
double level(const std::vector<double>& w, std::size_t begin, std::size_t end) {
  std::vector<double> squares;
  for (std::size_t k = begin; k < std::min(end, w.size()); ++k) squares.push_back(w[k] * w[k]);
  return median(std::move(squares)) / median_of_chi_square;
}

/// Squares of the cosines of the slow half of residuals that were whitened as white noise, from 1 on.
struct SlowBand {
  std::size_t rows = 0;
  std::vector<double> squares;
};

/// The share of 1/f noise that residuals speak for, against a prior of what sensors have (0.3, to a factor of two). A
/// cosine that stands far out is a line or a step and no noise: it counts no more than three deviations.
double likely_share(const std::vector<SlowBand>& bands) {
  constexpr double usual = 0.3, spread = 0.7, least = 0.03, most = 1, farthest = 9;
  const auto cost = [&](double log_share) {
    const double share = std::exp(log_share);
    double sum = std::pow((log_share - std::log(usual)) / spread, 2);
    for (const auto& band : bands)
      for (std::size_t k = 0; k < band.squares.size(); ++k) {
        const double variance = coloured(static_cast<double>(k + 1), band.rows, share);
        sum += std::log(variance) + std::min(band.squares[k] / variance, farthest);
      }
    return sum;
  };
  // Capped terms may leave several valleys: a scan, then its neighbourhood.
  const double low = std::log(least), high = std::log(most);
  constexpr int steps = 36;
  double best = low, best_cost = cost(low), width = (high - low) / steps;
  for (int i = 1; i <= steps; ++i)
    if (const double c = cost(low + i * width); c < best_cost) best = low + i * width, best_cost = c;
  for (; width > 1e-3; width /= 2)
    for (const double next : {best - width / 2, best + width / 2})
      if (const double c = next < low || next > high ? best_cost : cost(next); c < best_cost)
        best = next, best_cost = c;
  return std::exp(best);
}

}  // namespace

double noise_floor(const DataModel& model, int output, double resolution) {
  return std::max({resolution / std::sqrt(12.0), 1e-9 * model.span(output), 1e-300});
}

std::string to_text(NoiseSource source) {
  switch (source) {
    case NoiseSource::data_sheet:
      return "data sheet";
    case NoiseSource::corrected:
      return "data sheet, corrected by the residual";
    case NoiseSource::estimated:
      return "estimated from the high band of the residual";
    case NoiseSource::guessed:
      break;
  }
  return "estimated from the scatter from sample to sample";
}

std::vector<double> NoiseModel::white() const {
  std::vector<double> list;
  for (const auto& o : outputs) list.push_back(o.white);
  return list;
}

NoiseModel noise_before_fit(const DataModel& model) {
  NoiseModel noise;
  for (int o = 0; o < static_cast<int>(model.outputs().size()); ++o) noise.outputs.push_back(before_fit(model, o));
  return noise;
}

NoiseModel noise_from_residual(const DataModel& model, const NoiseModel& before, const Prediction& best,
                               const std::vector<int>& recordings) {
  NoiseModel noise = before;
  for (std::size_t o = 0; o < noise.outputs.size(); ++o) {
    NoiseOfOutput& n = noise.outputs[o];
    std::vector<double> high, low;
    std::vector<SlowBand> slow;
    for (const int r : recordings) {
      const Rows& measured = model.measured(r, static_cast<int>(o));
      const auto& predicted = best.y[static_cast<std::size_t>(r)];
      if (measured.size() < 16 || predicted.empty()) continue;
      Rows residual(measured.size());
      for (std::size_t i = 0; i < residual.size(); ++i) residual[i] = measured[i] - predicted[o][i];
      const Whitener whitener(residual.size(), n.white, n.one_over_f, true);
      std::vector<double> w(whitener.size());
      whitener.apply(residual, w.data());
      high.push_back(level(w, whitener.upper_half(), w.size()));
      low.push_back(level(w, whitener.upper_half() / 8, whitener.upper_half() / 4));
      SlowBand band{residual.size(), {}};
      for (std::size_t k = 0; k < whitener.upper_half(); ++k)
        band.squares.push_back(w[k] * w[k] * coloured(static_cast<double>(k + 1), residual.size(), n.one_over_f));
      slow.push_back(std::move(band));
    }
    if (high.empty()) continue;
    double s2 = median(high);
    if (n.white_is_stated()) {
      s2 = std::clamp(s2, least_change_of_data_sheet, most_change_of_data_sheet);
      n.source = NoiseSource::corrected;
      if (!n.share_is_stated) {
        for (auto& band : slow)
          for (double& x : band.squares) x /= s2;
        n.one_over_f = likely_share(slow);
        n.share_estimated = true;
      }
    } else {
      n.source = NoiseSource::estimated;
      n.remark = "the data set does not say how noisy this output is: estimated from the high band of the residual";
      // White noise has the same level in both bands (a median of some hundred squares scatters by some per cent).
      if (median(low) > 4 * s2)
        n.remark +=
            "; the residual is smoother than its sampling (a filtered sensor, or structure), so the true noise may be "
            "larger";
    }
    n.white = std::max(n.white * std::sqrt(s2), noise_floor(model, static_cast<int>(o), n.resolution));
  }
  return noise;
}

}  // namespace hysteron
