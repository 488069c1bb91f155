#include "fit/study/study_runs.h"

#include <algorithm>

namespace hysteron {

SampleRuns::SampleRuns(ProgramPointer program, const Run& base, const SimulateOptions& options,
                       std::vector<int> parameters, RefusedValues refused)
    : program_(std::move(program)),
      base_(base),
      options_(options),
      parameters_(std::move(parameters)),
      refused_(refused) {
  if (why_not_in_lanes(*program_, base_, options_, parameters_).empty())
    lanes_.emplace(program_, base_, options_, parameters_, refused_);
}

Run SampleRuns::run_of(std::span<const double> values) const {
  Run run = base_;
  set_parameters(*program_, run, parameters_, values, refused_);
  reset(*program_, run);
  return run;
}

void SampleRuns::operator()(std::span<const double> values, RowSink& sink) {
  lanes_ ? in_lanes(values, sink) : one_by_one(values, sink);
}

void SampleRuns::in_lanes(std::span<const double> values, RowSink& sink) {
  const std::size_t n = parameters_.size(), samples = n == 0 ? 1 : values.size() / n;
  for (std::size_t first = 0; first < samples; first += Lanes::width) {
    const std::size_t used = std::min<std::size_t>(Lanes::width, samples - first);
    sink.begin(first, static_cast<int>(used), Lanes::width);
    const auto problems = (*lanes_)(values.subspan(first * n, used * n),
                                    [&](long row, double t, const double* signals) { sink.row(row, t, signals); });
    for (std::size_t l = 0; l < used; ++l)
      if (problems[l]) sink.fail(static_cast<int>(l), *problems[l]);
    sink.end();
  }
}

void SampleRuns::one_by_one(std::span<const double> values, RowSink& sink) const {
  const std::size_t n = parameters_.size(), samples = n == 0 ? 1 : values.size() / n;
  std::vector<double> row(options_.signals.size());
  for (std::size_t sample = 0; sample < samples; ++sample) {
    sink.begin(sample, 1, 1);
    try {
      const Traces traces = simulate(*program_, run_of(values.subspan(sample * n, n)), options_);
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
