#include "fit/projection.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hysteron {
namespace {

constexpr double dependent = 1e-10;  // columns are differences of simulations that are good to about 1e-13

}  // namespace

Projection::Projection(DataModel& model, const Judge& judge, const std::vector<FreeParameter>& free,
                       const std::vector<bool>& affine, std::vector<int> recordings)
    : model_(model), judge_(judge), free_(free), recordings_(std::move(recordings)) {
  for (std::size_t i = 0; i < free.size(); ++i) (affine[i] ? linear_ : nonlinear_).push_back(static_cast<int>(i));
  for (const int r : recordings_) {
    rows_ += judge.size(r);
    has_initial_ = has_initial_ || (model.recording(r).initial_per_recording && !model.free_initial_states().empty());
  }
  // The step between two simulations may be large, for the model is affine in it; large makes rounding small.
  for (const int i : linear_) {
    const auto& f = free[static_cast<std::size_t>(i)];
    double step = std::abs(f.start);
    if (step == 0 && std::isfinite(f.upper) && f.upper != 0) step = std::abs(f.upper);
    if (step == 0) step = 1;
    delta_.push_back(step);
  }
}

std::vector<double> Projection::start() const {
  std::vector<double> z;
  for (int k = 0; k < n_nonlinear(); ++k)
    z.push_back(to_z(k, free_[static_cast<std::size_t>(nonlinear_[static_cast<std::size_t>(k)])].start));
  return z;
}

double Projection::to_z(int k, double value) const {
  const auto& f = free_[static_cast<std::size_t>(nonlinear_[static_cast<std::size_t>(k)])];
  const double inside = std::clamp(value, f.lower, f.upper);
  return f.log_scale ? std::log(inside) : inside;
}

double Projection::to_value(int k, double z) const {
  const auto& f = free_[static_cast<std::size_t>(nonlinear_[static_cast<std::size_t>(k)])];
  return f.log_scale ? std::clamp(std::exp(z), f.lower, f.upper) : z;
}

std::vector<double> Projection::lower() const {
  std::vector<double> list;
  for (const int i : nonlinear_) {
    const auto& f = free_[static_cast<std::size_t>(i)];
    list.push_back(!f.log_scale ? f.lower : f.lower > 0 ? std::log(f.lower) : -std::numeric_limits<double>::infinity());
  }
  return list;
}

std::vector<double> Projection::upper() const {
  std::vector<double> list;
  for (const int i : nonlinear_) {
    const auto& f = free_[static_cast<std::size_t>(i)];
    list.push_back(f.log_scale && std::isfinite(f.upper) ? std::log(f.upper) : f.upper);
  }
  return list;
}

std::vector<ParameterValue> Projection::values(std::span<const double> z, std::span<const double> theta) const {
  std::vector<ParameterValue> list(free_.size());
  for (std::size_t k = 0; k < nonlinear_.size(); ++k) {
    const auto i = static_cast<std::size_t>(nonlinear_[k]);
    list[i] = {free_[i].parameter, to_value(static_cast<int>(k), z[k])};
  }
  for (std::size_t j = 0; j < linear_.size(); ++j) {
    const auto i = static_cast<std::size_t>(linear_[j]);
    list[i] = {free_[i].parameter, theta[j]};
  }
  return list;
}

std::vector<double> Projection::reference() const {
  std::vector<double> ref;
  for (const int i : linear_) {
    const auto& f = free_[static_cast<std::size_t>(i)];
    ref.push_back(from_zero_ && f.lower <= 0 && f.upper >= 0 ? 0.0 : f.start);
  }
  return ref;
}

/// factor * W (a - b), all recordings one behind the other.
void Projection::whiten_difference(const Prediction& a, const Prediction& b, double factor, double* out) const {
  for (const int r : recordings_) {
    const auto k = static_cast<std::size_t>(r);
    auto rows = a.y[k];
    for (std::size_t o = 0; o < rows.size(); ++o)
      for (std::size_t i = 0; i < rows[o].size(); ++i) rows[o][i] = factor * (rows[o][i] - b.y[k][o][i]);
    judge_.whiten(r, rows, out);
    out += judge_.size(r);
  }
}

/// Takes the free initial states out of a whitened column.
void Projection::clear(const ProjectedPoint& point, double* column) const {
  for (std::size_t k = 0; k < point.initial_basis.size(); ++k) {
    clear_of(point.initial_basis[k], column);
    column += judge_.size(recordings_[k]);
  }
}

/// Simulates the reference and one response per linear parameter.
bool Projection::responses(std::span<const double> z, ProjectedPoint& point, std::vector<double>& residual) {
  const auto ref = reference();
  const auto base = model_.predict(values(z, ref), recordings_, false);
  if (!base.ok) {
    point.error = base.error;
    return false;
  }
  residual.resize(rows_);
  double* out = residual.data();
  for (const int r : recordings_) {
    std::vector<Rows> rows;
    for (int o = 0; o < static_cast<int>(model_.outputs().size()); ++o)
      rows.push_back(residual_rows(model_, base, r, o));
    judge_.whiten(r, rows, out);
    out += judge_.size(r);
  }
  point.columns = Dense(rows_, linear_.size());
  for (std::size_t j = 0; j < linear_.size(); ++j) {
    auto theta = ref;
    const auto& f = free_[static_cast<std::size_t>(linear_[j])];
    double step = delta_[j];
    if (theta[j] + step > f.upper && theta[j] - step >= f.lower) step = -step;
    theta[j] += step;
    const auto moved = model_.predict(values(z, theta), recordings_, false);
    if (!moved.ok) {
      point.error = moved.error;
      return false;
    }
    whiten_difference(moved, base, 1 / step, point.columns.col(j));
  }
  return true;
}

/// Free initial states are responses too, but scaled by the linear parameters: taken at `theta`.
void Projection::clear_initial(ProjectedPoint& point, std::vector<double>& residual, const std::vector<double>& theta) {
  const auto prediction = model_.predict(values(point.z, theta), recordings_, true);
  point.initial_basis.clear();
  if (!prediction.ok) return;
  point.initial_basis.resize(recordings_.size());
  for (std::size_t k = 0; k < recordings_.size(); ++k) {
    const int r = recordings_[k];
    const auto& initial = prediction.initial[static_cast<std::size_t>(r)];
    Dense columns(judge_.size(r), initial.size());
    for (std::size_t s = 0; s < initial.size(); ++s) judge_.whiten(r, initial[s], columns.col(s));
    point.initial_basis[k] = orthonormal_basis(columns, dependent);
  }
  clear(point, residual.data());
  for (std::size_t j = 0; j < linear_.size(); ++j) clear(point, point.columns.col(j));
}

ProjectedPoint Projection::evaluate(std::span<const double> z) {
  ProjectedPoint point;
  point.z.assign(z.begin(), z.end());
  std::vector<double> residual;
  if (!responses(z, point, residual)) {
    // Some blocks refuse zeros: then everything is measured from the start values, from now on.
    if (!from_zero_ || linear_.empty()) return point;
    from_zero_ = false;
    if (!responses(z, point, residual)) {
      from_zero_ = true;
      return point;
    }
  }
  const auto ref = reference();
  const auto m = linear_.size();
  std::vector<double> low(m), high(m), near(m);
  std::vector<double> theta;
  for (std::size_t j = 0; j < m; ++j) {
    const auto& f = free_[static_cast<std::size_t>(linear_[j])];
    low[j] = f.lower - ref[j];
    high[j] = f.upper - ref[j];
    near[j] = f.start - ref[j];
    theta.push_back(f.start);
  }
  LinearSolution solution;
  const auto plain_columns = has_initial_ ? point.columns : Dense{};
  const auto plain_residual = has_initial_ ? residual : std::vector<double>{};
  for (int pass = 0; pass < (has_initial_ ? 2 : 1); ++pass) {
    if (has_initial_) {
      point.columns = plain_columns;
      residual = plain_residual;
      clear_initial(point, residual, theta);
    }
    NormalForm normal(static_cast<int>(m));
    normal.add(point.columns.a, residual);
    solution = solve_bounded(normal, low, high, near);
    for (std::size_t j = 0; j < m; ++j) theta[j] = ref[j] + solution.x[j];
  }
  for (std::size_t j = 0; j < m; ++j) {  // exactly at the bound, whatever ref + (bound - ref) rounds to
    const auto& f = free_[static_cast<std::size_t>(linear_[j])];
    if (solution.bound[j] == Bound::lower) theta[j] = f.lower;
    if (solution.bound[j] == Bound::upper) theta[j] = f.upper;
  }
  point.theta = std::move(theta);
  point.bound = solution.bound;
  for (std::size_t j = 0; j < m; ++j) {
    const double* c = point.columns.col(j);
    for (std::size_t i = 0; i < rows_; ++i) residual[i] -= c[i] * solution.x[j];
  }
  point.chi2 = dot(residual.data(), residual.data(), rows_);
  point.residual = std::move(residual);
  point.ok = std::isfinite(point.chi2);
  if (!point.ok) point.error = "the residual is not finite";
  return point;
}

PointPointer Projection::at(std::span<const double> z) {
  for (const auto& p : recent_)
    if (std::equal(z.begin(), z.end(), p->z.begin(), p->z.end())) return p;
  auto point = std::make_shared<ProjectedPoint>(evaluate(z));
  if (recent_.size() >= 3) recent_.erase(recent_.begin());
  recent_.push_back(point);
  return point;
}

bool Projection::jacobian(const ProjectedPoint& point, bool central, bool projected, Dense& columns) {
  const auto low = lower(), high = upper();
  columns = Dense(rows_, nonlinear_.size());
  Dense basis(rows_, 0);
  if (projected) {
    Dense inside(rows_, 0);
    for (std::size_t j = 0; j < linear_.size(); ++j)
      if (point.bound[j] == Bound::inside) {
        inside.a.insert(inside.a.end(), point.columns.col(j), point.columns.col(j) + rows_);
        ++inside.cols;
      }
    basis = orthonormal_basis(inside, dependent);
  }
  // BDF's own error is noise of its tolerance between two neighbouring trials; the exact advance has rounding only.
  const bool exact = model_.why_not_exact().empty();
  const bool two_sided = central || !exact;
  const double relative = exact ? (two_sided ? 1e-4 : 1e-6) : 3e-3;
  const auto here = model_.predict(values(point.z, point.theta), recordings_, false);
  if (!here.ok) return false;
  for (std::size_t k = 0; k < nonlinear_.size(); ++k) {
    const auto& f = free_[static_cast<std::size_t>(nonlinear_[k])];
    double size = f.log_scale ? 1.0 : std::max(std::abs(point.z[k]), 0.01 * std::abs(f.start));
    if (size == 0) size = std::isfinite(high[k] - low[k]) ? 0.01 * (high[k] - low[k]) : 1.0;
    auto forward = point.z, backward = point.z;
    forward[k] = std::min(point.z[k] + relative * size, high[k]);
    if (two_sided || forward[k] == point.z[k]) backward[k] = std::max(point.z[k] - relative * size, low[k]);
    auto up = forward[k] != point.z[k] ? model_.predict(values(forward, point.theta), recordings_, false) : here;
    auto down = backward[k] != point.z[k] ? model_.predict(values(backward, point.theta), recordings_, false) : here;
    if (!up.ok) up = here, forward[k] = point.z[k];  // one side is enough where the other cannot be simulated
    if (!down.ok) down = here, backward[k] = point.z[k];
    if (forward[k] == backward[k]) {
      backward[k] = std::max(point.z[k] - relative * size, low[k]);
      down = model_.predict(values(backward, point.theta), recordings_, false);
      if (!down.ok || forward[k] == backward[k]) return false;
    }
    double* column = columns.col(k);
    whiten_difference(up, down, -1 / (forward[k] - backward[k]), column);
    clear(point, column);
    if (!projected) continue;
    const double before = length(column, rows_);
    clear_of(basis, column);
    // What the linear parameters make up for completely is rounding: a search must not follow it.
    if (length(column, rows_) < (exact ? 1e-7 : 1e-4) * before) std::fill(column, column + rows_, 0.0);
  }
  return true;
}

}  // namespace hysteron
