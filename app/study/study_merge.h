// Decides how the shards of a study become one file, its numbers and its figures: row by row, so that two million
// samples need no memory. Does not compute samples and does not write the page (study_page.h).
#pragma once

#include <string>
#include <vector>

#include "app/study/study_shards.h"
#include "fit/study/study_problem.h"
#include "io/results/result.h"
#include "io/results/staged_results.h"

namespace hysteron {

/// A column over the accepted samples, in its unit.
struct ColumnSummary {
  std::uint64_t count = 0;
  double smallest = 0, largest = 0, mean = 0, deviation = 0;
};

struct MergedStudy {
  StudyCounts counts;
  std::vector<ColumnSummary> columns;  ///< as Study::columns
  std::vector<Figure> figures;         ///< as StudyProblem::plots
  std::vector<std::string> files;      ///< "study.h5", "study.csv"
  int unsealed = 0;                    ///< shards that do not show whether they have changed since
};

/// Stages study.h5 (and study.csv). Throws Error "missing_shards" that says how they are made (`again`:
/// the command line up to its options).
MergedStudy merge_shards(const StudyFolder& folder, const StudyProblem& problem, const std::string& title, bool csv,
                         const std::string& again, StagedResults& staged);

}  // namespace hysteron
