#include "fit/estimate/starts.h"

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "fit/numerics/dense.h"
#include "fit/numerics/linear.h"

namespace hysteron {
namespace {

constexpr int most_steps = 20, most_halvings = 6;
constexpr double improved = 1e-6;  // of what is left
constexpr double combined = 1e-8;  // states of which the outputs show only a combination move together

/// What a recording leaves at its present start, and how each state moves that.
struct Left {
  bool ok = false;
  double chi2 = 0;
  std::vector<double> step;  ///< per free state [SI], to where it would be least if all were linear
  double fall = 0;           ///< of chi2 there
};

double sigma_of(const DataModel& model, std::size_t state) {
  const auto& sigma = model.start_sigma();
  return state < sigma.size() ? sigma[state] : std::numeric_limits<double>::infinity();
}

/// A row for each start that is held: zero is what is known of it.
void hold(const DataModel& model, int r, std::vector<double>& residual) {
  const auto& start = model.start_of(r);
  for (std::size_t k = 0; k < model.free_initial_states().size(); ++k)
    if (const double sigma = sigma_of(model, k); std::isfinite(sigma))
      residual.push_back(k < start.size() ? -start[k] / sigma : 0.0);
}

Left left_at(DataModel& model, const Judge& judge, std::span<const ParameterValue> values, int r, bool with_step) {
  Left left;
  Prediction prediction = model.predict(values, std::span<const int>(&r, 1), with_step);
  if (!prediction.ok) return left;
  auto& initial = prediction.initial[static_cast<std::size_t>(r)];
  const auto responses = std::exchange(initial, {});
  auto residual = judge.residual(model, prediction, r);
  const std::size_t rows = residual.size();
  hold(model, r, residual);
  left.ok = true;
  left.chi2 = dot(residual.data(), residual.data(), residual.size());
  if (!with_step) return left;
  Dense columns(residual.size(), responses.size());
  std::vector<double> scale;
  std::size_t row_of_held = rows;
  for (std::size_t k = 0; k < responses.size(); ++k) {
    double* column = columns.col(k);
    judge.whiten(r, responses[k], column);
    if (const double sigma = sigma_of(model, k); std::isfinite(sigma)) column[row_of_held++] = 1 / sigma;
    const double l = length(column, columns.rows);
    scale.push_back(l > 0 ? 1 / l : 0);
    for (std::size_t i = 0; i < columns.rows; ++i) column[i] *= scale[k];
  }
  NormalForm normal(static_cast<int>(columns.cols));
  normal.add(columns.a, residual);
  Dense triangle(columns.cols, columns.cols);
  triangle.a = normal.r;
  left.step = minimum_norm(triangle, normal.d, combined).x;
  std::vector<double> way(columns.rows);
  for (std::size_t k = 0; k < scale.size(); ++k)
    for (std::size_t i = 0; i < columns.rows; ++i) way[i] += left.step[k] * columns.col(k)[i];
  left.fall = dot(way.data(), way.data(), way.size());
  for (std::size_t k = 0; k < scale.size(); ++k) left.step[k] *= scale[k];
  return left;
}

std::vector<double> moved(std::vector<double> start, const std::vector<double>& step, double share) {
  start.resize(step.size(), 0.0);
  for (std::size_t k = 0; k < step.size(); ++k) start[k] += share * step[k];
  return start;
}

bool improve_one(DataModel& model, const Judge& judge, std::span<const ParameterValue> values, int r) {
  bool any = false;
  for (int step = 0; step < most_steps; ++step) {
    const auto begun = model.start_of(r);
    const Left now = left_at(model, judge, values, r, true);
    if (!now.ok || now.fall <= improved * now.chi2) return any;
    double best = now.chi2, share = 1;
    bool better = false;
    for (int halving = 0; halving <= most_halvings && !better; ++halving, share /= 2) {
      model.begin_at(r, moved(begun, now.step, share));
      const Left then = left_at(model, judge, values, r, false);
      better = then.ok && then.chi2 < best;
      if (better) best = then.chi2;
    }
    if (!better) model.begin_at(r, begun);
    if (now.chi2 - best <= improved * now.chi2) return any;
    any = true;
    // As much as a linear way promises: there is no more to be had.
    if (std::abs(now.chi2 - best - now.fall) <= improved * now.chi2) return any;
  }
  return any;
}

}  // namespace

bool improve_starts(DataModel& model, const Judge& judge, std::span<const ParameterValue> values,
                    std::span<const int> recordings) {
  if (!model.starts_are_searched()) return false;
  bool any = false;
  for (const int r : recordings)
    if (model.recording(r).initial_per_recording && model.recording(r).initial_values.empty())
      any = improve_one(model, judge, values, r) || any;
  return any;
}

}  // namespace hysteron
