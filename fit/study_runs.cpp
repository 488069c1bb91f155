#include "fit/study_runs.h"

namespace hysteron {

SampleRuns::SampleRuns(const Program& program, const Run& base, const SimulateOptions& options,
                       std::vector<int> parameters)
    : program_(program), base_(base), options_(options), parameters_(std::move(parameters)) {}

Run SampleRuns::run_of(std::span<const double> values) const {
  Run run = base_;
  for (std::size_t i = 0; i < parameters_.size(); ++i)
    for (const int slot : program_.parameters[static_cast<std::size_t>(parameters_[i])].slots)
      run.p[static_cast<std::size_t>(slot)] = values[i];
  prepare(program_, run);
  reset(program_, run);
  return run;
}

void SampleRuns::operator()(std::span<const double> values, RowSink& sink) {
  const std::size_t n = parameters_.size(), samples = n == 0 ? 1 : values.size() / n;
  std::vector<double> row(options_.signals.size());
  for (std::size_t sample = 0; sample < samples; ++sample) {
    sink.begin(sample, 1, 1);
    try {
      const Traces traces = simulate(program_, run_of(values.subspan(sample * n, n)), options_);
      for (std::size_t k = 0; k < traces.t.size(); ++k) {
        for (std::size_t s = 0; s < row.size(); ++s) row[s] = traces.values[s][k];
        sink.row(static_cast<long>(k), traces.t[k], row.data());
      }
    } catch (const Error& error) {
      sink.fail(0, error.problems.front());
    }
    sink.end();
  }
}

}  // namespace hysteron
