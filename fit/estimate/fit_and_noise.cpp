// A fit and what its residual says of the noise, one after the other.
#include <algorithm>

#include "engine/diagram/stop.h"
#include "fit/estimate/fit.h"
#include "fit/model/colour.h"

namespace hysteron {
namespace {

/// Once more, with the noise that the residual of the first fit shows in place of that before it.
FitWithNoise fit_again(DataModel& model, const std::vector<FreeParameter>& free, const FitOptions& options,
                       FitResult first, const NoiseModel& before) {
  FitWithNoise both;
  both.noise = before;
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
  if (!result.ok) return both;
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
        "the residual is slower than sensor noise: much of it may be what the model lacks (hysteron diagnose looks for it). The intervals treat it as if it were random");
  result.runs += first.runs;
  result.failed_runs += first.failed_runs;
  result.iterations += first.iterations;
  result.seconds += first.seconds;
  return both;
}

}  // namespace

FitWithNoise fit_and_noise(DataModel& model, const std::vector<FreeParameter>& free, const FitOptions& options) {
  FitWithNoise both;
  both.noise = noise_before_fit(model);
  FitOptions first_options = options;  // its intervals would be thrown away
  first_options.intervals = false;
  first_options.profile.clear();
  first_options.keep_neighbourhood = true;
  both.result = fit(model, both.noise, free, first_options);
  if (!both.result.ok || both.result.stopped) return both;
  try {
    auto again = fit_again(model, free, options, both.result, both.noise);
    if (again.result.ok || !again.result.stopped) return again;
  } catch (const Stopped&) {
  }
  both.result.neighbourhood.reset();  // the first fit stands
  both.result.stopped = true;
  both.result.converged = false;
  both.result.convergence = "stopped; the best so far";
  return both;
}

}  // namespace hysteron
