#include "fit/estimate/projection.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "fit/numerics/column_span.h"

namespace hysteron {
Projection::Projection(DataModel& model, const Judge& judge, const std::vector<FreeParameter>& free,
                       const std::vector<bool>& affine, std::vector<int> recordings, Trial fixed)
    : model_(model), judge_(judge), free_(free), recordings_(std::move(recordings)), fixed_(std::move(fixed)) {
  for (std::size_t i = 0; i < free.size(); ++i) (affine[i] ? linear_ : nonlinear_).push_back(static_cast<int>(i));
  for (const int r : recordings_) {
    begin_.push_back(rows_);
    size_.push_back(judge.size(r));
    rows_ += size_.back();
    has_initial_ = has_initial_ || (model.recording(r).initial_per_recording && !model.free_initial_states().empty());
  }
  data_rows_ = rows_;
  for (std::size_t i = 0; i < free.size(); ++i) {
    if (!free[i].prior) continue;
    PriorRow prior{static_cast<int>(i), free[i].log_scale && !affine[i], 0, 1};
    double a = free[i].prior->first, b = free[i].prior->second;
    if (prior.log_scale) a = std::log(a), b = std::log(b);
    prior.mean = 0.5 * (a + b);
    prior.sigma = (b - a) / (2 * 1.959963984540054);  // 95 % of a normal distribution lie between a and b
    priors_.push_back(prior);
  }
  rows_ += priors_.size();
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

std::vector<double> Projection::largest_step() const {
  std::vector<double> list;
  for (const int i : nonlinear_) {
    const auto& f = free_[static_cast<std::size_t>(i)];
    list.push_back(f.log_scale ? std::log(2.0) : 0.5 * (f.upper - f.lower));
  }
  return list;
}

std::vector<ParameterValue> Projection::values(std::span<const double> z, std::span<const double> theta) const {
  std::vector<ParameterValue> list(free_.size());
  for (std::size_t k = 0; k < nonlinear_.size(); ++k) {
    const auto i = static_cast<std::size_t>(nonlinear_[k]);
    list[i] = {free_[i].parameter, to_value(static_cast<int>(k), z[k]), free_[i].recording};
  }
  for (std::size_t j = 0; j < linear_.size(); ++j) {
    const auto i = static_cast<std::size_t>(linear_[j]);
    list[i] = {free_[i].parameter, theta[j], free_[i].recording};
  }
  list.insert(list.end(), fixed_.begin(), fixed_.end());
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

bool Projection::touches_any(int recording) const {
  return recording < 0 || std::find(recordings_.begin(), recordings_.end(), recording) != recordings_.end();
}

/// Simulates what is wanted, recording by recording and some trials at once, so that what is made of a prediction finds
/// it in the caches; hands each prediction on: what concerns all recordings first, in the order given.
void Projection::simulate(std::span<const Wanted> wanted, const Use& use) {
  const auto side_by_side = static_cast<std::size_t>(std::max(1, model_.threads()));
  for (std::size_t k = 0; k < recordings_.size(); k += side_by_side) {
    const std::size_t end = std::min(recordings_.size(), k + side_by_side);
    simulate_on(k, end, -1, wanted, use);
    for (std::size_t r = k; r < end; ++r) simulate_on(r, r + 1, recordings_[r], wanted, use);
  }
}

/// On the recordings at places [begin, end): what was wanted of `recording` (-1: of all of them).
void Projection::simulate_on(std::size_t begin, std::size_t end, int recording, std::span<const Wanted> wanted,
                             const Use& use) {
  constexpr std::size_t numbers_at_once = 80'000;  // of predictions: 640 kB, which a core's cache holds
  std::vector<std::size_t> members;
  for (std::size_t i = 0; i < wanted.size(); ++i)
    if (wanted[i].recording == recording) members.push_back(i);
  const std::size_t rows = *std::max_element(size_.begin() + static_cast<std::ptrdiff_t>(begin),
                                             size_.begin() + static_cast<std::ptrdiff_t>(end));
  const std::size_t most = std::max<std::size_t>(4, numbers_at_once / std::max<std::size_t>(1, rows) / 4 * 4);
  std::vector<Trial> trials;
  for (std::size_t first = 0; first < members.size(); first += most) {
    const std::size_t n = std::min(most, members.size() - first);
    trials.clear();
    for (std::size_t i = 0; i < n; ++i) trials.push_back(wanted[members[first + i]].trial);
    const auto predictions = model_.predict_each(trials, std::span(recordings_).subspan(begin, end - begin));
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t r = begin; r < end; ++r) use(members[first + i], r, predictions[i]);
  }
}

/// W (measured - y) of one recording.
void Projection::whiten_residual(const Prediction& prediction, std::size_t k, double* out) {
  difference_.resize(model_.outputs().size());
  for (std::size_t o = 0; o < difference_.size(); ++o)
    residual_rows(model_, prediction, recordings_[k], static_cast<int>(o), difference_[o]);
  judge_.whiten(recordings_[k], difference_, out);
}

/// One row per prior, behind the data.
void Projection::prior_rows(std::span<const double> z, std::span<const double> theta, double* out) const {
  if (priors_.empty()) return;
  const auto all = values(z, theta);
  for (const auto& prior : priors_) {
    const double value = all[static_cast<std::size_t>(prior.free)].value;
    *out++ = (prior.mean - (prior.log_scale ? std::log(value) : value)) / prior.sigma;
  }
}

/// Takes the free initial states out of a whitened column.
void Projection::clear(const ProjectedPoint& point, double* column) const {
  for (std::size_t k = 0; k < point.initial_basis.size(); ++k) {
    clear_of(point.initial_basis[k], column);
    column += size_[k];
  }
}

void Projection::make_room(ProjectedPoint& point, std::vector<double>& residual) {
  point.columns.rows = rows_;
  point.columns.cols = linear_.size();
  point.columns.a = std::exchange(spare_columns_, {});
  residual = std::exchange(spare_residual_, {});
  point.columns.a.resize(rows_ * linear_.size());
  residual.resize(rows_);
  const bool all_touched = priors_.empty() && std::all_of(linear_.begin(), linear_.end(), [&](int i) {
                             return free_[static_cast<std::size_t>(i)].recording < 0;
                           });
  if (!all_touched) std::fill(point.columns.a.begin(), point.columns.a.end(), 0.0);
}

/// The last few points are kept; the memory of one that nobody else holds is used again.
void Projection::remember(std::shared_ptr<ProjectedPoint> point) {
  if (recent_.size() >= 2) {
    const auto old = std::move(recent_.front());
    recent_.erase(recent_.begin());
    if (old.use_count() == 1) {
      spare_columns_ = std::move(old->columns.a);
      spare_residual_ = std::move(old->residual);
    }
  }
  recent_.push_back(std::move(point));
}

/// Simulates the reference and one response per linear parameter of each point.
void Projection::responses(std::span<ProjectedPoint*> points, std::vector<std::vector<double>>& residuals) {
  const auto ref = reference();
  const std::size_t m = linear_.size();
  std::vector<double> step(m);
  std::vector<Wanted> wanted;
  residuals.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    auto* point = points[i];
    point->ok = true;
    make_room(*point, residuals[i]);
    wanted.push_back({values(point->z, ref), -1});
    for (std::size_t j = 0; j < m; ++j) {
      auto theta = ref;
      const auto& f = free_[static_cast<std::size_t>(linear_[j])];
      step[j] = theta[j] + delta_[j] > f.upper && theta[j] - delta_[j] >= f.lower ? -delta_[j] : delta_[j];
      theta[j] += step[j];
      wanted.push_back({values(point->z, theta), f.recording});
    }
  }
  simulate(wanted, [&](std::size_t i, std::size_t k, const Prediction& prediction) {
    ProjectedPoint& point = *points[i / (m + 1)];
    if (!prediction.ok) {
      if (point.ok) point.error = prediction.error;
      point.ok = false;
    }
    if (!point.ok) return;
    double* residual = residuals[i / (m + 1)].data() + begin_[k];
    if (i % (m + 1) == 0) return whiten_residual(prediction, k, residual);
    const std::size_t j = i % (m + 1) - 1;
    double* column = point.columns.col(j) + begin_[k];
    whiten_residual(prediction, k, column);
    const double per_step = 1 / step[j];
    for (std::size_t row = 0; row < size_[k]; ++row) column[row] = (residual[row] - column[row]) * per_step;
  });
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i]->ok) continue;
    prior_rows(points[i]->z, ref, residuals[i].data() + data_rows_);
    for (std::size_t p = 0; p < priors_.size(); ++p)
      for (std::size_t j = 0; j < m; ++j)
        if (linear_[j] == priors_[p].free) points[i]->columns(data_rows_ + p, j) = 1 / priors_[p].sigma;
  }
}

/// Per recording; empty where the model cannot be simulated.
std::vector<Dense> Projection::initial_basis_at(std::span<const double> z, const std::vector<double>& theta) {
  const auto prediction = model_.predict(values(z, theta), recordings_, true);
  if (!prediction.ok) return {};
  std::vector<Dense> basis(recordings_.size());
  for (std::size_t k = 0; k < recordings_.size(); ++k) {
    const int r = recordings_[k];
    const auto& initial = prediction.initial[static_cast<std::size_t>(r)];
    Dense columns(judge_.size(r), initial.size());
    for (std::size_t s = 0; s < initial.size(); ++s) judge_.whiten(r, initial[s], columns.col(s));
    basis[k] = held_basis(columns, prediction.initial_sigma, dependent);
  }
  return basis;
}

/// Free initial states are responses too, but scaled by the linear parameters: taken at `theta`.
void Projection::clear_initial(ProjectedPoint& point, std::vector<double>& residual, const std::vector<double>& theta) {
  const bool searched = model_.starts_are_searched();
  point.initial_basis = searched && !searched_basis_.empty() ? searched_basis_ : initial_basis_at(point.z, theta);
  if (point.initial_basis.empty()) return;
  if (searched && searched_basis_.empty()) searched_basis_ = point.initial_basis;
  clear(point, residual.data());
  for (std::size_t j = 0; j < linear_.size(); ++j) clear(point, point.columns.col(j));
}

void Projection::evaluate(std::span<ProjectedPoint> points) {
  std::vector<ProjectedPoint*> all;
  for (auto& point : points) all.push_back(&point);
  std::vector<std::vector<double>> residuals;
  responses(all, residuals);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].ok) {
      solve(points[i], residuals[i]);
    } else if (from_zero_ && !linear_.empty()) {
      // Some blocks refuse zeros: then everything is measured from the start values, from now on.
      from_zero_ = false;
      std::vector<std::vector<double>> again;
      responses(std::span(all).subspan(i, 1), again);
      if (points[i].ok)
        solve(points[i], again.front());
      else
        from_zero_ = true;
    }
  }
}

void Projection::solve(ProjectedPoint& point, std::vector<double>& residual) {
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
  const int passes = has_initial_ && !model_.starts_are_searched() ? 2 : 1;
  for (int pass = 0; pass < passes; ++pass) {
    if (has_initial_) {
      point.columns = plain_columns;
      residual = plain_residual;
      clear_initial(point, residual, theta);
    }
    NormalForm normal(static_cast<int>(m));
    normal.add(point.columns.a, residual);
    solution = solve_bounded(normal, low, high, near);
    point.triangle = std::move(normal.r);
    for (std::size_t j = 0; j < m; ++j) theta[j] = ref[j] + solution.x[j];
  }
  for (std::size_t j = 0; j < m; ++j) {  // exactly at the bound, whatever ref + (bound - ref) rounds to
    const auto& f = free_[static_cast<std::size_t>(linear_[j])];
    if (solution.bound[j] == Bound::lower) theta[j] = f.lower;
    if (solution.bound[j] == Bound::upper) theta[j] = f.upper;
  }
  point.theta = std::move(theta);
  point.bound = solution.bound;
  constexpr std::size_t rows_at_once = 2048;  // of the residual, which stays in the caches
  for (std::size_t first = 0; first < rows_; first += rows_at_once)
    for (std::size_t j = 0; j < m; ++j) {
      const double* c = point.columns.col(j);
      const double x = solution.x[j];
      for (std::size_t i = first; i < std::min(rows_, first + rows_at_once); ++i) residual[i] -= c[i] * x;
    }
  point.chi2 = dot(residual.data(), residual.data(), rows_);
  point.prior_chi2 = dot(residual.data() + data_rows_, residual.data() + data_rows_, priors_.size());
  point.residual = std::move(residual);
  point.ok = std::isfinite(point.chi2);
  if (!point.ok) point.error = "the residual is not finite";
}

PointPointer Projection::at(std::span<const double> z) {
  for (const auto& p : recent_)
    if (std::equal(z.begin(), z.end(), p->z.begin(), p->z.end())) return p;
  auto point = std::make_shared<ProjectedPoint>();
  point->z.assign(z.begin(), z.end());
  evaluate(std::span(point.get(), 1));
  remember(point);
  return point;
}

std::vector<PointPointer> Projection::at_each(const std::vector<std::vector<double>>& points) {
  std::vector<PointPointer> list;
  // As many at once as fit into memory with their columns.
  const std::size_t numbers = rows_ * (linear_.size() + 2);
  const std::size_t most = std::max<std::size_t>(1, 8'000'000 / std::max<std::size_t>(1, numbers));
  for (std::size_t first = 0; first < points.size(); first += most) {
    std::vector<ProjectedPoint> some(std::min(most, points.size() - first));
    for (std::size_t i = 0; i < some.size(); ++i) some[i].z = points[first + i];
    evaluate(some);
    for (auto& point : some) {
      point.columns = {};  // only where it lies and how good it is matters of a point among many
      point.residual.clear();
      list.push_back(std::make_shared<ProjectedPoint>(std::move(point)));
    }
  }
  return list;
}

std::vector<double> Projection::chi2_of(const std::vector<Point>& points, const ProjectedPoint& best) {
  std::vector<Wanted> wanted;
  std::vector<double> chi2, rows(std::max(rows_ - data_rows_, *std::max_element(size_.begin(), size_.end())));
  for (const auto& point : points) {
    wanted.push_back({values(point.z, point.theta), -1});
    prior_rows(point.z, point.theta, rows.data());
    chi2.push_back(dot(rows.data(), rows.data(), priors_.size()));
  }
  simulate(wanted, [&](std::size_t i, std::size_t k, const Prediction& prediction) {
    if (!prediction.ok) chi2[i] = std::numeric_limits<double>::infinity();
    if (!std::isfinite(chi2[i])) return;
    whiten_residual(prediction, k, rows.data());
    if (!best.initial_basis.empty()) clear_of(best.initial_basis[k], rows.data());
    chi2[i] += dot(rows.data(), rows.data(), size_[k]);
  });
  return chi2;
}
}  // namespace hysteron
