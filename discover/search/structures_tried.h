// Decides what is recorded of the generic structures that competed: what each takes away, what it had to, and why it
// counted or not. Does not decide whether it counts (conclude.cpp). Internal to discover.
#pragma once

#include <optional>
#include <string>

#include "discover/search/discovery.h"

namespace hysteron {

/// What a structure has to take away, and why it does not count all the same; "" = it does.
struct Requirement {
  std::optional<double> needed{};  ///< of chi2, in the recordings where it was looked for; none where it was not asked
  std::string why_not{};
  bool passed() const { return why_not.empty(); }
};

/// A search for structures, as it was made, and how its best one fared.
struct JudgedSearch {
  StructureSearch search;
  Where where = Where::validation;
  Requirement requirement{};
};

/// The best structure on top of the user's model beside the effects that were selected.
struct CompetingStructure {
  JudgedSearch judged;  ///< its requirement is passed where it is told in place of the effects
  double by = 0;        ///< its score less that of the selected model
};

/// All of them into the record. `why_told`: why the best one is told to people, "" if it is not.
void keep_structures(Discovery& d, const JudgedSearch& judged, LeftBy left_by, const std::string& why_told);

}  // namespace hysteron
