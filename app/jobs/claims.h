// Decides whether a claim holds: each part against its value, all parts of all jobs together. Does not run anything
// itself (job_runs.h) and does not print.
#pragma once

#include <string>
#include <vector>

#include "app/jobs/job_runs.h"
#include "io/jobs/claims_file.h"

namespace hysteron {

/// What a condition of one job came to.
struct PartOutcome {
  std::string job, id;
  bool holds = false;
  std::string came_out, expected;  ///< "6.616718 um", "6.616718 um +- 1e-06 um (thesis 6.6 um)"
  std::string remark;
};

/// What the parts of all jobs that were run come to.
struct ClaimOutcome {
  PublishedClaim claim;
  std::vector<PartOutcome> parts;
  std::string outcome;  ///< "agrees", "calibrated", "differs", "cannot be checked"
  std::string reason;   ///< why it cannot be checked
  bool holds() const { return outcome == "agrees" || outcome == "calibrated"; }
};

PartOutcome judge(JobRunner& runner, const ClaimPart& part);

/// Claims of `published` that have parts, or all of them whose id begins with one of `prefixes`; then those of parts
/// that nobody has published.
std::vector<ClaimOutcome> judge_all(const std::vector<PublishedClaim>& published, const std::vector<PartOutcome>& parts,
                                    const std::vector<std::string>& prefixes);

}  // namespace hysteron
