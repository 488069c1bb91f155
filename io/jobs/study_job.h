// Decides how a study stands in a job ("do": "study", docs/study.md): what is varied, what is taken from each
// simulation, what is kept and drawn. Reads it and checks the names that the job itself gives; does not know the
// diagram's signals, parameters and units (fit/study/study_problem.h).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/jobs/job_file.h"
#include "io/jobs/runs_job.h"

namespace hysteron {

/// How one parameter is drawn.
struct DrawnParameterWish {
  WrittenText parameter;
  std::optional<WrittenNumber> from{}, to{};
  bool log = false;
  std::uint64_t points = 0;             ///< of a grid
  std::vector<WrittenNumber> values{};  ///< of a list or a grid
  std::string file{};                   ///< a CSV that holds them ...
  WrittenText column{};                 ///< ... in this column
};

/// One of the numbers that are combined: a parameter, a feature that stands before, or a constant.
struct OperandWish {
  WrittenText name;
  std::optional<WrittenNumber> constant{};
};

struct FeatureWish {
  std::string name, pointer, remark;
  WrittenText take;                     ///< one of study_takes(), or of combinations()
  std::vector<OperandWish> operands{};  ///< of a combination
  WrittenText of;
  std::optional<WrittenText> minus{}, over{};  ///< signals
  std::string minus_file{};                    ///< or: a CSV whose ...
  WrittenText minus_column{};                  ///< ... column is subtracted, by straight lines between its rows
  Window between;
  bool rezero = false;
  std::optional<WrittenNumber> at{};
  std::optional<WrittenText> unit{};  ///< in which it is shown, compared and kept
};

/// Bounds of a parameter or a feature.
struct ConditionWish {
  std::string pointer;
  WrittenText feature;
  std::optional<WrittenNumber> above{}, at_least{}, below{}, at_most{};
};

struct StudyAxisWish {
  WrittenText feature;
  std::string label;
  std::optional<WrittenNumber> from{}, to{};
  bool log = false;
};

struct StudyPlotWish {
  std::string title, caption, pointer;
  StudyAxisWish x;
  std::optional<StudyAxisWish> y{};  ///< of a scatter plot; without it a histogram
  int bins = 30;
  bool all = false;  ///< of all draws, not of the accepted ones
  std::vector<ConditionWish> where{};
};

struct StudyJob {
  std::string file, name;  ///< name = stem of the file
  std::string title, source, remark, diagram;
  std::vector<Override> choose{}, set{};
  std::optional<WrittenNumber> until{}, every{}, step{};
  std::optional<WrittenText> solver{};  ///< one of method_names() of the engine
  WrittenText method;                   ///< of sampling
  std::uint64_t seed = 1;
  std::optional<std::uint64_t> draws{}, accepted{}, give_up_after{};
  int shards = 16;
  bool simulate_refused = false;  ///< parameter values that a block refuses
  bool keep_all = false;
  std::vector<DrawnParameterWish> parameters{};
  std::vector<FeatureWish> features{};
  std::vector<ConditionWish> filters{};
  std::vector<StudyPlotWish> plots{};
};

/// What can be taken from a trace while it is simulated.
const std::vector<std::string>& study_takes();
const std::vector<std::string>& study_sampling_methods();

/// Throws Error with file, line and JSON path for syntax, unknown keys and names, wrong types, a newer format, paths
/// outside the project, and what does not fit the way of sampling.
StudyJob read_study_job(const std::string& file, const std::vector<std::string>& allowed = {});

}  // namespace hysteron
