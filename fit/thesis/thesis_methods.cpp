#include "fit/thesis/thesis_methods.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include "engine/diagram/error.h"
#include "engine/diagram/stop.h"
#include "fit/estimate/global_search.h"
#include "fit/numerics/median.h"
#include "fit/thesis/slopes_method.h"

namespace hysteron {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// One block between an input of the diagram and a measured output, and the recordings that it is identified on.
class OneBlock {
 public:
  OneBlock(DataModel& model, const std::string& type, const ThesisMethodOptions& options)
      : model_(model), options_(options) {
    const Program& p = model.program();
    std::vector<int> found;
    for (std::size_t b = 0; b < p.blocks.size(); ++b)
      if (p.blocks[b].kernel->declaration.type == type && (options.block.empty() || p.blocks[b].path == options.block))
        found.push_back(static_cast<int>(b));
    if (found.size() != 1)
      fail("no_block", options.block, fmt::format("{} blocks of type {} answer to this", found.size(), type),
           "name the one that is meant by its path");
    block_ = &p.blocks[static_cast<std::size_t>(found[0])];
    const auto input = std::find(p.input_signals.begin(), p.input_signals.end(), block_->source[0]);
    for (int o = 0; o < static_cast<int>(model.outputs().size()); ++o)
      if (p.signals[static_cast<std::size_t>(model.output_signal(o))].block == found[0]) output_ = o;
    if (input == p.input_signals.end() || output_ < 0)
      fail("not_direct", block_->path, "it does not stand alone between an input of the diagram and a measured output",
           "use a fit with another method, which needs no such place");
    drive_ = static_cast<int>(input - p.input_signals.begin());
    recordings_ = options.recordings.empty() ? model.recordings(Role::train) : options.recordings;
  }

  DataModel& model() const { return model_; }
  const BlockInstance& block() const { return *block_; }
  int output() const { return output_; }
  const std::vector<int>& recordings() const { return recordings_; }
  Rows drive(int recording) const { return model_.input(recording, drive_); }
  const Rows& measured(int recording) const { return model_.measured(recording, output_); }
  const Unit& unit() const { return model_.output_unit(output_); }
  const Unit& drive_unit() const { return model_.program().input_units[static_cast<std::size_t>(drive_)]; }

  int parameter(const std::string& name) const { return parameter_index(model_.program(), block_->path + "." + name); }
  double value(const std::string& name) const {
    return model_.program().parameters[static_cast<std::size_t>(parameter(name))].value;
  }
  std::vector<double> list(const std::string& name) const {
    std::vector<double> all;
    for (int i = 0; i < block_->shape.length(name); ++i) all.push_back(value(fmt::format("{}[{}]", name, i)));
    return all;
  }
  void set_list(const std::string& name, std::span<const double> values, std::vector<ParameterValue>& to) const {
    for (std::size_t i = 0; i < values.size(); ++i)
      to.push_back({parameter(fmt::format("{}[{}]", name, i)), values[i]});
  }

  /// Rows of several recordings, one behind the other.
  std::pair<Rows, Rows> together(const std::vector<int>& of) const {
    std::pair<Rows, Rows> all;
    for (const int r : of) {
      const Rows u = drive(r);
      all.first.insert(all.first.end(), u.begin(), u.end());
      all.second.insert(all.second.end(), measured(r).begin(), measured(r).end());
    }
    return all;
  }

  /// Mean |measured - model| over rows that `wanted` names (all where it is empty); zeros that are arbitrary are the
  /// medians of what is left. Infinite where it cannot be simulated.
  double mean_error(const std::vector<ParameterValue>& values, const std::vector<int>& of,
                    const std::vector<std::vector<std::size_t>>& wanted = {}) const {
    const auto prediction = model_.predict(values, of, false);
    if (!prediction.ok) return infinity;
    double sum = 0;
    std::size_t n = 0;
    for (std::size_t i = 0; i < of.size(); ++i) {
      const auto r = static_cast<std::size_t>(of[i]);
      const Rows& y = prediction.y[r][static_cast<std::size_t>(output_)];
      std::vector<double> left;
      if (wanted.empty())
        for (std::size_t k = 0; k < y.size(); ++k) left.push_back(measured(of[i])[k] - y[k]);
      else
        for (const std::size_t k : wanted[i]) left.push_back(measured(of[i])[k] - y[k]);
      const double zero = model_.zero_per_recording(output_) ? median(left) : 0;
      for (const double e : left) sum += std::abs(e - zero);
      n += left.size();
    }
    return n == 0 ? 0 : sum / static_cast<double>(n);
  }

  /// Rows at which the input turns: downwards (local maxima) or upwards.
  std::vector<std::vector<std::size_t>> turns(const std::vector<int>& of, bool maxima) const {
    std::vector<std::vector<std::size_t>> all;
    for (const int r : of) {
      const Rows u = drive(r);
      auto& rows = all.emplace_back();
      for (std::size_t k = 1; k + 1 < u.size(); ++k)
        if (maxima ? u[k] >= u[k - 1] && u[k] > u[k + 1] : u[k] <= u[k - 1] && u[k] < u[k + 1]) rows.push_back(k);
    }
    return all;
  }

  bool go_on(const std::string& stage, double cost) const {
    FitProgress now;
    now.chi2 = cost;
    now.runs = model_.runs();
    now.stage = stage;
    return !options_.progress || options_.progress(now);
  }

 private:
  DataModel& model_;
  const ThesisMethodOptions& options_;
  const BlockInstance* block_ = nullptr;
  int output_ = -1, drive_ = -1;
  std::vector<int> recordings_;
};

std::string in_unit(double si, const Unit& unit) { return fmt::format("{:.4g} {}", si / unit.scale, unit.text); }

ThesisMethodResult by_slopes(const OneBlock& one) {
  const auto& shape = one.block().shape;
  if (shape.text("sides") != "one")
    fail("two_sided", one.block().path, "the slopes of the rising branch tell weights of one-sided operators only",
         "set \"sides\": \"one\", or fit the weights by least squares");
  const auto [u, y] = one.together(one.recordings());
  const auto found = weights_by_slopes(u, y, one.list("thresholds"));
  ThesisMethodResult result;
  one.set_list("weights", found.weights, result.values);
  result.steps.push_back(fmt::format("{} weights from slopes of the rising branch, {} to {} rows each",
                                     found.weights.size(),
                                     *std::min_element(found.samples.begin(), found.samples.end()),
                                     *std::max_element(found.samples.begin(), found.samples.end())));
  return result;
}

/// The four steps for the block tapi.
class TapiSteps {
 public:
  TapiSteps(const OneBlock& one, const ThesisMethodOptions& options)
      : one_(one), options_(options), thresholds_(one.list("thresholds")), t_c_(one.value("t_c")) {
    // The temperature is the block's second input: it must be one of the diagram too.
    const Program& p = one.model().program();
    const auto input = std::find(p.input_signals.begin(), p.input_signals.end(), one.block().source[1]);
    if (input == p.input_signals.end())
      fail("not_direct", one.block().path, "its temperature is no input of the diagram",
           "let the temperature be a column of the recordings");
    const int t = static_cast<int>(input - p.input_signals.begin());
    for (const int r : one.recordings()) {
      const Rows rows = one.model().input(r, t);
      means_.push_back(std::accumulate(rows.begin(), rows.end(), 0.0) / static_cast<double>(rows.size()));
    }
    lowest_ = *std::min_element(means_.begin(), means_.end());
    for (std::size_t i = 0; i < means_.size(); ++i)
      if (means_[i] <= lowest_ + 1) cold_.push_back(one.recordings()[i]);
    temperature_ = 0;
    for (std::size_t i = 0; i < means_.size(); ++i)
      if (means_[i] <= lowest_ + 1) temperature_ += means_[i] / static_cast<double>(cold_.size());
    beta_ = one.value("beta");
    if (!(temperature_ < t_c_))
      fail("above_curie", one.block().path,
           fmt::format("the recordings begin at {:.4g} K, above t_c = {:.4g} K", temperature_, t_c_),
           "give t_c of the material");
  }

  ThesisMethodResult run() {
    classical();
    step("remanence", &TapiSteps::remanence);
    step("saturation", &TapiSteps::saturation);
    step("temperature", &TapiSteps::temperature);
    result_.values = values();
    return result_;
  }

 private:
  bool go_on(const std::string& stage) {
    if (!one_.go_on(stage, error_)) result_.stopped = true;
    return !result_.stopped;
  }

  /// One that is broken off leaves what the steps before it found.
  void step(const char* stage, void (TapiSteps::*work)()) {
    if (!go_on(stage)) return;
    const std::tuple found(p_, bend_, beta_, before_, error_);
    try {
      (this->*work)();
    } catch (const Stopped&) {
      result_.stopped = true;
      std::tie(p_, bend_, beta_, before_, error_) = found;
    }
  }

  std::vector<ParameterValue> values() const {
    std::vector<ParameterValue> v;
    const bool bent = p_ > 0;
    one_.set_list("weights", bent ? tapi_weights(classical_, thresholds_, p_, bend_, top_, options_.rule) : classical_,
                  v);
    v.push_back({one_.parameter("p_s"), bent ? p_ / std::pow(1 - temperature_ / t_c_, beta_) : 0.0});
    if (bent) v.push_back({one_.parameter("a"), bend_ / temperature_});
    v.push_back({one_.parameter("beta"), beta_});
    v.push_back({one_.parameter("before"), before_});
    return v;
  }

  void classical() {
    const auto [u, y] = one_.together(cold_);
    top_ = *std::max_element(u.begin(), u.end());
    classical_ = weights_by_slopes(u, y, thresholds_).weights;
    error_ = one_.mean_error(values(), cold_);
    say(fmt::format("1. {} weights by slopes at {:.4g} K", classical_.size(), temperature_));
  }

  void say(const std::string& what) {
    result_.steps.push_back(fmt::format("{}: mean error {}", what, in_unit(error_, one_.unit())));
  }

  /// `before` from 0 down to minus the largest threshold: what lies below that leaves the same remanence.
  void remanence() {
    const auto minima = one_.turns(cold_, false);
    const auto cost = [&](double before) {
      before_ = before;
      return one_.mean_error(values(), cold_, minima);
    };
    const double range = thresholds_.back();
    double best = 0, least = cost(0);
    if (range > 0) {
      double width = range / 16;
      for (int i = 1; i <= 16; ++i)
        if (const double c = cost(-width * i); c < least) {
          least = c;
          best = -width * i;
        }
      for (; width > 1e-4 * range; width /= 2)
        for (const double at : {best - width / 2, best + width / 2})
          if (at <= 0 && at >= -range)
            if (const double c = cost(at); c < least) {
              least = c;
              best = at;
            }
    }
    before_ = best;
    error_ = one_.mean_error(values(), cold_);
    say("2. remanence of an input of " + in_unit(before_, one_.drive_unit()) + " before the start");
  }

  void saturation() {
    const auto cost = [&](const Point& ln) {
      p_ = std::exp(ln[0]);
      bend_ = std::exp(ln[1]);
      return one_.mean_error(values(), cold_);
    };
    // Several starts: where nearly nothing bends, the cost is flat.
    Point best;
    double least = error_;
    for (const double bend : {0.25, 1.0}) {
      const Point start{std::log(0.3 * bend * top_), std::log(bend * top_)};
      const auto found = minimize_without_slopes(cost, start, {0.3, 0.3}, 1e-6, 600,
                                                 [&](double now) { return one_.go_on("saturation", now); });
      if (found.cost < least) {
        least = found.cost;
        best = found.best;
      }
      result_.stopped = result_.stopped || found.stopped;
      if (found.stopped) break;
    }
    p_ = best.empty() ? 0 : std::exp(best[0]);
    bend_ = best.empty() ? 0 : std::exp(best[1]);
    error_ = one_.mean_error(values(), cold_);
    if (best.empty())
      say("3. no saturation lowers the error");
    else
      say(fmt::format("3. P_s = {}, a T = {} at {:.4g} K", in_unit(p_, one_.drive_unit()),
                      in_unit(bend_, one_.drive_unit()), temperature_));
  }

  void temperature() {
    if (p_ == 0 || *std::max_element(means_.begin(), means_.end()) <= lowest_ + 1) {
      say("4. one temperature only, or no saturation: beta stays as given");
      return;
    }
    const auto maxima = one_.turns(one_.recordings(), true);
    const auto cost = [&](const Point& at) {
      beta_ = at[0];
      return at[0] < 0 ? infinity : one_.mean_error(values(), one_.recordings(), maxima);
    };
    const double given = beta_;
    const auto found = minimize_without_slopes(cost, {std::max(given, 0.5)}, {0.5}, 1e-6, 200,
                                               [&](double now) { return one_.go_on("temperature", now); });
    beta_ = found.best.empty() ? given : found.best[0];
    result_.stopped = result_.stopped || found.stopped;
    error_ = one_.mean_error(values(), one_.recordings());
    say(fmt::format("4. beta = {:.4g} from {} recordings", beta_, means_.size()));
  }

  const OneBlock& one_;
  const ThesisMethodOptions& options_;
  std::vector<double> thresholds_;
  double t_c_ = 0, lowest_ = 0, temperature_ = 0, top_ = 0;
  std::vector<double> means_;
  std::vector<int> cold_;
  std::vector<double> classical_;
  double p_ = 0, bend_ = 0, beta_ = 0, before_ = 0, error_ = 0;
  ThesisMethodResult result_;
};

}  // namespace

std::vector<double> tapi_weights(std::span<const double> classical, std::span<const double> thresholds, double p,
                                 double b, double top, SlopeRule rule) {
  const std::size_t n = classical.size();
  std::vector<double> weights(n);
  double forward = 0, given = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double from = thresholds[i], to = i + 1 < n ? thresholds[i + 1] : std::max(top, from);
    const double h = std::tanh(from / b);
    const double tangent = p / b * (1 - h * h);
    const double s = rule == SlopeRule::tangent || !(to > from) ? tangent : p * (std::tanh(to / b) - h) / (to - from);
    forward += classical[i];
    weights[i] = i == 0 ? forward / (1 + s) : forward - weights[0] * s - given;
    given += weights[i];
  }
  return weights;
}

const std::vector<std::string>& thesis_method_names() {
  static const std::vector<std::string> names{"slopes", "tapi"};
  return names;
}

ThesisMethodResult identify_as_thesis(DataModel& model, const std::string& method, const ThesisMethodOptions& options) {
  const auto& names = thesis_method_names();
  if (std::find(names.begin(), names.end(), method) == names.end())
    fail("unknown_method", "method", fmt::format("the thesis has no method \"{}\"", method),
         did_you_mean(method, names));
  const long before = model.runs();
  const OneBlock one(model, method == "slopes" ? "prandtl_ishlinskii" : "tapi", options);
  if (one.recordings().empty())
    fail("no_recordings", "", "there is no recording to identify on", "give at least one the role train");
  ThesisMethodResult result = method == "slopes" ? by_slopes(one) : TapiSteps(one, options).run();
  const StopScope to_its_end(nullptr);  // one simulation, which says what was found
  result.mean_error = one.mean_error(result.values, one.recordings());
  result.runs = model.runs() - before;
  return result;
}

FitResult fit_as_thesis(DataModel& model, const NoiseModel& noise, const std::string& method,
                        const ThesisMethodOptions& options, std::vector<int> judged) {
  const long before = model.runs(), failed = model.failures();
  if (judged.empty()) {
    const Role roles[] = {Role::train, Role::validate};
    judged = model.recordings(roles);
  }
  const Judge judge(model, noise);
  FitResult result;
  result.before = judge.score(model, model.predict({}, judged), judged);
  auto found = identify_as_thesis(model, method, options);
  const StopScope to_its_end(nullptr);
  result.ok = true;
  result.values = std::move(found.values);
  result.remarks = std::move(found.steps);
  result.stopped = found.stopped;
  result.converged = !found.stopped;
  result.convergence = found.stopped ? "stopped; what the steps so far have found" : "all steps done";
  result.method = fmt::format("{} of the thesis ({})", method, result.values.size());
  for (const auto& v : result.values) {
    const auto& info = model.program().parameters[static_cast<std::size_t>(v.parameter)];
    ParameterEstimate e;
    e.parameter = v.parameter;
    e.path = info.path;
    e.unit = parameter_unit(model.program(), info);
    e.difference = info.difference;
    e.start = info.value;
    e.lower = info.lower;
    e.upper = info.upper;
    e.used = v.value;
    e.value = v.value;
    result.estimates.push_back(std::move(e));
  }
  result.n_parameters = static_cast<int>(result.estimates.size());
  result.after = judge.score(model, model.predict(result.values, judged), judged);
  const auto& fitted = options.recordings.empty() ? model.recordings(Role::train) : options.recordings;
  for (const auto& one : result.after.recordings)
    if (std::find(fitted.begin(), fitted.end(), one.recording) != fitted.end()) {
      result.chi2 += one.chi2;
      result.n += one.n;
    }
  result.s2 = result.chi2 / std::max(1.0, result.n - result.n_parameters);
  result.runs = model.runs() - before;
  result.failed_runs = model.failures() - failed;
  return result;
}

}  // namespace hysteron
