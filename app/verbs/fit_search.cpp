#include "app/verbs/fit_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/cli/interrupt.h"
#include "engine/diagram/error.h"
#include "engine/diagram/stop.h"
#include "fit/estimate/beginning.h"
#include "fit/thesis/thesis_methods.h"
#include "report/pages/curves.h"
#include "report/pages/numbers.h"

namespace hysteron {
namespace {

double rms_of(const FitResult& result, const DataModel& model) {
  double sum = 0, rows = 0;
  for (const auto& r : result.after.recordings) {
    if (r.role != Role::train || model.measured(r.recording, 0).empty()) continue;
    const auto n = static_cast<double>(model.measured(r.recording, 0).size());
    sum += n * r.rms[0] * r.rms[0];
    rows += n;
  }
  return rows > 0 ? std::sqrt(sum / rows) : 0;
}

/// The result of one method, whatever its kind.
FitResult result_of(DataModel& model, const NoiseModel& noise, const std::vector<FreeParameter>& free,
                    const FitMethod& method) {
  if (!method.of_thesis) return fit(model, noise, free, method.options);
  ThesisMethodOptions options;
  options.progress = method.options.progress;
  return fit_as_thesis(model, noise, method.name, options);
}

/// Each method from the same start against the same noise; the free parameters begin where the best of them ended,
/// which `best` is.
std::vector<Attempt> attempt_all(DataModel& model, FitProblem& problem, const Watch& watch, FitWithNoise& best) {
  std::vector<Attempt> attempts;
  best.noise = noise_before_fit(model);
  double least = std::numeric_limits<double>::infinity();
  for (auto method : problem.methods) {
    if (watch.stop()) break;
    method.options.intervals = false;
    method.options.profile.clear();
    watch_fit(method.options, watch);
    const FitResult found = result_of(model, best.noise, problem.free, method);
    if (!found.ok && found.stopped) break;
    Attempt a{found.ok ? found.method : method.name, found.ok, found.error};
    a.runs = found.runs;
    a.failed = found.failed_runs;
    a.seconds = found.seconds;
    if (found.ok) {
      a.rms = rms_of(found, model);
      a.chi2 = found.chi2;
      a.n = found.n;
      if (found.chi2 < least) {
        least = found.chi2;
        best.result = found;
      }
    }
    attempts.push_back(std::move(a));
  }
  for (auto& f : problem.free)
    for (const auto& value : best.result.values)
      if (value.parameter == f.parameter && value.recording == f.recording) {
        f.start = std::clamp(value.value, f.lower, f.upper);
        f.scan.clear();
      }
  return attempts;
}

/// The fit that was asked for; of several methods the best, and the search from there. Whoever watches may end it with
/// the best so far.
FitWithNoise search(DataModel& model, FitProblem& problem, const Watch& watch, std::vector<Attempt>& attempts) {
  const StopScope until_interrupted(watch.stop);
  FitOptions options = problem.methods.front().options;
  watch_fit(options, watch);
  FitWithNoise found;
  if (problem.methods.size() == 1 && problem.methods.front().of_thesis) {
    found.noise = noise_before_fit(model);
    problem.methods.front().options = options;
    found.result = result_of(model, found.noise, problem.free, problem.methods.front());
    return found;
  }
  if (problem.methods.size() > 1) {
    attempts = attempt_all(model, problem, watch, found);
    options.global.clear();
    options.starts = 0;
    found.result.stopped = true;  // where nothing follows
    if (watch.stop()) return found;
  }
  auto last = fit_and_noise(model, problem.free, options);
  return last.result.ok || !found.result.ok ? last : found;
}

}  // namespace

void watch_fit(FitOptions& settings, const Watch& watch) {
  settings.progress = [&watch](const FitProgress& now) {
    const double over = std::sqrt(now.chi2 / std::max(1.0, now.rows));
    const bool paced = now.stage == "scan" || now.stage == "global";
    watch.show(paced ? now.fraction : -1,
               fmt::format("{}: best error {} of the noise, {}, {}", now.stage, percent_text(over),
                           count_text(now.candidates, "candidate"), count_text(now.runs, "simulation")));
    return !watch.stop();
  };
}

Fitted fit_and_compare(DataModel& model, FitProblem problem, const Watch& watch) {
  watch.keep();
  const auto free = problem.free;  // with the starts that the user gave
  Trial start_values;
  for (const auto& f : free) start_values.push_back({f.parameter, f.start, f.recording});
  std::vector<Attempt> attempts;
  FitWithNoise with_noise = search(model, problem, watch, attempts);
  const bool of_thesis = problem.methods.size() == 1 && problem.methods.front().of_thesis;
  if (of_thesis) start_values.clear();
  FitResult& result = with_noise.result;
  if (!result.ok && result.stopped) throw_nothing_found();
  if (!result.ok)
    fail_numerics("fit_failed", "fit", result.error, "start from other values, or give the parameters narrower bounds");
  for (std::size_t i = 0; i < free.size() && !of_thesis; ++i) result.estimates[i].start = free[i].start;
  const auto recordings = judged_recordings(model);
  const Judge judge(model, with_noise.noise);
  const Prediction start = model.predict(start_values, recordings);
  const Prediction end = model.predict(result.values, recordings);
  if (!end.ok) fail_numerics("fit_failed", "fit", end.error, "give the parameters narrower bounds");
  Comparison after = compare(model, judge, end, recordings);
  // A start that cannot be simulated is no obstacle to a fit; then there is nothing to show before it.
  Comparison before = start.ok ? compare(model, judge, start, recordings) : after;
  const auto weighed = [&](const Prediction& prediction) {
    if (!prediction.ok) return std::numeric_limits<double>::infinity();
    const Score score = judge.score(model, prediction, recordings);
    return std::sqrt(score.chi2(Role::train) / std::max(1.0, score.n(Role::train)));
  };
  Fitted fitted;
  fitted.weighed_before = weighed(start);
  fitted.weighed_after = weighed(end);
  fitted.by_search = !of_thesis;
  if (!result.stopped) {
    fitted.delays = find_delays(model, judge, end);
    for (const auto& b : begin_elsewhere(model, with_noise.noise, end, result.values, recordings))
      result.remarks.push_back(to_text(model, b));
  }
  fitted.result = std::move(result);
  fitted.noise = std::move(with_noise.noise);
  fitted.before = std::move(before);
  fitted.after = std::move(after);
  fitted.attempts = std::move(attempts);
  return fitted;
}

}  // namespace hysteron
