#include <algorithm>
#include <cmath>
#include <utility>

#include "fit/estimate/projection.h"
#include "fit/numerics/column_span.h"

namespace hysteron {

bool Projection::jacobian(const ProjectedPoint& point, bool central, Dense& columns) {
  const auto low = lower(), high = upper();
  const std::size_t m = nonlinear_.size();
  columns = Dense(rows_, m);
  // BDF's own error is noise of its tolerance between two neighbouring trials; the exact advance has rounding only.
  const bool exact = model_.why_not_exact().empty();
  const double relative = exact ? (central ? 1e-4 : 1e-6) : (central ? 3e-3 : 1e-3);

  /// Where the residual of one side is known: at first here alone, for both sides.
  struct Side {
    double z = 0;
    bool moved = false;
    std::vector<double> residual;
  };
  std::vector<Side> above(m), below(m);
  std::vector<double> step(m);
  for (std::size_t k = 0; k < m; ++k) {
    const auto& f = free_[static_cast<std::size_t>(nonlinear_[k])];
    above[k].z = below[k].z = point.z[k];
    double size = f.log_scale ? 1.0 : std::max(std::abs(point.z[k]), 0.01 * std::abs(f.start));
    if (size == 0) size = std::isfinite(high[k] - low[k]) ? 0.01 * (high[k] - low[k]) : 1.0;
    step[k] = relative * size;
  }
  const auto recording_of = [&](std::size_t k) { return free_[static_cast<std::size_t>(nonlinear_[k])].recording; };
  // One side of all parameters that `choose` picks, in one go. Sides that cannot be simulated stay here.
  const auto move = [&](std::vector<Side>& sides, double sign, const auto& choose) {
    std::vector<Wanted> wanted;
    std::vector<std::size_t> parameter;
    for (std::size_t k = 0; k < m; ++k) {
      if (!choose(k)) continue;
      auto z = point.z;
      z[k] = std::clamp(point.z[k] + sign * step[k], low[k], high[k]);
      if (z[k] == point.z[k]) continue;
      sides[k].z = z[k];
      sides[k].moved = touches_any(recording_of(k));
      sides[k].residual = point.residual;
      prior_rows(z, point.theta, sides[k].residual.data() + data_rows_);
      wanted.push_back({values(z, point.theta), recording_of(k)});
      parameter.push_back(k);
    }
    simulate(wanted, [&](std::size_t i, std::size_t r, const Prediction& prediction) {
      Side& side = sides[parameter[i]];
      if (!prediction.ok) side.z = point.z[parameter[i]];
      side.moved = side.moved && prediction.ok;
      if (!side.moved) return;
      whiten_residual(prediction, r, side.residual.data() + begin_[r]);
      if (!point.initial_basis.empty()) clear_of(point.initial_basis[r], side.residual.data() + begin_[r]);
    });
  };
  move(above, 1, [](std::size_t) { return true; });
  // One side is enough where the other cannot be had, or where speed counts.
  move(below, -1, [&](std::size_t k) { return central || !above[k].moved; });

  for (std::size_t k = 0; k < m; ++k) {
    // A parameter whose recording is not among these changes nothing.
    if (!touches_any(recording_of(k))) continue;
    if (!above[k].moved && !below[k].moved) return false;
    const auto& up = above[k].moved ? above[k].residual : point.residual;
    const auto& down = below[k].moved ? below[k].residual : point.residual;
    const double width = above[k].z - below[k].z;
    double* column = columns.col(k);
    for (std::size_t i = 0; i < rows_; ++i) column[i] = (up[i] - down[i]) / width;
  }
  return true;
}

/// r + C s + J p with s = -(change of theta): C = Q R, J = C X + J', r = C x + r', J' and r' orthogonal to C. In rows
/// of Q: R (s + X p + x), behind them J' p + r'.
void Projection::linear_model_by(const ProjectedPoint& point, Dense jacobian_columns, LinearizedResidual& model) const {
  const bool exact = model_.why_not_exact().empty();
  const std::size_t m = linear_.size(), k = nonlinear_.size(), n = m + k;
  auto residual = point.residual;
  std::vector<double*> list;
  std::vector<double> before;
  for (std::size_t j = 0; j < k; ++j) {
    list.push_back(jacobian_columns.col(j));
    before.push_back(length(list.back(), rows_));
  }
  // What no bound holds has taken its part out of the residual already.
  const bool held = std::any_of(point.bound.begin(), point.bound.end(), [](Bound b) { return b != Bound::inside; });
  if (held) list.push_back(residual.data());
  const auto made_up = ColumnSpan(point.columns, point.triangle, dependent).clear(list);
  // What the linear parameters make up for completely is rounding: a search must not follow it.
  for (std::size_t j = 0; j < k; ++j)
    if (length(list[j], rows_) < (exact ? 1e-7 : 1e-4) * before[j]) std::fill_n(list[j], rows_, 0.0);
  for (double& x : residual) x = -x;
  NormalForm rest(static_cast<int>(k));
  rest.add(jacobian_columns.a, residual);

  model.form = NormalForm(static_cast<int>(n));
  const auto times_triangle = [&](const std::vector<double>& x, double sign, double* to) {
    for (std::size_t j = 0; j < m; ++j)
      for (std::size_t i = 0; i <= j; ++i) to[i] += sign * point.triangle[j * m + i] * x[j];
  };
  for (std::size_t j = 0; j < m; ++j) std::copy_n(point.triangle.data() + j * m, j + 1, model.form.r.data() + j * n);
  for (std::size_t j = 0; j < k; ++j) {
    double* column = model.form.r.data() + (m + j) * n;
    times_triangle(made_up[j], 1, column);
    std::copy_n(rest.r.data() + j * k, j + 1, column + m);
  }
  if (held) times_triangle(made_up[k], -1, model.form.d.data());
  std::copy(rest.d.begin(), rest.d.end(), model.form.d.begin() + static_cast<std::ptrdiff_t>(m));
  model.form.rest = rest.rest;
  for (std::size_t j = 0; j < m; ++j) {
    const auto& f = free_[static_cast<std::size_t>(linear_[j])];
    model.low.push_back(point.theta[j] - f.upper);
    model.high.push_back(point.theta[j] - f.lower);
  }
}

bool Projection::linear_model(const ProjectedPoint& point, bool central, LinearizedResidual& model) {
  auto columns = std::make_shared<Dense>();
  if (!jacobian(point, central, *columns)) return false;
  found_ = columns;
  linear_model_by(point, *columns, model);
  return true;
}

void Projection::know(std::shared_ptr<const Dense> derivatives) {
  const bool fits = derivatives && derivatives->rows == rows_ && derivatives->cols == nonlinear_.size();
  known_ = fits ? std::move(derivatives) : nullptr;
}

bool Projection::known_linear_model(const ProjectedPoint& point, LinearizedResidual& model) const {
  if (!known_) return false;
  linear_model_by(point, *known_, model);
  return true;
}

}  // namespace hysteron
