// Decides how measured and simulated rows become traces, tables and figures of a report.
// Does not simulate and does not judge (fit/compare/compare.h).
#pragma once

#include <string>
#include <vector>

#include "fit/compare/compare.h"
#include "fit/model/model.h"
#include "io/results/result.h"
#include "report/pages/facts.h"

namespace hysteron {

/// A model's rows beside those of a second one: "before" an effect or a fit and after it.
struct Beside {
  const DataModel* model = nullptr;          ///< for times, inputs and measurements
  const Comparison* now = nullptr;           ///< what is shown as simulated
  const Comparison* before = nullptr;        ///< null = there is none
  std::vector<const Comparison*> between{};  ///< stages on the way from before to now
};

/// In which unit an output is shown: that of the recordings.
Unit output_unit(const DataModel& model, int output);
Unit input_unit(const DataModel& model, int input);

/// One recording: t, inputs, the rate of the main input, and per output measured, simulated, residual (and these
/// before; of the stages between, the residual).
CsvTable recording_table(const Beside& view, int recording, const std::string& file);

/// The column of such a table with the residual of a stage: 0 = before, behind the last of between = now.
std::string residual_column(const Beside& view, const std::string& output, std::size_t stage);

/// In which unit differences of an output are shown: a residual of 1 degC would be read as 274.15 K.
Unit unit_of_differences(const Unit& unit);

/// Column `y` of a trace over its column `x`.
Curve trace_curve(const CsvTable& table, const std::string& x, const std::string& y, const std::string& name,
                  const std::string& style, const std::string& role);

/// Measured and simulated, and the residual, over time; the figures share their time axis. None where the output was
/// not measured.
std::vector<Figure> time_figures(const Beside& view, const CsvTable& table, int output);
/// Those of all outputs.
void add_time_figures(Section& section, const Beside& view, const CsvTable& table);

/// The residual against level and rate of the main input, rising, falling and holding branch apart, over all
/// recordings.
void add_residual_figures(Section& section, const Beside& view, const std::vector<int>& recordings);

/// A bar for each part of each split; lengths are shares of the squared error.
void add_split_figures(Section& section, const DataModel& model, const Comparison& comparison);

/// RMS, peak, NRMSE and fit of each recording and output, and of each role together.
Table metrics_table(const DataModel& model, const Comparison& comparison);
/// The same as facts for programs.
Facts metrics_facts(const DataModel& model, const Comparison& comparison);
Facts split_facts(const DataModel& model, const Comparison& comparison);

/// Recordings of train and validate, in the order of the data set; test recordings are left alone.
std::vector<int> judged_recordings(const DataModel& model);

}  // namespace hysteron
