// Decides what a job asks of a study: signals, parameters and units found in the diagram, numbers in the units of their
// columns; all of it as one text that tells shards of a study apart: study_description.cpp. Does not read files but for
// columns that are sampled or subtracted, and computes nothing.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fit/study/study.h"
#include "io/jobs/study_job.h"

namespace hysteron {

struct StudyAxis {
  int column = 0;
  std::string label{};
  std::optional<double> from{}, to{};  ///< in the unit of the column
  bool log = false;
};

struct StudyPlot {
  std::string title, caption, pointer;
  StudyAxis x{};
  std::optional<StudyAxis> y{};  ///< of a scatter plot
  int bins = 30;
  bool all = false;
  std::vector<Condition> where{};
  int counted = -1;  ///< of a histogram of all draws: its place in Study::histograms
};

struct StudyProblem {
  Study study;
  std::vector<StudyPlot> plots;
};

/// `program`: the diagram of the job with its settings. Throws Error whose paths are JSON pointers into the job:
/// "unknown_parameter", "unknown_signal", "wrong_unit", "bad_range", "bad_value", "empty_window", "no_end_time" ...
StudyProblem study_of(const StudyJob& job, ProgramPointer program);

/// Everything that decides the numbers of a study, as text; the same for the same program and job whatever their files
/// are called and however they are written.
std::string description_of(const Study& study);
/// 16 hexadecimal digits (FNV-1a).
std::string text_digest(const std::string& text);

}  // namespace hysteron
