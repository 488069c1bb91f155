// Decides how the outcomes and curves of one version are kept and held against those of the next.
// Does not decide what a claim is (claims.h).
#pragma once

#include <string>
#include <vector>

#include "app/jobs/claims.h"
#include "io/data/csv.h"

namespace hysteron {

struct BaselineAnswer {
  bool kept = false;                 ///< there was none: this one is kept
  std::vector<std::string> worse;    ///< claims that held before and do not any more
  std::vector<std::string> better;   ///< claims that hold now and did not
  std::vector<std::string> changed;  ///< curves that differ, and by how much
  std::vector<std::string> added;    ///< claims and curves that it did not have, kept now
};

/// Keeps outcomes and curves in `folder` if it has none yet; else holds these against them, and adds what it lacks.
/// `everything`: all figures were made, and a claim that is gone does not hold any more.
/// A curve differs where a value differs by more than a millionth of the column's span. Throws Error "no_file" ... and
/// "bad_baseline".
BaselineAnswer hold_against(const std::string& folder, const std::vector<ClaimOutcome>& claims,
                            const std::vector<CsvTable>& traces, bool everything);

}  // namespace hysteron
