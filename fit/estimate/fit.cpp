#include "fit/estimate/fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "engine/diagram/stop.h"
#include "engine/diagram/value_text.h"
#include "fit/estimate/fitting.h"
#include "fit/estimate/profile.h"
#include "fit/estimate/starts.h"
#include "fit/numerics/draws.h"

namespace hysteron {

Fitting::Fitting(DataModel& model, const NoiseModel& noise, const std::vector<FreeParameter>& free,
                 const FitOptions& options)
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
  projection_->know(options.known_derivatives);
}

FitResult Fitting::run() {
  const auto begin = std::chrono::steady_clock::now();
  runs_before_ = model_.runs();
  failures_before_ = model_.failures();
  until_stopped([&] {
    prepare_result();
    auto starts = scan();
    search_globally(starts);
    if (starts.empty()) return;
    search(starts);
    refine_substeps();
    refine_starts();
    result_.derivatives = projection_->derivatives();
  });
  if (best_)
    finish();
  else if (result_.stopped)
    result_.error = "it was stopped before anything was found";
  else
    result_.error = first_error_.empty() ? "no start can be simulated" : first_error_;
  result_.runs = model_.runs() - runs_before_;
  result_.failed_runs = model_.failures() - failures_before_;
  result_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return std::move(result_);
}

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
    const auto& info = model_.program().parameters[static_cast<std::size_t>(f.parameter)];
    const auto& path = info.path;
    const auto shown = [&](double si) { return value_text(si, info.unit, info.difference); };
    if (!std::isfinite(f.start) || f.start < f.lower || f.start > f.upper)
      problems.add(
          "start_outside", path,
          fmt::format("the start, {}, is outside the bounds {} ... {}", shown(f.start), shown(f.lower), shown(f.upper)),
          "move the start value or the bounds");
    if (f.log_scale && !(f.start > 0))
      problems.add("start_outside", path, "a logarithmic scale needs a start above zero",
                   "give a positive start value");
  }
  problems.throw_if_any();
}

/// The best so far stays the result of what is broken off.
void Fitting::until_stopped(const std::function<void()>& work) {
  if (result_.stopped) return;
  try {
    work();
  } catch (const Stopped&) {
    result_.stopped = true;
  }
}

bool Fitting::go_on(const char* stage, double fraction) {
  result_.stopped = result_.stopped || stop_asked();
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
  improve_starts(model_, judge_, start, judged_);
  if (options_.scores) result_.before = judge_.score(model_, model_.predict(start, judged_), judged_);
  for (const auto& f : free_) result_.estimates.push_back(estimate_at_start(model_, f));
  for (const int i : projection_->linear()) result_.estimates[static_cast<std::size_t>(i)].linear = true;
  for (const int i : projection_->nonlinear())
    result_.estimates[static_cast<std::size_t>(i)].log_scale = free_[static_cast<std::size_t>(i)].log_scale;
}

// --- scan

/// Tries points side by side; what can be simulated is appended.
void Fitting::try_points(const std::vector<std::vector<double>>& z, std::vector<PointPointer>& points) {
  constexpr std::size_t at_once = 32;
  for (std::size_t first = 0; first < z.size(); first += at_once) {
    if (!go_on("scan", static_cast<double>(first) / static_cast<double>(z.size()))) return;
    const auto last = std::min(z.size(), first + at_once);
    const std::vector<std::vector<double>> some(z.begin() + static_cast<std::ptrdiff_t>(first),
                                                z.begin() + static_cast<std::ptrdiff_t>(last));
    candidates_ += static_cast<long>(some.size());
    std::vector<PointPointer> seen;
    until_stopped([&] { seen = projection_->at_each(some); });
    for (const auto& point : seen) {
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

/// Where the best value of one depends on another (two limits of a drive before a stage that still rings), one sweep
/// ends beside the valley: all are tried again from where the others are by now. Less than half is nothing between
/// values as far apart.
void Fitting::scan_one_by_one(const std::vector<std::vector<double>>& values, std::vector<PointPointer>& points) {
  constexpr int sweeps = 3;
  constexpr double much_better = 0.5;
  PointPointer base = points.empty() ? nullptr : points.front();
  auto z = projection_->start();
  std::size_t settled = 0;  // so many in a row are best beside the others as they are
  for (std::size_t k = 0; k < sweeps * values.size() && settled < values.size(); ++k) {
    const std::size_t axis = k % values.size();
    std::vector<std::vector<double>> wanted;
    for (const double v : values[axis]) {
      if (k >= values.size() && v == z[axis]) continue;
      wanted.push_back(z);
      wanted.back()[axis] = v;
    }
    std::vector<PointPointer> line;
    try_points(wanted, line);
    const auto best = std::min_element(line.begin(), line.end(), [](auto& a, auto& b) { return a->chi2 < b->chi2; });
    const bool first = k < values.size();
    const bool moves = best != line.end() && (first || base == nullptr || (*best)->chi2 < much_better * base->chi2);
    // Where a value moves no row, those that were tried first stand for all.
    if (first || moves) points.insert(points.end(), line.begin(), line.end());
    settled = moves && (*best)->z != z ? 1 : settled + 1;
    if (!moves) continue;
    base = *best;
    z = base->z;
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
  const auto start = projection_->at(projection_->start());
  ++candidates_;
  keep(start);
  if (start->ok) points.push_back(start);
  go_on("scan");
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
  // Where a parameter moves no row (a limit beyond the peaks), one start stands for all of its values.
  const auto alike = [](auto& a, auto& b) { return a->z == b->z || a->chi2 == b->chi2; };
  points.erase(std::unique(points.begin(), points.end(), alike), points.end());
  return points;
}

/// Gives the components of the attractor, which are free parameters, their places among the nonlinear unknowns; true
/// for those that have one.
std::vector<bool> Fitting::place_components(Attractor& attractor) const {
  const auto n = static_cast<std::size_t>(projection_->n_nonlinear());
  std::vector<bool> placed(n, false);
  const auto place = [&](int& component) {
    for (std::size_t k = 0; k < n; ++k) {
      if (place_[static_cast<std::size_t>(projection_->nonlinear()[k])] != static_cast<std::size_t>(component))
        continue;
      component = static_cast<int>(k);
      placed[k] = true;
      return;
    }
    fail("bad_attractor", "attractor", "a parameter of the attractor is not among those searched",
         "free it, and let it be none that linear least squares finds");
  };
  for (auto& c : attractor.components) {
    place(c.component);
    if (c.of >= 0) place(c.of);
  }
  return placed;
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
    plain = place_components(*problem.attractor);
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
  PointPointer least;  // all that there is of the best one where it is stopped
  problem.cost_of_each = [&](const std::vector<Point>& points) {
    std::vector<std::vector<double>> z;
    for (const auto& point : points) z.push_back(z_of(point));
    std::vector<double> costs;
    for (const auto& point : projection_->at_each(z)) {
      costs.push_back(point->ok ? point->chi2 : std::numeric_limits<double>::infinity());
      if (point->ok && (!least || point->chi2 < least->chi2)) least = point;
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
  result_.stopped = result_.stopped || found.stopped;
  if (result_.stopped && least) keep(least);
  if (found.best.empty() || result_.stopped) return;
  const auto point = projection_->at(z_of(found.best));
  keep(point);
  if (!point->ok) return;
  if (!options_.polish) starts.clear();
  starts.insert(starts.begin(), point);
  result_.global_history = found.history;
  result_.convergence = fmt::format("the budget of {} points is used up", options_.global_runs);
}

// --- search

/// False where no parameter moves a row at the start.
bool Fitting::search_from(const std::vector<double>& start) {
  SearchEnd end;
  const auto found = search_locally(
      *projection_, start, options_.max_iterations, tolerance(),
      [&] {
        ++candidates_;
        return go_on("search");
      },
      end, options_.matters);
  if (found) keep(found);
  result_.iterations += end.iterations;
  if ((found && found == best_) || result_.starts == 0) {
    result_.converged = end.converged;
    result_.convergence = end.message;
  }
  ++result_.starts;
  return !end.flat;
}

void Fitting::search(const std::vector<PointPointer>& starts) {
  if (result_.stopped) return keep(starts.front());
  if (projection_->n_nonlinear() == 0) {
    result_.starts = 1;
    result_.converged = true;
    result_.convergence = "linear least squares: exact";
    return;
  }
  if (options_.global.empty() || options_.polish) {
    // From a start where nothing moves a row no search has begun: an effect that is not there yet looks best so.
    int left = std::max(1, options_.refine);
    for (std::size_t i = 0; i < starts.size() && left > 0 && !result_.stopped; ++i)
      left -= search_from(starts[i]->z) ? 1 : 0;
  }
}

double Fitting::steps_of_all() const {
  double steps = 0;
  for (const int r : fitted_) steps += static_cast<double>(model_.steps(r));
  return steps;
}

/// Where the result needs finer substeps than the start, the search goes on with them.
void Fitting::refine_substeps() {
  std::map<int, long> before;
  for (const int r : judged_) before[r] = model_.steps(r);
  const auto remarks =
      model_.choose_substeps(projection_->values(best_->z, best_->theta), judge_.noise().white(), true);
  result_.remarks.insert(result_.remarks.end(), remarks.begin(), remarks.end());
  bool changed = false;
  for (const int r : judged_) changed = changed || model_.steps(r) != before[r];
  if (!changed) return;
  projection_->forget();
  const auto coarse = std::exchange(best_, nullptr);
  PointPointer again;
  until_stopped([&] {
    again = projection_->at(coarse->z);
    keep(again);
  });
  if (!best_) best_ = coarse;  // stopped, or not to be had with finer rows: then as it is with the coarse ones
  if (result_.stopped || !again || !again->ok) return;
  constexpr double iterations = 3;  // fewer than that hardly ever end a search
  const bool in_time =
      iterations * (1 + static_cast<double>(free_.size())) * steps_of_all() <= options_.search_again_steps;
  if (projection_->n_nonlinear() > 0 && in_time) search_from(again->z);
}

/// Where the way from a start to the outputs is not linear, it is found for given values, and these for a given start:
/// in turn, until neither moves, or the steps for searching again are spent.
void Fitting::refine_starts() {
  constexpr int most = 8;
  constexpr double settled = 1e-4;  // of chi2, between one turn and the next
  const double a_run = steps_of_all() / static_cast<double>(std::max<std::size_t>(fitted_.size(), 1));
  const long begun = model_.runs();
  const auto in_time = [&] {
    return a_run * static_cast<double>(model_.runs() - begun) <= options_.search_again_steps;
  };
  for (int turn = 0; turn < most && in_time(); ++turn) {
    const auto values = projection_->values(best_->z, best_->theta);
    if (!improve_starts(model_, judge_, values, judged_)) return;
    projection_->forget();
    const auto before = std::exchange(best_, nullptr);
    until_stopped([&] {
      keep(projection_->at(before->z));
      if (best_ && projection_->n_nonlinear() > 0) search_from(best_->z);
    });
    if (!best_) best_ = before;
    if (result_.stopped || before->chi2 - best_->chi2 <= std::max(settled * before->chi2, options_.matters)) return;
  }
}

FitResult fit(DataModel& model, const NoiseModel& noise, const std::vector<FreeParameter>& free,
              const FitOptions& options) {
  return Fitting(model, noise, free, options).run();
}

}  // namespace hysteron
