#include "fit/fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>

#include "fit/colour.h"
#include "fit/determined.h"
#include "fit/draws.h"
#include "fit/levenberg_marquardt.h"
#include "fit/profile.h"
#include "fit/projection.h"

namespace hysteron {
namespace {

/// One fit from start to result; the members are what its stages hand on.
class Fitting {
 public:
  Fitting(DataModel& model, const NoiseModel& noise, const std::vector<FreeParameter>& free, const FitOptions& options)
      : model_(model), judge_(model, noise), all_(free), options_(options) {
    fitted_ = options.recordings.empty() ? model.recordings(Role::train) : options.recordings;
    constexpr Role both[] = {Role::train, Role::validate};
    judged_ = options.judged.empty() ? model.recordings(both) : options.judged;
    // Parameters of recordings that are not fitted are found on their own, behind the others.
    for (std::size_t i = 0; i < free.size(); ++i)
      if (free[i].recording < 0 || contains(fitted_, free[i].recording)) {
        free_.push_back(free[i]);
        place_.push_back(i);
      }
    check();
    affine_ = affine_of(free_);
    projection_ = std::make_unique<Projection>(model_, judge_, free_, affine_, fitted_, options.fixed);
  }

  FitResult run() {
    const auto begin = std::chrono::steady_clock::now();
    runs_before_ = model_.runs();
    failures_before_ = model_.failures();
    prepare_result();
    auto starts = scan();
    search_globally(starts);
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
  static bool contains(const std::vector<int>& list, int x) {
    return std::find(list.begin(), list.end(), x) != list.end();
  }
  std::vector<bool> affine_of(const std::vector<FreeParameter>& free) const;
  void check() const;
  void prepare_result();
  Trial start_values() const;
  std::vector<PointPointer> scan();
  void try_points(const std::vector<std::vector<double>>& z, std::vector<PointPointer>& points);
  std::vector<std::vector<double>> grid(const std::vector<std::vector<double>>& values) const;
  void scan_one_by_one(const std::vector<std::vector<double>>& values, std::vector<PointPointer>& points);
  std::vector<std::vector<double>> spread() const;
  void search_globally(std::vector<PointPointer>& starts);
  void search(const std::vector<PointPointer>& starts);
  void search_from(const std::vector<double>& start);
  void refine_substeps();
  void finish();
  void write_estimates();
  void find_intervals();
  void find_profiles();
  void fit_the_waiting();
  void put_in_order();
  bool go_on(const char* stage, double fraction = -1);
  void keep(const PointPointer& point) {
    if (point->ok && (!best_ || point->chi2 < best_->chi2)) best_ = point;
    if (!point->ok && first_error_.empty()) first_error_ = point->error;
  }
  double tolerance() const { return model_.why_not_exact().empty() ? 1e-9 : 1e-7; }

  DataModel& model_;
  Judge judge_;
  const std::vector<FreeParameter>& all_;
  std::vector<FreeParameter> free_;  ///< those fitted together
  std::vector<std::size_t> place_;   ///< of these in all_
  std::vector<bool> affine_;
  const FitOptions& options_;
  std::vector<int> fitted_, judged_;
  std::unique_ptr<Projection> projection_;
  PointPointer best_;
  std::string first_error_;
  long runs_before_ = 0, failures_before_ = 0, candidates_ = 0;
  FitResult result_;
};

std::vector<bool> Fitting::affine_of(const std::vector<FreeParameter>& free) const {
  std::vector<int> parameters;
  for (const auto& f : free) parameters.push_back(f.parameter);
  std::vector<int> signals;
  for (int o = 0; o < static_cast<int>(model_.outputs().size()); ++o) signals.push_back(model_.output_signal(o));
  return jointly_affine(model_.program(), parameters, signals);
}

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

bool Fitting::go_on(const char* stage, double fraction) {
  if (result_.stopped) return false;
  if (!options_.progress) return true;
  FitProgress p;
  p.chi2 = best_ ? best_->chi2 : std::numeric_limits<double>::infinity();
  p.rows = static_cast<double>(projection_->data_rows());
  p.runs = model_.runs() - runs_before_;
  p.candidates = candidates_;
  p.fraction = fraction;
  p.stage = stage;
  result_.stopped = !options_.progress(p);
  return !result_.stopped;
}

Trial Fitting::start_values() const {
  Trial start;
  for (const auto& f : all_) start.push_back({f.parameter, f.start, f.recording});
  start.insert(start.end(), options_.fixed.begin(), options_.fixed.end());
  return start;
}

ParameterEstimate estimate_at_start(const DataModel& model, const FreeParameter& f) {
  const auto& info = model.program().parameters[static_cast<std::size_t>(f.parameter)];
  ParameterEstimate e;
  e.parameter = f.parameter;
  e.path = info.path;
  e.recording = f.recording;
  e.unit = parameter_unit(model.program(), info);
  e.difference = info.difference;
  e.start = e.used = f.start;
  e.lower = f.lower;
  e.upper = f.upper;
  e.prior = f.prior;
  return e;
}

void Fitting::prepare_result() {
  const auto start = start_values();
  const auto white = judge_.noise().white();
  model_.choose_substeps(start, white);
  result_.before = judge_.score(model_, model_.predict(start, judged_), judged_);
  for (const auto& f : free_) result_.estimates.push_back(estimate_at_start(model_, f));
  for (const int i : projection_->linear()) result_.estimates[static_cast<std::size_t>(i)].linear = true;
  for (const int i : projection_->nonlinear())
    result_.estimates[static_cast<std::size_t>(i)].log_scale = free_[static_cast<std::size_t>(i)].log_scale;
}

// --- scan
// -------------------------------------------------------------------------------------------------------------

/// Tries points side by side; what can be simulated is appended.
void Fitting::try_points(const std::vector<std::vector<double>>& z, std::vector<PointPointer>& points) {
  constexpr std::size_t at_once = 32;
  for (std::size_t first = 0; first < z.size(); first += at_once) {
    if (!go_on("scan", static_cast<double>(first) / static_cast<double>(z.size()))) return;
    const auto last = std::min(z.size(), first + at_once);
    const std::vector<std::vector<double>> some(z.begin() + static_cast<std::ptrdiff_t>(first),
                                                z.begin() + static_cast<std::ptrdiff_t>(last));
    candidates_ += static_cast<long>(some.size());
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

/// Points spread evenly over the box (Halton's sequence, shifted by the seed). Where a bound is infinite: over two
/// decades to each side of the start, or three times its size.
std::vector<std::vector<double>> Fitting::spread() const {
  constexpr int primes[] = {2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53};
  const auto low = projection_->lower(), high = projection_->upper(), start = projection_->start();
  std::vector<std::vector<double>> points(static_cast<std::size_t>(std::max(0, options_.starts)), start);
  for (std::size_t k = 0; k < start.size(); ++k) {
    const auto& f = free_[static_cast<std::size_t>(projection_->nonlinear()[k])];
    const double reach = f.log_scale ? std::log(100.0) : start[k] != 0 ? 3 * std::abs(start[k]) : 1;
    const double from = std::isfinite(low[k]) ? low[k] : std::min(start[k], high[k]) - reach;
    const double to = std::isfinite(high[k]) ? high[k] : std::max(start[k], from) + reach;
    const double shift = draws::uniform(options_.seed, 1000, k);
    const int base = primes[k % std::size(primes)];
    for (std::size_t i = 0; i < points.size(); ++i) {
      double x = shift, digit = 1;
      for (std::size_t n = i + 1 + 409 * (k / std::size(primes)); n > 0; n /= static_cast<std::size_t>(base)) {
        digit /= base;
        x += digit * static_cast<double>(n % static_cast<std::size_t>(base));
      }
      points[i][k] = from + (x - std::floor(x)) * (to - from);
    }
  }
  return points;
}

/// Points to search from, best first: the start, what the scan values offer, and points spread over the box.
std::vector<PointPointer> Fitting::scan() {
  std::vector<PointPointer> points;
  if (const auto start = projection_->at(projection_->start()); go_on("scan")) {
    ++candidates_;
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
  if (projection_->n_nonlinear() > 0) try_points(spread(), points);
  std::stable_sort(points.begin(), points.end(), [](auto& a, auto& b) { return a->chi2 < b->chi2; });
  points.erase(std::unique(points.begin(), points.end(), [](auto& a, auto& b) { return a->z == b->z; }), points.end());
  return points;
}

/// Puts what a global method finds before the other starts.
void Fitting::search_globally(std::vector<PointPointer>& starts) {
  const auto n = static_cast<std::size_t>(projection_->n_nonlinear());
  if (options_.global.empty() || n == 0 || result_.stopped) return;
  GlobalProblem problem;
  // Unknowns are searched as z; those of an attractor, which is given in plain values, as values.
  std::vector<bool> plain(n, false);
  if (options_.attractor) {
    problem.attractor = options_.attractor;
    const auto place = [&](int& component) {
      for (std::size_t k = 0; k < n; ++k) {
        if (place_[static_cast<std::size_t>(projection_->nonlinear()[k])] != static_cast<std::size_t>(component))
          continue;
        component = static_cast<int>(k);
        plain[k] = true;
        return;
      }
      fail("bad_attractor", "attractor", "a parameter of the attractor is not among those searched",
           "free it, and let it be none that linear least squares finds");
    };
    for (auto& c : problem.attractor->components) {
      place(c.component);
      if (c.of >= 0) place(c.of);
    }
  }
  const auto low = projection_->lower(), high = projection_->upper();
  for (std::size_t k = 0; k < n; ++k) {
    const auto& f = free_[static_cast<std::size_t>(projection_->nonlinear()[k])];
    problem.lower.push_back(plain[k] ? f.lower : low[k]);
    problem.upper.push_back(plain[k] ? f.upper : high[k]);
    if (!std::isfinite(problem.lower[k]) || !std::isfinite(problem.upper[k]))
      fail("open_bounds", model_.program().parameters[static_cast<std::size_t>(f.parameter)].path,
           fmt::format("\"{}\" searches a finite box, and this parameter has an open bound", options_.global),
           "give it a lower and an upper bound, both above zero where the scale is logarithmic");
  }
  const auto z_of = [&](const Point& point) {
    auto z = point;
    for (std::size_t k = 0; k < n; ++k)
      if (plain[k]) z[k] = projection_->to_z(static_cast<int>(k), point[k]);
    return z;
  };
  problem.cost_of_each = [&](const std::vector<Point>& points) {
    std::vector<std::vector<double>> z;
    for (const auto& point : points) z.push_back(z_of(point));
    std::vector<double> costs;
    for (const auto& point : projection_->at_each(z)) {
      costs.push_back(point->ok ? point->chi2 : std::numeric_limits<double>::infinity());
      if (!point->ok && first_error_.empty()) first_error_ = point->error;
    }
    candidates_ += static_cast<long>(points.size());
    return costs;
  };
  problem.cost = [&](const Point& point) { return problem.cost_of_each({point}).front(); };
  GlobalSettings settings;
  settings.seed = options_.seed;
  settings.max_runs = options_.global_runs;
  settings.go_on = [&](const GlobalProgress& now) {
    return go_on("global", static_cast<double>(now.runs) / static_cast<double>(options_.global_runs));
  };
  const auto found = minimize_globally(problem, options_.global, settings);
  if (found.best.empty()) return;
  const auto point = projection_->at(z_of(found.best));
  keep(point);
  if (!point->ok) return;
  if (!options_.polish) starts.clear();
  starts.insert(starts.begin(), point);
  result_.global_history = found.history;
  result_.convergence = fmt::format("the budget of {} points is used up", options_.global_runs);
}

// --- search
// -----------------------------------------------------------------------------------------------------------

void Fitting::search_from(const std::vector<double>& start) {
  int iterations = 0;
  bool converged = false;
  std::string message;
  const auto found = search_locally(
      *projection_, start, options_.max_iterations, tolerance(),
      [&] {
        ++candidates_;
        return go_on("search");
      },
      iterations, converged, message);
  if (found) keep(found);
  result_.iterations += iterations;
  if ((found && found == best_) || result_.starts == 0) {
    result_.converged = converged;
    result_.convergence = message;
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
  if (options_.global.empty() || options_.polish) {
    const auto n = std::min<std::size_t>(starts.size(), static_cast<std::size_t>(std::max(1, options_.refine)));
    for (std::size_t i = 0; i < n && !result_.stopped; ++i) search_from(starts[i]->z);
  }
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
  if (again->ok && projection_->n_nonlinear() > 0 && !result_.stopped) search_from(again->z);
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
  if (!projection_->jacobian(*best_, options_.intervals, false, nonlinear)) {
    result_.remarks.push_back("no intervals: the neighbourhood of the result cannot be simulated");
    return;
  }
  const std::size_t rows = projection_->rows();
  std::vector<Sensitive> columns;
  Dense jacobian(rows, 0);
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
    ++jacobian.cols;
    for (std::size_t i = 0; i < rows; ++i) jacobian.a.push_back(sign * column[i]);
  };
  jacobian.a.reserve(rows * free_.size());
  for (std::size_t k = 0; k < projection_->nonlinear().size(); ++k)
    add(projection_->nonlinear()[k], nonlinear.col(k), 1);
  for (std::size_t j = 0; j < projection_->linear().size(); ++j)
    add(projection_->linear()[j], best_->columns.col(j), -1);
  for (const double x : jacobian.a)
    if (!std::isfinite(x)) return;
  if (options_.intervals) {
    // The intervals are scaled by s2, which is the data's: a prior knows its own width.
    const double prior_scale = std::sqrt(result_.s2);
    for (std::size_t j = 0; j < columns.size(); ++j)
      for (std::size_t i = projection_->data_rows(); i < rows; ++i) jacobian(i, j) *= prior_scale;
    NormalForm normal(static_cast<int>(columns.size()));
    normal.add(jacobian.a, best_->residual);
    NormalForm coloured(static_cast<int>(columns.size()));
    if (options_.residual_noise) {
      const auto variances = row_variances(model_, judge_, *options_.residual_noise, fitted_);
      Dense scaled = jacobian;
      for (std::size_t j = 0; j < columns.size(); ++j)
        for (std::size_t i = 0; i < variances.size(); ++i) scaled(i, j) *= std::sqrt(variances[i]);
      coloured.add(scaled.a, best_->residual);
    }
    judge_parameters(normal, columns, model_.why_not_exact().empty(), result_,
                     options_.residual_noise ? &coloured : nullptr);
  }
  if (options_.keep_neighbourhood)
    result_.neighbourhood =
        std::make_shared<Neighbourhood>(Neighbourhood{fitted_, best_->residual, std::move(jacobian)});
}

void Fitting::find_profiles() {
  if (options_.profile.empty()) return;
  ProfileTask task;
  task.model = &model_;
  task.judge = &judge_;
  task.free = free_;
  for (std::size_t i = 0; i < free_.size(); ++i) {
    task.free[i].start = result_.values[i].value;
    task.free[i].scan.clear();
  }
  task.affine = affine_;
  task.recordings = fitted_;
  task.fixed = options_.fixed;
  task.chi2 = best_->chi2;
  task.s2 = result_.s2;
  task.max_iterations = options_.max_iterations;
  for (std::size_t n = 0; n < options_.profile.size(); ++n) {
    const auto place = std::find(place_.begin(), place_.end(), static_cast<std::size_t>(options_.profile[n]));
    if (place == place_.end()) continue;
    const int which = static_cast<int>(place - place_.begin());
    const double fraction = static_cast<double>(n) / static_cast<double>(options_.profile.size());
    task.go_on = [&] { return go_on("profile", fraction); };
    if (!task.go_on()) return;
    std::vector<double> better;
    const auto& e = result_.estimates[static_cast<std::size_t>(which)];
    result_.profiles.push_back(profile_of(task, which, e.sigma.value_or(0), better));
    if (!better.empty())
      result_.remarks.push_back(fmt::format(
          "the profile of {} met a better fit than the result: begin from other values, or from more starts", e.path));
  }
}

/// Parameters of single recordings that were judged and not fitted, each on its own recording with all others held.
void Fitting::fit_the_waiting() {
  for (const int r : judged_) {
    std::vector<FreeParameter> waiting;
    std::vector<std::size_t> place;
    for (std::size_t i = 0; i < all_.size(); ++i)
      if (all_[i].recording == r && !contains(fitted_, r)) {
        waiting.push_back(all_[i]);
        place.push_back(i);
      }
    if (waiting.empty()) continue;
    Trial fixed = result_.values;
    fixed.insert(fixed.end(), options_.fixed.begin(), options_.fixed.end());
    Projection projection(model_, judge_, waiting, affine_of(waiting), {r}, fixed);
    bool converged = false;
    std::string message;
    const auto point = search_locally(
        projection, projection.start(), options_.max_iterations, tolerance(), [&] { return go_on("search"); },
        result_.iterations, converged, message);
    const auto values = point ? projection.values(point->z, point->theta) : Trial{};
    for (std::size_t i = 0; i < waiting.size(); ++i) {
      auto e = estimate_at_start(model_, waiting[i]);
      if (point) e.value = e.used = values[i].value;
      e.determined = point != nullptr;
      result_.values.push_back({e.parameter, e.used, r});
      result_.estimates.push_back(std::move(e));
      place_.push_back(place[i]);
    }
  }
}

/// Estimates and values stand as the free parameters were given.
void Fitting::put_in_order() {
  std::vector<std::size_t> order(place_.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return place_[a] < place_[b]; });
  std::vector<int> where(order.size());
  std::vector<ParameterEstimate> estimates;
  std::vector<ParameterValue> values;
  for (std::size_t i = 0; i < order.size(); ++i) {
    where[order[i]] = static_cast<int>(i);
    estimates.push_back(std::move(result_.estimates[order[i]]));
    values.push_back(result_.values[order[i]]);
  }
  result_.estimates = std::move(estimates);
  result_.values = std::move(values);
  for (int& c : result_.correlated) c = where[static_cast<std::size_t>(c)];
  for (auto& p : result_.profiles) p.estimate = where[static_cast<std::size_t>(p.estimate)];
}

std::string method_text(const Projection& projection, const FitOptions& options) {
  std::vector<std::string> parts;
  if (projection.n_linear() > 0) parts.push_back(fmt::format("linear least squares ({})", projection.n_linear()));
  if (projection.n_nonlinear() > 0) {
    std::string search = options.global;
    if (options.global.empty() || options.polish)
      search += (search.empty() ? "" : ", then ") + std::string("Levenberg-Marquardt");
    parts.push_back(fmt::format("{} ({})", search, projection.n_nonlinear()));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

void Fitting::finish() {
  if (!best_) {
    result_.error = first_error_;
    return;
  }
  result_.ok = true;
  write_estimates();
  result_.values.resize(free_.size());  // without what was held fixed
  result_.chi2 = best_->chi2 - best_->prior_chi2;
  result_.prior_chi2 = best_->prior_chi2;
  result_.n_parameters = 0;
  for (const auto& e : result_.estimates) result_.n_parameters += e.at_lower || e.at_upper ? 0 : 1;
  for (const int r : fitted_) {
    double states =
        model_.recording(r).initial_per_recording ? static_cast<double>(model_.free_initial_states().size()) : 0;
    result_.n += model_.recording(r).weight * (static_cast<double>(judge_.size(r)) - states);
  }
  result_.s2 = result_.chi2 / std::max(1.0, result_.n - result_.n_parameters);
  result_.method = method_text(*projection_, options_);
  if ((options_.intervals || options_.keep_neighbourhood) && go_on("intervals")) find_intervals();
  find_profiles();
  fit_the_waiting();
  put_in_order();
  Trial after = result_.values;
  after.insert(after.end(), options_.fixed.begin(), options_.fixed.end());
  result_.after = judge_.score(model_, model_.predict(after, judged_), judged_);
  if (result_.stopped) result_.convergence = "stopped; the best so far";
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
  first_options.profile.clear();
  first_options.keep_neighbourhood = true;
  FitResult first = fit(model, both.noise, free, first_options);
  if (!first.ok || first.stopped) {
    both.result = std::move(first);
    return both;
  }
  FitOptions second_options = options;
  NoiseModel likely = both.noise;
  if (first.neighbourhood) likely = noise_from_likelihood(model, Judge(model, both.noise), *first.neighbourhood);
  const bool structured = std::any_of(likely.outputs.begin(), likely.outputs.end(), [](const NoiseOfOutput& o) {
    return o.share_estimated && o.one_over_f > most_share_of_a_sensor;
  });
  if (!first.neighbourhood || structured) {
    Trial best = first.values;
    best.insert(best.end(), options.fixed.begin(), options.fixed.end());
    const auto fitted = options.recordings.empty() ? model.recordings(Role::train) : options.recordings;
    both.noise = noise_from_residual(model, both.noise, model.predict(best, fitted), fitted);
    if (structured) second_options.residual_noise = likely;
  } else {
    both.noise = likely;
  }
  auto again = free;
  for (std::size_t i = 0; i < again.size(); ++i) {
    again[i].start = first.values[i].value;
    again[i].scan.clear();
  }
  second_options.starts = 0;
  second_options.global.clear();
  second_options.max_iterations = options.polish || options.global.empty() ? options.max_iterations : 0;
  both.result = fit(model, both.noise, again, second_options);
  FitResult& result = both.result;
  for (std::size_t i = 0; i < free.size(); ++i) result.estimates[i].start = free[i].start;
  std::vector<int> judged;
  for (const auto& r : result.after.recordings) judged.push_back(r.recording);
  std::vector<ParameterValue> start;
  for (const auto& f : free) start.push_back({f.parameter, f.start, f.recording});
  start.insert(start.end(), options.fixed.begin(), options.fixed.end());
  result.before = Judge(model, both.noise).score(model, model.predict(start, judged), judged);
  result.method = std::move(first.method);
  result.global_history = std::move(first.global_history);
  if (!result.converged && first.converged) result.convergence = std::move(first.convergence);
  result.converged = result.converged || first.converged;
  result.starts += first.starts;
  if (structured)
    result.remarks.emplace_back(
        "what is left is slower than a sensor's noise: much of it may be what the model lacks (hysteron diagnose looks "
        "for "
        "it). The intervals allow for it as if it came by chance");
  result.runs += first.runs;
  result.failed_runs += first.failed_runs;
  result.iterations += first.iterations;
  result.seconds += first.seconds;
  return both;
}

}  // namespace hysteron
