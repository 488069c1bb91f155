#include "fit/estimate/beside_calibration.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fit/numerics/levenberg_marquardt.h"

namespace hysteron {
namespace {

void calibrate(const DataModel& model, const std::vector<int>& recordings, Prediction& prediction) {
  for (std::size_t o = 0; o < model.outputs().size(); ++o) {
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    const auto each = [&](auto&& action) {
      for (const auto r : recordings) {
        auto& rows = prediction.y[static_cast<std::size_t>(r)][o];
        const Rows& measured = model.measured(r, static_cast<int>(o));
        for (std::size_t i = 0; i < std::min(rows.size(), measured.size()); ++i) action(rows[i], measured[i]);
      }
    };
    each([&](double p, double m) { n += 1, x += p, y += m; });
    if (!(n > 0)) continue;
    each([&](double p, double m) { xx += (p - x / n) * (p - x / n), xy += (p - x / n) * (m - y / n); });
    const double gain = xx > 0 && xy > 0 ? xy / xx : 1, offset = y / n - gain * x / n;
    each([&](double& p, double) { p = gain * p + offset; });
  }
}

/// The unknowns of the search: the value, or its logarithm, in steps of the size of its start.
class Unknowns {
 public:
  explicit Unknowns(const std::vector<FreeParameter>& free) : free_(free) {
    for (const auto& f : free) {
      const bool bounded = std::isfinite(f.lower) && std::isfinite(f.upper);
      const double size = f.start != 0 ? std::abs(f.start) : bounded ? f.upper - f.lower : 1;
      sizes_.push_back(f.log_scale || !(size > 0) ? 1 : size);
    }
  }
  double to_unknown(std::size_t i, double value) const {
    if (!free_[i].log_scale) return value / sizes_[i];
    return value > 0 ? std::log(value) : -std::numeric_limits<double>::infinity();
  }
  std::vector<double> starts() const {
    return each(
        [&](std::size_t i) { return to_unknown(i, std::clamp(free_[i].start, free_[i].lower, free_[i].upper)); });
  }
  std::vector<double> lower() const {
    return each([&](std::size_t i) { return to_unknown(i, free_[i].lower); });
  }
  std::vector<double> upper() const {
    return each([&](std::size_t i) { return to_unknown(i, free_[i].upper); });
  }
  /// No step goes further than a linearization can be believed: a factor of two.
  std::vector<double> largest_step() const {
    return each(
        [&](std::size_t i) { return free_[i].log_scale ? std::log(2.0) : std::max(1.0, std::abs(starts()[i])); });
  }
  Trial values(std::span<const double> z) const {
    Trial trial;
    for (std::size_t i = 0; i < free_.size(); ++i) {
      const double value = free_[i].log_scale ? std::exp(z[i]) : z[i] * sizes_[i];
      trial.push_back({free_[i].parameter, std::clamp(value, free_[i].lower, free_[i].upper), free_[i].recording});
    }
    return trial;
  }

 private:
  template <class F>
  std::vector<double> each(F&& f) const {
    std::vector<double> list;
    for (std::size_t i = 0; i < free_.size(); ++i) list.push_back(f(i));
    return list;
  }
  const std::vector<FreeParameter>& free_;
  std::vector<double> sizes_;
};

class Search {
 public:
  Search(DataModel& model, const Judge& judge, const std::vector<FreeParameter>& free, const std::vector<int>& judged)
      : model_(model), judge_(judge), unknowns_(free), judged_(judged) {}

  Trial run() {
    constexpr int trials = 30;
    constexpr double tolerance = 1e-3;  // a hundredth of what is worth a word
    LeastSquares problem;
    problem.lower = unknowns_.lower();
    problem.upper = unknowns_.upper();
    problem.largest_step = unknowns_.largest_step();
    problem.residual = [&](std::span<const double> z, std::vector<double>& r) { return residual(z, r); };
    problem.jacobian = [&](std::span<const double> z, Dense& columns) { return jacobian(z, columns); };
    return unknowns_.values(minimize(problem, unknowns_.starts(), trials, tolerance).z);
  }

 private:
  bool residual(std::span<const double> z, std::vector<double>& all) {
    const Prediction prediction = calibrated(model_, unknowns_.values(z), judged_);
    all.clear();
    if (!prediction.ok) return false;
    for (const int r : judged_) {
      const auto rows = judge_.residual(model_, prediction, r);
      all.insert(all.end(), rows.begin(), rows.end());
    }
    return std::all_of(all.begin(), all.end(), [](double x) { return std::isfinite(x); });
  }

  /// By differences of 1e-3: far above the rounding of a simulation, far below what bends.
  bool jacobian(std::span<const double> z, Dense& columns) {
    constexpr double far = 1e-3;
    std::vector<double> here, there;
    if (!residual(z, here)) return false;
    columns = Dense(here.size(), z.size());
    const auto upper = unknowns_.upper();
    for (std::size_t k = 0; k < z.size(); ++k) {
      std::vector<double> beside(z.begin(), z.end());
      const double step = z[k] + far > upper[k] ? -far : far;
      beside[k] += step;
      if (!residual(beside, there)) return false;
      for (std::size_t i = 0; i < here.size(); ++i) columns(i, k) = (there[i] - here[i]) / step;
    }
    return true;
  }

  DataModel& model_;
  const Judge& judge_;
  Unknowns unknowns_;
  const std::vector<int>& judged_;
};

}  // namespace

Prediction calibrated(DataModel& model, const std::vector<ParameterValue>& values, const std::vector<int>& recordings) {
  Prediction prediction = model.predict(values, recordings, false);
  if (prediction.ok) calibrate(model, recordings, prediction);
  return prediction;
}

BestPrediction best_beside_calibration(DataModel& model, const Judge& judge, const std::vector<FreeParameter>& free,
                                       const std::vector<int>& recordings) {
  BestPrediction best;
  for (const auto& f : free) best.values.push_back({f.parameter, f.start, f.recording});
  best.prediction = calibrated(model, best.values, recordings);
  if (!best.prediction.ok || free.empty()) return best;
  const Trial found = Search(model, judge, free, recordings).run();
  Prediction there = calibrated(model, found, recordings);
  const Score before = judge.score(model, best.prediction, recordings), after = judge.score(model, there, recordings);
  if (there.ok && after.ok && !(after.chi2() > before.chi2())) best = {found, std::move(there)};
  return best;
}

}  // namespace hysteron
