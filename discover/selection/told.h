// Decides with which numbers what was found is told: fitted to the recordings that are meant for it, where these show
// it. Does not decide what was found. Internal to discover.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "discover/selection/selection.h"

namespace hysteron {

/// The model that is told: with the fewest of the user's numbers let go, with intervals, and what it is without its
/// last terms.
struct Told {
  std::map<std::string, double> kept;  ///< numbers that are not what is written, as written [SI]
  FitContext context;
  std::vector<CandidateModel> chain;            ///< [k]: with the first k terms; the last is the whole model
  std::vector<std::vector<std::size_t>> terms;  ///< of the whole model
  /// Recordings to fit to do not say how large it is: with the numbers that they determine those to judge are explained
  /// worse than with others, or than without it. So all are fitted to.
  bool fitted_to_all = false;
  /// Effects that had been found and left, by effect and place: why each was not itself with the numbers to be told.
  std::map<std::pair<const Effect*, std::string>, std::string> gone;
};

/// In the recordings of `state`, from what was found in those of `searched`, which may be the same. What is not itself
/// with these numbers (Effect::implausible) was so by chance while it was searched, and leaves the selection.
Told to_be_told(SearchState& state, SearchState& searched, Selection& selection);

/// What was found in a part of the rows is claimed in all of them, those of `all`, as well, and nothing more is left in
/// these.
bool holds(const SearchState& all, const Selection& part, const Told& told);

}  // namespace hysteron
