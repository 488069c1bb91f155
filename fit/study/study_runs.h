// Decides how the samples of a study are simulated: parameter values in, rows of signals out, several samples at once
// where that is possible. Does not know where the values come from nor what is taken from the rows.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/lanes/lanes.h"
#include "engine/program/program.h"
#include "engine/simulate/simulate.h"

namespace hysteron {

/// What takes the rows. Samples come in batches of `width` lanes, of which the last may be partly unused.
class RowSink {
 public:
  virtual ~RowSink() = default;
  /// Lane l of this batch is sample first + l; lanes from `used` on hold nothing that matters.
  virtual void begin(std::size_t first, int used, int width) = 0;
  /// Each output row in order: signals[s * width + lane] [SI], s in the order of SimulateOptions::signals.
  virtual void row(long k, double t, const double* signals) = 0;
  /// This sample could not be simulated (to its end).
  virtual void fail(int lane, const Problem& problem) = 0;
  virtual void end() = 0;
};

/// One per thread.
class SampleRuns {
 public:
  /// `base`: a run at its start whose numbers all samples share but for `parameters` (places in program.parameters).
  /// `options.signals` names what is recorded.
  SampleRuns(ProgramPointer program, const Run& base, const SimulateOptions& options, std::vector<int> parameters,
             RefusedValues refused = RefusedValues::end_the_run);

  /// Samples that are simulated at once: in lanes where the diagram and the method allow it, else one.
  int width() const { return lanes_ ? Lanes::width : 1; }
  /// values[sample * parameters + parameter] [SI].
  void operator()(std::span<const double> values, RowSink& sink);

 private:
  Run run_of(std::span<const double> values) const;
  void one_by_one(std::span<const double> values, RowSink& sink) const;
  void in_lanes(std::span<const double> values, RowSink& sink);

  ProgramPointer program_;
  Run base_;
  SimulateOptions options_;
  std::vector<int> parameters_;
  RefusedValues refused_;
  std::optional<Lanes> lanes_;
};

}  // namespace hysteron
