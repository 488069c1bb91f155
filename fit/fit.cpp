#include "fit/fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>

#include "fit/determined.h"
#include "fit/projection.h"
#include "fit/trust_region.h"

namespace hysteron {
namespace {

/// One fit from start to result; the members are what its stages hand on.
class Fitting {
 public:
  Fitting(DataModel& model, const NoiseModel& noise, const std::vector<FreeParameter>& free, const FitOptions& options)
      : model_(model), judge_(model, noise), free_(free), options_(options) {
    fitted_ = options.recordings.empty() ? model.recordings(Role::train) : options.recordings;
    constexpr Role both[] = {Role::train, Role::validate};
    judged_ = options.judged.empty() ? model.recordings(both) : options.judged;
    check();
    std::vector<int> parameters;
    for (const auto& f : free) parameters.push_back(f.parameter);
    std::vector<int> signals;
    for (int o = 0; o < static_cast<int>(model.outputs().size()); ++o) signals.push_back(model.output_signal(o));
    projection_ = std::make_unique<Projection>(model_, judge_, free_,
                                               jointly_affine(model.program(), parameters, signals), fitted_);
  }

  FitResult run() {
    const auto begin = std::chrono::steady_clock::now();
    runs_before_ = model_.runs();
    failures_before_ = model_.failures();
    prepare_result();
    auto starts = scan();
    if (!starts.empty()) {
      search(starts);
      refine_substeps();
      finish();
    } else {
      result_.error = first_error_.empty() ? "no start can be simulated" : first_error_;
    }
    result_.runs = model_.runs() - runs_before_;
    result_.failed_runs = model_.failures() - failures_before_;
    result_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return std::move(result_);
  }

 private:
  void check() const;
  void prepare_result();
  std::vector<PointPointer> scan();
  void try_points(const std::vector<std::vector<double>>& z, std::vector<PointPointer>& points);
  std::vector<std::vector<double>> grid(const std::vector<std::vector<double>>& values) const;
  void scan_one_by_one(const std::vector<std::vector<double>>& values, std::vector<PointPointer>& points);
  void search(const std::vector<PointPointer>& starts);
  void search_from(const PointPointer& start);
  void refine_substeps();
  void finish();
  void write_estimates();
  void find_intervals();
  bool go_on(const char* stage);
  void keep(const PointPointer& point) {
    if (point->ok && (!best_ || point->chi2 < best_->chi2)) best_ = point;
    if (!point->ok && first_error_.empty()) first_error_ = point->error;
  }

  DataModel& model_;
  Judge judge_;
  const std::vector<FreeParameter>& free_;
  const FitOptions& options_;
  std::vector<int> fitted_, judged_;
  std::unique_ptr<Projection> projection_;
  PointPointer best_;
  std::string first_error_;
  long runs_before_ = 0, failures_before_ = 0;
  FitResult result_;
};

void Fitting::check() const {
  if (free_.empty())
    fail("no_free_parameter", "parameters", "there is nothing to fit: no parameter is free",
         "mark a diagram parameter \"free\": true, or name one with --free");
  if (fitted_.empty())
    fail("no_train_recording", "recordings", "no recording has the role train",
         "give at least one recording \"role\": \"train\"");
  double rows = 0;
  for (const int r : fitted_) rows += static_cast<double>(judge_.size(r));
  if (rows < static_cast<double>(free_.size()))
    fail("too_few_rows", "recordings", fmt::format("{} free parameters, but {} rows to fit", free_.size(), rows),
         "free fewer parameters, or record more");
  Problems problems;
  for (const auto& f : free_) {
    const auto& path = model_.program().parameters[static_cast<std::size_t>(f.parameter)].path;
    if (!std::isfinite(f.start) || f.start < f.lower || f.start > f.upper)
      problems.add("start_outside", path,
                   fmt::format("start {} (SI) is outside the bounds {} ... {}", f.start, f.lower, f.upper),
                   "move the start value or the bounds");
    if (f.log_scale && !(f.start > 0))
      problems.add("start_outside", path, "a logarithmic scale needs a start above zero",
                   "give a positive start value");
  }
  problems.throw_if_any();
}

bool Fitting::go_on(const char* stage) {
  if (result_.stopped) return false;
  if (!options_.progress) return true;
  FitProgress p;
  p.chi2 = best_ ? best_->chi2 : std::numeric_limits<double>::infinity();
  p.runs = model_.runs() - runs_before_;
  p.stage = stage;
  result_.stopped = !options_.progress(p);
  return !result_.stopped;
}

void Fitting::prepare_result() {
  std::vector<ParameterValue> start;
  for (const auto& f : free_) start.push_back({f.parameter, f.start, f.recording});
  const auto white = judge_.noise().white();
  model_.choose_substeps(start, white);
  result_.before = judge_.score(model_, model_.predict(start, judged_), judged_);
  for (const auto& f : free_) {
    const auto& info = model_.program().parameters[static_cast<std::size_t>(f.parameter)];
    ParameterEstimate e;
    e.parameter = f.parameter;
    e.path = info.path;
    e.unit = parameter_unit(model_.program(), info);
    e.difference = info.difference;
    e.start = e.used = f.start;
    e.lower = f.lower;
    e.upper = f.upper;
    result_.estimates.push_back(std::move(e));
  }
  for (const int i : projection_->linear()) result_.estimates[static_cast<std::size_t>(i)].linear = true;
  for (const int i : projection_->nonlinear())
    result_.estimates[static_cast<std::size_t>(i)].log_scale = free_[static_cast<std::size_t>(i)].log_scale;
}

// --- scan
// -------------------------------------------------------------------------------------------------------------

/// Tries points side by side; what can be simulated is appended.
void Fitting::try_points(const std::vector<std::vector<double>>& z, std::vector<PointPointer>& points) {
  constexpr std::size_t at_once = 32;
  for (std::size_t first = 0; first < z.size() && go_on("scan"); first += at_once) {
    const auto last = std::min(z.size(), first + at_once);
    const std::vector<std::vector<double>> some(z.begin() + static_cast<std::ptrdiff_t>(first),
                                                z.begin() + static_cast<std::ptrdiff_t>(last));
    for (const auto& point : projection_->at_each(some)) {
      if (!point->ok && first_error_.empty()) first_error_ = point->error;
      if (point->ok) points.push_back(point);
    }
  }
}

std::vector<std::vector<double>> Fitting::grid(const std::vector<std::vector<double>>& values) const {
  std::vector<std::vector<double>> points;
  std::vector<std::size_t> digit(values.size(), 0);
  const auto start = projection_->start();
  for (bool more = true; more;) {
    auto z = start;
    for (std::size_t k = 0; k < z.size(); ++k)
      if (!values[k].empty()) z[k] = values[k][digit[k]];
    points.push_back(std::move(z));
    more = false;
    for (std::size_t k = 0; k < digit.size() && !more; ++k) {
      if (values[k].empty()) continue;
      more = ++digit[k] < values[k].size();
      if (!more) digit[k] = 0;
    }
  }
  return points;
}

void Fitting::scan_one_by_one(const std::vector<std::vector<double>>& values, std::vector<PointPointer>& points) {
  auto base = projection_->start();
  for (std::size_t k = 0; k < values.size(); ++k) {
    std::vector<std::vector<double>> wanted;
    for (const double v : values[k]) {
      wanted.push_back(base);
      wanted.back()[k] = v;
    }
    std::vector<PointPointer> line;
    try_points(wanted, line);
    points.insert(points.end(), line.begin(), line.end());
    const auto best = std::min_element(line.begin(), line.end(), [](auto& a, auto& b) { return a->chi2 < b->chi2; });
    if (best != line.end()) base = (*best)->z;
  }
}

/// Points to search from, best first: the start and what the scan values offer.
std::vector<PointPointer> Fitting::scan() {
  std::vector<PointPointer> points;
  if (const auto start = projection_->at(projection_->start()); go_on("scan")) {
    keep(start);
    if (start->ok) points.push_back(start);
  }
  std::vector<std::vector<double>> values;
  double count = 1;
  bool any = false;
  for (int k = 0; k < projection_->n_nonlinear(); ++k) {
    const auto& f = free_[static_cast<std::size_t>(projection_->nonlinear()[static_cast<std::size_t>(k)])];
    values.emplace_back();
    for (const double v : f.scan) values.back().push_back(projection_->to_z(k, v));
    any = any || !f.scan.empty();
    count *= std::max<double>(1, static_cast<double>(f.scan.size()));
  }
  if (any && count <= options_.max_scan)
    try_points(grid(values), points);
  else if (any)
    scan_one_by_one(values, points);
  std::stable_sort(points.begin(), points.end(), [](auto& a, auto& b) { return a->chi2 < b->chi2; });
  points.erase(std::unique(points.begin(), points.end(), [](auto& a, auto& b) { return a->z == b->z; }), points.end());
  return points;
}

// --- search
// -----------------------------------------------------------------------------------------------------------

void Fitting::search_from(const PointPointer& start) {
  LeastSquares problem;
  problem.residuals = static_cast<int>(projection_->rows());
  problem.lower = projection_->lower();
  problem.upper = projection_->upper();
  const auto m = static_cast<std::size_t>(projection_->n_nonlinear());
  problem.evaluate = [&](const double* z, double* residual, double* jacobian) {
    const auto point = projection_->at({z, m});
    keep(point);
    if (!point->ok) return false;
    std::copy(point->residual.begin(), point->residual.end(), residual);
    if (jacobian == nullptr) return true;
    Dense columns;
    if (!projection_->jacobian(*point, false, true, columns)) return false;
    for (std::size_t k = 0; k < m; ++k)
      for (std::size_t i = 0; i < projection_->rows(); ++i) jacobian[i * m + k] = columns(i, k);
    return true;
  };
  problem.go_on = [&] { return go_on("search"); };
  const double tolerance = model_.why_not_exact().empty() ? 1e-9 : 1e-7;
  const auto found = minimize(problem, start->z, options_.max_iterations, tolerance);
  result_.iterations += found.iterations;
  const bool is_best = best_ && found.z == best_->z;
  if (is_best || result_.starts == 0) {
    result_.converged = found.converged;
    result_.convergence = found.message;
  }
  ++result_.starts;
}

void Fitting::search(const std::vector<PointPointer>& starts) {
  if (projection_->n_nonlinear() == 0) {
    result_.starts = 1;
    result_.converged = true;
    result_.convergence = "linear least squares: exact";
    return;
  }
  const auto n = std::min<std::size_t>(starts.size(), static_cast<std::size_t>(std::max(1, options_.refine)));
  for (std::size_t i = 0; i < n; ++i) search_from(starts[i]);
  if (!best_) keep(projection_->at(starts.front()->z));  // stopped before the first search began
}

/// Where the result needs finer substeps than the start, the search goes on with them.
void Fitting::refine_substeps() {
  std::map<int, int> before;
  for (const int r : judged_) before[r] = model_.substeps(r);
  const auto remarks =
      model_.choose_substeps(projection_->values(best_->z, best_->theta), judge_.noise().white(), true);
  result_.remarks.insert(result_.remarks.end(), remarks.begin(), remarks.end());
  bool changed = false;
  for (const int r : judged_) changed = changed || model_.substeps(r) != before[r];
  if (!changed) return;
  projection_->forget();
  const auto z = best_->z;
  best_.reset();
  const auto again = projection_->at(z);
  keep(again);
  if (again->ok && projection_->n_nonlinear() > 0 && !result_.stopped) search_from(again);
}

// --- result
// -----------------------------------------------------------------------------------------------------------

void Fitting::write_estimates() {
  result_.values = projection_->values(best_->z, best_->theta);
  const auto low = projection_->lower(), high = projection_->upper();
  for (std::size_t i = 0; i < free_.size(); ++i) {
    auto& e = result_.estimates[i];
    e.used = result_.values[i].value;
    e.value = e.used;
  }
  for (std::size_t k = 0; k < low.size(); ++k) {
    auto& e = result_.estimates[static_cast<std::size_t>(projection_->nonlinear()[k])];
    const double near = 1e-9 * std::max(1.0, std::abs(best_->z[k]));
    e.at_lower = best_->z[k] <= low[k] + near;
    e.at_upper = !e.at_lower && best_->z[k] >= high[k] - near;
  }
  for (std::size_t j = 0; j < best_->bound.size(); ++j) {
    auto& e = result_.estimates[static_cast<std::size_t>(projection_->linear()[j])];
    e.at_lower = best_->bound[j] == Bound::lower;
    e.at_upper = best_->bound[j] == Bound::upper;
  }
}

/// "core.weights" of "core.weights[2]", "" for what is no element of a list.
std::string list_of(const std::string& path) {
  return path.empty() || path.back() != ']'
             ? std::string{}
             : path.substr(0, path.find('[', path.rfind('.') == std::string::npos ? 0 : path.rfind('.')));
}

void Fitting::find_intervals() {
  Dense nonlinear;
  if (!projection_->jacobian(*best_, true, false, nonlinear)) {
    result_.remarks.push_back("no intervals: the neighbourhood of the result cannot be simulated");
    return;
  }
  const std::size_t rows = projection_->rows();
  std::vector<Sensitive> columns;
  std::vector<double> jacobian;
  std::map<std::string, double>
      largest;  // elements of one list share their size: a weight of zero is small against the others
  for (const auto& e : result_.estimates)
    if (const auto list = list_of(e.path); !list.empty()) largest[list] = std::max(largest[list], std::abs(e.used));
  const auto add = [&](int index, const double* column, double sign) {
    const auto& e = result_.estimates[static_cast<std::size_t>(index)];
    if (e.at_lower || e.at_upper) return;  // held by its bound
    Sensitive s{index, e.log_scale, e.used, std::max(std::abs(e.used), std::abs(e.start)), e.lower, e.upper};
    if (const auto list = list_of(e.path); !list.empty()) s.size = std::max(s.size, largest[list]);
    columns.push_back(s);
    for (std::size_t i = 0; i < rows; ++i) jacobian.push_back(sign * column[i]);
  };
  for (std::size_t k = 0; k < projection_->nonlinear().size(); ++k)
    add(projection_->nonlinear()[k], nonlinear.col(k), 1);
  for (std::size_t j = 0; j < projection_->linear().size(); ++j)
    add(projection_->linear()[j], best_->columns.col(j), -1);
  for (double& x : jacobian)
    if (!std::isfinite(x)) return;
  // The intervals are scaled by s2, which is the data's: a prior knows its own width.
  for (std::size_t j = 0; j < columns.size(); ++j)
    for (std::size_t i = projection_->data_rows(); i < rows; ++i) jacobian[j * rows + i] *= std::sqrt(result_.s2);
  NormalForm normal(static_cast<int>(columns.size()));
  normal.add(jacobian, best_->residual);
  judge_parameters(normal, columns, model_.why_not_exact().empty(), result_);
}

void Fitting::finish() {
  if (!best_) {
    result_.error = first_error_;
    return;
  }
  result_.ok = true;
  write_estimates();
  result_.chi2 = best_->chi2 - best_->prior_chi2;
  result_.prior_chi2 = best_->prior_chi2;
  result_.n_parameters = 0;
  for (const auto& e : result_.estimates) result_.n_parameters += e.at_lower || e.at_upper ? 0 : 1;
  result_.after = judge_.score(model_, model_.predict(result_.values, judged_), judged_);
  for (const int r : fitted_) {
    double states =
        model_.recording(r).initial_per_recording ? static_cast<double>(model_.free_initial_states().size()) : 0;
    result_.n += model_.recording(r).weight * (static_cast<double>(judge_.size(r)) - states);
  }
  result_.s2 = result_.chi2 / std::max(1.0, result_.n - result_.n_parameters);
  result_.method = projection_->n_nonlinear() == 0 ? fmt::format("linear least squares ({})", projection_->n_linear())
                   : projection_->n_linear() == 0  ? fmt::format("trust region ({})", projection_->n_nonlinear())
                                                   : fmt::format("linear least squares ({}), trust region ({})",
                                                                 projection_->n_linear(), projection_->n_nonlinear());
  if (result_.stopped) result_.convergence = "stopped; the best so far";
  if (options_.intervals && go_on("intervals")) find_intervals();
  if (result_.chi2 > 3 * result_.n)
    result_.remarks.push_back(
        "the residual is far above the noise and not random: the intervals say how sure the numbers are "
        "within this model, not that the model is right");
}

}  // namespace

FitResult fit(DataModel& model, const NoiseModel& noise, const std::vector<FreeParameter>& free,
              const FitOptions& options) {
  return Fitting(model, noise, free, options).run();
}

FitWithNoise fit_and_noise(DataModel& model, const std::vector<FreeParameter>& free, const FitOptions& options) {
  FitWithNoise both;
  both.noise = noise_before_fit(model);
  FitOptions first_options = options;  // its intervals would be thrown away
  first_options.intervals = false;
  both.result = fit(model, both.noise, free, first_options);
  if (!both.result.ok) return both;
  const auto fitted = options.recordings.empty() ? model.recordings(Role::train) : options.recordings;
  both.noise = noise_from_residual(model, both.noise, model.predict(both.result.values, fitted), fitted);
  auto again = free;
  for (std::size_t i = 0; i < again.size(); ++i) {
    again[i].start = both.result.values[i].value;
    again[i].scan.clear();
  }
  auto second = fit(model, both.noise, again, options);
  if (!second.ok) second = fit(model, noise_before_fit(model), again, options);  // with its intervals this time
  if (!second.ok) return both;
  const FitResult first = std::move(both.result);
  both.result = std::move(second);
  for (std::size_t i = 0; i < free.size(); ++i) both.result.estimates[i].start = free[i].start;
  const Judge judge(model, both.noise);
  const auto judged = [&] {
    std::vector<int> list;
    for (const auto& r : both.result.after.recordings) list.push_back(r.recording);
    return list;
  }();
  std::vector<ParameterValue> start;
  for (const auto& f : free) start.push_back({f.parameter, f.start, f.recording});
  both.result.before = judge.score(model, model.predict(start, judged), judged);
  both.result.runs += first.runs;
  both.result.failed_runs += first.failed_runs;
  both.result.iterations += first.iterations;
  both.result.seconds += first.seconds;
  return both;
}

}  // namespace hysteron
