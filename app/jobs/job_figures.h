// Decides how the figures of a job are drawn: a section of a page, with the curves as tables. Does not run anything
// itself (job_runs.h).
#pragma once

#include <string>
#include <vector>

#include "app/jobs/claims.h"
#include "app/jobs/job_runs.h"
#include "io/results/result.h"

namespace hysteron {

/// "Fig. 2.15" of "fig2_15"; any other name as it is.
std::string figure_name(const std::string& job);

/// The runs that a plot draws: those that it names; else all that have its signals.
std::vector<WrittenText> runs_drawn(JobRunner& runner, const PlotWish& plot);

/// What one job shows; its curves go into traces of their own ("fig2_15-1-none.csv"), its drawings into files.
struct JobPage {
  Section section;
  std::vector<CsvTable> traces;
  std::vector<std::pair<std::string, std::string>> files;
};
JobPage page_of(JobRunner& runner, const std::vector<std::string>& allowed);

/// Claims and what they came to: id, what it says, what came out, expected, outcome.
Table claim_table(const std::vector<ClaimOutcome>& claims);

}  // namespace hysteron
