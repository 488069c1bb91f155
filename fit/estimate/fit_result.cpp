// What a fit says of its result: estimates, intervals, profiles, and parameters of recordings that were only judged.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/diagram/name_list.h"
#include "fit/estimate/curvature.h"
#include "fit/estimate/determined.h"
#include "fit/estimate/fitting.h"
#include "fit/estimate/profile.h"
#include "fit/model/colour.h"

namespace hysteron {
namespace {

/// "core.weights" of "core.weights[2]", "" for what is no element of a list.
std::string list_of(const std::string& path) {
  return path.empty() || path.back() != ']'
             ? std::string{}
             : path.substr(0, path.find('[', path.rfind('.') == std::string::npos ? 0 : path.rfind('.')));
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

}  // namespace

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
    // In the size of the box, or of the numbers where it is open: a lost motion of 0.1 nm is not zero.
    const double z = best_->z[k];
    const auto near = [&](double bound) {
      return 1e-9 * (std::isfinite(high[k] - low[k]) ? high[k] - low[k] : std::max(std::abs(z), std::abs(bound)));
    };
    e.at_lower = std::isfinite(low[k]) && z <= low[k] + near(low[k]);
    e.at_upper = !e.at_lower && std::isfinite(high[k]) && z >= high[k] - near(high[k]);
  }
  for (std::size_t j = 0; j < best_->bound.size(); ++j) {
    auto& e = result_.estimates[static_cast<std::size_t>(projection_->linear()[j])];
    e.at_lower = best_->bound[j] == Bound::lower;
    e.at_upper = best_->bound[j] == Bound::upper;
  }
}

/// A parameter that no bound holds, and its column of a linear model over [linear, searched].
struct Fitting::Column {
  Sensitive of;
  std::size_t place = 0;
  bool linear = false;
};

std::vector<Fitting::Column> Fitting::columns_at_result() const {
  std::map<std::string, double>
      largest;  // elements of one list share their size: a weight of zero is small against the others
  for (const auto& e : result_.estimates)
    if (const auto list = list_of(e.path); !list.empty()) largest[list] = std::max(largest[list], std::abs(e.used));
  std::vector<Column> columns;
  const auto add = [&](int index, std::size_t place) {
    const auto& e = result_.estimates[static_cast<std::size_t>(index)];
    if (e.at_lower || e.at_upper) return;
    Sensitive s{index, e.log_scale, e.used, std::max(std::abs(e.used), std::abs(e.start)), e.lower, e.upper};
    if (const auto list = list_of(e.path); !list.empty()) s.size = std::max(s.size, largest[list]);
    columns.push_back({s, place, e.linear});
  };
  const auto& linear = projection_->linear();
  for (std::size_t k = 0; k < projection_->nonlinear().size(); ++k) add(projection_->nonlinear()[k], linear.size() + k);
  for (std::size_t j = 0; j < linear.size(); ++j) add(linear[j], j);
  return columns;
}

void Fitting::find_intervals() {
  const auto columns = columns_at_result();
  std::vector<Sensitive> of;
  for (const auto& c : columns) of.push_back(c.of);
  const bool exact = model_.why_not_exact().empty();
  const bool priors = projection_->data_rows() < projection_->rows();
  bool had = false;
  if (!priors && !options_.residual_noise && !options_.keep_neighbourhood) {
    // The triangle of the linear ones is known since they were found: no other is made of all rows.
    LinearizedResidual model;
    had = projection_->linear_model(*best_, true, model);
    if (had) {
      const auto n = static_cast<std::size_t>(model.form.n);
      Dense part(n, columns.size());
      for (std::size_t k = 0; k < columns.size(); ++k)
        for (std::size_t i = 0; i < n; ++i)
          part(i, k) = (columns[k].linear ? -1 : 1) * model.form.r[columns[k].place * n + i];
      for (const double x : part.a)
        if (!std::isfinite(x)) return;
      triangularize(part);
      NormalForm normal(static_cast<int>(columns.size()));
      normal.r = std::move(part.a);
      judge_parameters(normal, of, exact, result_);
    }
  } else {
    had = intervals_by_rows(columns, of, exact);
  }
  if (!had) result_.remarks.push_back("no intervals: the neighbourhood of the result cannot be simulated");
}

/// Where rows count differently, or are wanted themselves.
bool Fitting::intervals_by_rows(const std::vector<Column>& columns, const std::vector<Sensitive>& of, bool exact) {
  Dense nonlinear;
  if (!projection_->jacobian(*best_, options_.intervals, nonlinear)) return false;
  const std::size_t rows = projection_->rows();
  Dense jacobian(rows, columns.size());
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const double* from = columns[k].linear ? best_->columns.col(columns[k].place)
                                           : nonlinear.col(columns[k].place - projection_->linear().size());
    for (std::size_t i = 0; i < rows; ++i) jacobian(i, k) = (columns[k].linear ? -1 : 1) * from[i];
  }
  for (const double x : jacobian.a)
    if (!std::isfinite(x)) return true;
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
    judge_parameters(normal, of, exact, result_, options_.residual_noise ? &coloured : nullptr);
  }
  if (options_.keep_neighbourhood)
    result_.neighbourhood =
        std::make_shared<Neighbourhood>(Neighbourhood{fitted_, best_->residual, std::move(jacobian)});
  return true;
}

ProfileTask Fitting::profile_task() {
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
  return task;
}

/// The profile of a free parameter, made once.
const Profile& Fitting::profile(int which, double fraction) {
  const auto known = profiles_.find(which);
  if (known != profiles_.end()) return known->second;
  auto task = profile_task();
  task.go_on = [&] { return go_on("profile", fraction); };
  std::vector<double> better;
  const auto& e = result_.estimates[static_cast<std::size_t>(which)];
  const Profile& made = profiles_[which] = profile_of(task, which, e.sigma.value_or(0), better);
  if (!better.empty())
    result_.remarks.push_back(fmt::format(
        "the profile of {} passed a better fit than the result: start from other values, or use --starts 50", e.path));
  return made;
}

void Fitting::find_profiles() {
  for (std::size_t n = 0; n < options_.profile.size(); ++n) {
    const auto place = std::find(place_.begin(), place_.end(), static_cast<std::size_t>(options_.profile[n]));
    if (place == place_.end()) continue;
    const double fraction = static_cast<double>(n) / static_cast<double>(options_.profile.size());
    if (!go_on("profile", fraction)) return;
    result_.profiles.push_back(profile(static_cast<int>(place - place_.begin()), fraction));
  }
}

/// What so many profiles take: some ten points to each side, each a search of some steps with a derivative by each of
/// the parameters searched.
double Fitting::steps_of_profiles(std::size_t profiles) const {
  constexpr double searches = 20, steps_of_search = 5;
  double rows = 0;
  for (const int r : fitted_) rows += static_cast<double>(model_.steps(r));
  return static_cast<double>(profiles) * searches * steps_of_search * (1 + projection_->n_nonlinear()) * rows;
}

/// Where the linearization does not hold over an interval, the profile says where it ends; unasked a cheap one only.
void Fitting::bend_intervals() {
  // With weights that are not those of the noise, a rise of chi2 says nothing of an interval.
  if (!options_.intervals || options_.residual_noise || result_.correlated.empty()) return;
  const auto curved = curved_estimates(*projection_, *best_, result_);
  if (curved.empty()) return;
  std::vector<std::string> paths;
  for (const int i : curved) paths.push_back(result_.estimates[static_cast<std::size_t>(i)].path);
  if (!model_.why_not_exact().empty() || !(steps_of_profiles(curved.size()) <= options_.profile_steps)) {
    result_.remarks.push_back(
        fmt::format("the model is not linear over the intervals of {}: follow them with --profile", name_list(paths)));
    return;
  }
  for (std::size_t n = 0; n < curved.size(); ++n) {
    const double fraction = static_cast<double>(n) / static_cast<double>(curved.size());
    if (!go_on("profile", fraction)) return;
    take_interval(curved[n], profile(curved[n], fraction));
  }
  result_.remarks.push_back(
      fmt::format("the model is not linear over the intervals of {}: they are taken from profiles", name_list(paths)));
}

/// An open end reaches to the bound; what is open on both sides, or without a bound there, has no value.
void Fitting::take_interval(int which, const Profile& from) {
  if (result_.stopped) return;  // an end that was not reached is no open end
  auto& e = result_.estimates[static_cast<std::size_t>(which)];
  e.low95 = from.low95.value_or(e.lower);
  e.high95 = from.high95.value_or(e.upper);
  if ((from.low95 || from.high95) && std::isfinite(*e.low95) && std::isfinite(*e.high95)) return;
  result_.undetermined.push_back(
      {{e.path},
       {1.0},
       fmt::format("{} has no value: with the other parameters fitted again it can be changed {} without a worse fit",
                   e.path,
                   from.low95    ? "upwards without limit"
                   : from.high95 ? "downwards without limit"
                                 : "over the whole range of its bounds")});
  e.determined = false;
  e.value.reset();
  e.sigma.reset();
  e.low95.reset();
  e.high95.reset();
  --result_.n_parameters;
  const auto row = static_cast<std::size_t>(std::find(result_.correlated.begin(), result_.correlated.end(), which) -
                                            result_.correlated.begin());
  const std::size_t n = result_.correlated.size();
  std::vector<double> kept;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      if (i != row && j != row) kept.push_back(result_.correlation[i * n + j]);
  result_.correlation = std::move(kept);
  result_.correlated.erase(result_.correlated.begin() + static_cast<std::ptrdiff_t>(row));
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
    SearchEnd end;
    PointPointer point;
    until_stopped([&] {
      point = search_locally(
          projection, projection.start(), options_.max_iterations, tolerance(), [&] { return go_on("search"); }, end);
    });
    result_.iterations += end.iterations;
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

void Fitting::finish() {
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
  until_stopped([&] {
    if ((options_.intervals || options_.keep_neighbourhood) && go_on("intervals")) find_intervals();
  });
  until_stopped([&] { bend_intervals(); });
  until_stopped([&] { find_profiles(); });
  fit_the_waiting();
  put_in_order();
  if (options_.scores)
    until_stopped([&] {
      Trial after = result_.values;
      after.insert(after.end(), options_.fixed.begin(), options_.fixed.end());
      result_.after = judge_.score(model_, model_.predict(after, judged_), judged_);
    });
  if (result_.stopped) result_.convergence = "stopped; the best so far";
  if (result_.chi2 > 3 * result_.n)
    result_.remarks.push_back(
        "the residual is far above the noise and not random: the intervals hold within this model and do not say that the model is right");
}

}  // namespace hysteron
