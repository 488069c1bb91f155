// Decides how outputs are taken at the instants that are asked for, while adaptive steps pass them. Internal to
// simulate.
#pragma once

#include <span>
#include <vector>

#include "engine/integrators/integrator.h"
#include "engine/program/steps.h"
#include "engine/simulate/forward_sensitivities.h"
#include "engine/simulate/simulate.h"

namespace hysteron {

class TraceRecorder {
 public:
  /// Evaluates `run` in `work`, which live longer. `instants` [s] increase; there is at least one.
  TraceRecorder(const Program& program, const Run& run, Work& work, std::vector<double> instants,
                std::vector<int> signals);
  /// From now on also d(output)/d(parameter).
  void record_slopes_of(ForwardSensitivities& sensitivities);

  double last() const { return traces_.t.back(); }
  bool done() const { return next_ == traces_.t.size(); }
  /// Outputs before `to` from the interpolation of the solver's last step, which began at `from`. The time that it
  /// takes is added to `seconds`.
  void inside(Integrator& solver, double from, double to, double& seconds);
  /// Outputs at the present time `t`, at states x and dx/dp by columns.
  void due(double t, const double* x, std::span<const double> dx_dp, double& seconds);
  /// What was recorded; nothing is left here.
  Traces take() { return std::move(traces_); }

 private:
  void record(double t, const double* x, std::span<const double> dx_dp);

  const Program& program_;
  const Run& run_;
  Work& work_;
  std::vector<Step> steps_;  // that the recorded signals need
  ForwardSensitivities* sensitivities_ = nullptr;
  Traces traces_;
  std::size_t next_ = 0;  // instant
  std::vector<double> x_inside_, dx_dp_inside_;
  std::vector<std::vector<double>> slopes_now_;
};

}  // namespace hysteron
