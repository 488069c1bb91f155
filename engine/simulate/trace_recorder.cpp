#include "engine/simulate/trace_recorder.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/program/breakpoints.h"
#include "engine/program/needed.h"
#include "engine/simulate/divergence.h"
#include "engine/simulate/simulate_parts.h"

namespace hysteron {

TraceRecorder::TraceRecorder(const Program& program, const Run& run, Work& work, std::vector<double> instants,
                             std::vector<int> signals)
    : program_(program), run_(run), work_(work), steps_(steps_for(program, signals)), x_inside_(run.x) {
  if (x_inside_.empty()) x_inside_.push_back(0.0);  // the integrators have one dummy state where the program has none
  traces_.t = std::move(instants);
  traces_.values.assign(signals.size(), std::vector<double>(traces_.t.size()));
  traces_.signals = std::move(signals);
}

void TraceRecorder::record_slopes_of(ForwardSensitivities& sensitivities) {
  sensitivities_ = &sensitivities;
  const auto parameters = static_cast<std::size_t>(sensitivities.count());
  dx_dp_inside_.assign(parameters * x_inside_.size(), 0.0);
  traces_.slopes.assign(
      parameters, std::vector<std::vector<double>>(traces_.signals.size(), std::vector<double>(traces_.t.size())));
}

void TraceRecorder::record(double t, const double* x, std::span<const double> dx_dp) {
  evaluate_steps(program_, run_, work_, t, x, steps_);
  for (std::size_t s = 0; s < traces_.signals.size(); ++s) {
    const double value = work_.y[static_cast<std::size_t>(traces_.signals[s])];
    if (!std::isfinite(value)) not_finite(program_, run_, work_, t, x);
    traces_.values[s][next_] = value;
  }
  if (sensitivities_ != nullptr) {
    sensitivities_->outputs(run_, t, {x, static_cast<std::size_t>(program_.n_x)}, dx_dp, traces_.signals, slopes_now_);
    for (std::size_t k = 0; k < slopes_now_.size(); ++k)
      for (std::size_t i = 0; i < slopes_now_[k].size(); ++i) traces_.slopes[k][i][next_] = slopes_now_[k][i];
  }
  ++next_;
}

void TraceRecorder::inside(Integrator& solver, double from, double to, double& seconds) {
  const auto& instants = traces_.t;
  const auto before_end = [&] { return next_ < instants.size() && instants[next_] < to - same_instant(to); };
  if (!before_end()) return;
  const Stopwatch watch(seconds);
  while (before_end()) {
    const double t = std::max(instants[next_], from);
    solver.interpolate(t, x_inside_);
    if (sensitivities_ != nullptr) solver.interpolate_sensitivities(t, dx_dp_inside_);
    record(instants[next_], x_inside_.data(), dx_dp_inside_);
  }
}

void TraceRecorder::due(double t, const double* x, std::span<const double> dx_dp, double& seconds) {
  const auto is_due = [&] { return !done() && traces_.t[next_] <= t + same_instant(t); };
  if (!is_due()) return;
  const Stopwatch watch(seconds);
  while (is_due()) record(t, x, dx_dp);
}

}  // namespace hysteron
