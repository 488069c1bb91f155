#include "discover/selection/seen.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "discover/models/fit_candidate_model.h"
#include "discover/models/free_numbers.h"
#include "fit/numerics/dense.h"

namespace hysteron {

Seen::Seen(const FitContext& context, const CandidateModel& of, const Diagram& diagram, double scale)
    : model_(searched_model(context, compile(diagram, *context.registry), Effort::full)),
      judge_(model_, noise_of(context, model_)),
      recordings_(train_and_validate(*context.data)),
      scale_(scale) {
  begin_as_found(of, model_);
  for (const auto& v : of.of_recordings)
    if (const auto* info = program().find_parameter(v.path); info != nullptr)
      fixed_.push_back({parameter_index(program(), v.path), v.value, v.recording});
  for (const auto& silent : silent_levels(of, program())) fixed_.push_back(silent);
  model_.choose_substeps(fixed_, noise_of(context, model_).white());
}

std::size_t Seen::rows(int recording, int output) const {
  const std::size_t measured = model_.measured(recording, output).size();
  return measured - (measured > 0 && model_.zero_per_recording(output) ? 1 : 0);
}

std::optional<Column> Seen::left(const Trial& values) {
  Trial all = fixed_;
  all.insert(all.end(), values.begin(), values.end());
  const Prediction p = model_.predict(all, recordings_);
  if (!p.ok) return std::nullopt;
  Column rows;
  for (const int r : recordings_)
    for (const double v : judge_.residual(model_, p, r)) rows.push_back(scale_ * v);
  return rows;
}

Column per_unit(const Column& before, const Column& after, double by) {
  Column change(before.size());
  for (std::size_t i = 0; i < change.size(); ++i) change[i] = (before[i] - after[i]) / by;
  return change;
}

LinearFit fit_linearly(const std::vector<Moving>& numbers, const Column& left) {
  const auto n = static_cast<Eigen::Index>(numbers.size());
  const auto inner = [](const Column& a, const Column& b) { return dot(a.data(), b.data(), a.size()); };
  Eigen::VectorXd scale(n), right(n);
  Eigen::MatrixXd normal(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Moving& a = numbers[static_cast<std::size_t>(i)];
    for (Eigen::Index k = 0; k <= i; ++k)
      normal(i, k) = normal(k, i) = inner(a.takes_away, numbers[static_cast<std::size_t>(k)].takes_away);
    normal(i, i) += a.known;
    right(i) = inner(a.takes_away, left) - a.known * a.off;
  }
  for (Eigen::Index i = 0; i < n; ++i) scale(i) = normal(i, i) > 0 ? 1 / std::sqrt(normal(i, i)) : 0;
  const Eigen::MatrixXd scaled = scale.asDiagonal() * normal * scale.asDiagonal();
  const Eigen::MatrixXd inverse = scaled.completeOrthogonalDecomposition().pseudoInverse();
  const Eigen::VectorXd values = scale.asDiagonal() * (inverse * (scale.asDiagonal() * right));
  LinearFit fit;
  for (Eigen::Index i = 0; i < n; ++i) {
    fit.value.push_back(values(i));
    fit.sigma.push_back(scale(i) * std::sqrt(std::max(inverse(i, i), 0.0)));
  }
  fit.fall = values.dot(right);
  return fit;
}

}  // namespace hysteron
