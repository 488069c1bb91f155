// Decides what the user's model is with everything that nobody knows exactly: where recordings begin, and numbers that
// are known to some per cent. Internal to discover.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "discover/selection/table_model.h"

namespace hysteron {

/// The user's model as written and with its numbers let go; both compete with every effect.
struct Nulls {
  TableModel written, let_go;  ///< let_go is not ok where no number may be let go
  const TableModel& better(const BlockScore& score) const;
  /// The one that leaves less: by it the score is made.
  const TableModel& best() const;
};

/// Fits both. `state.base` is the user's model.
Nulls fit_nulls(const FitSetting& setting, int renewals = most_renewals);

/// Recordings of which nobody says where they begin, and that begin elsewhere than at rest: with a free start each
/// explains more than its states cost. By name.
std::vector<std::string> begin_in_motion(const Diagram& diagram, const DataSet& data, const Registry& registry,
                                         const Effects& effects, const DiscoverOptions& options);

/// The same of those that are taken to begin at rest, beside what was found: a start may show only once what acts
/// strongest is known. None where the score, less what these starts cost, is not by `more` above that of `than`.
std::vector<std::string> begin_in_motion_beside(const FitSetting& setting, const TableModel& found,
                                                const TableModel& than, double more);

/// Numbers of the user's model that may be let go, as written [SI]; empty where they are exact.
std::map<std::string, double> numbers_not_exact(const SearchState& state);

}  // namespace hysteron
