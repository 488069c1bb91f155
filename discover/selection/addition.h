// Decides what a rival of the present model is: an effect at a place, or at several like ones, with its laws. Internal
// to discover.
#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "discover/selection/table_model.h"

namespace hysteron {

/// A rival: one effect more than the model it stands on.
struct Addition {
  TriedEffect tried;              ///< effect, place, laws; `candidate` is that of `fitted`
  std::vector<TriedEffect> also;  ///< the same effect at like places, where it enters all of them at once
  int slowness = 0;               ///< the quick ones are asked first
  TableModel fitted;              ///< with its best law
  /// All laws that were fitted, without what they predict.
  std::map<std::size_t, TableModel> by_law{};
};

/// ln of how many ways of saying one effect were tried: among more of them chance finds more.
double ln_tried(const std::vector<Addition>& rivals, const Effect& effect);

/// The rival by one of its laws, at all its places.
std::vector<Choice> term_of(const Addition& rival, std::size_t law);

/// The same by a richer law: what it has in common with the one by which the effect stands in the rival's fitted model
/// begins where that ended, where the law refines it.
std::vector<Choice> richer_term_of(const Addition& rival, std::size_t law);

/// What acts in one of several like blocks acts in all of them: both tanks of a row have a hole for an outlet.
std::vector<Addition> at_like_places(const SearchState& state, const std::vector<Addition>& alone);

/// Effects that stand in a model.
std::set<const Effect*> names_of(const CandidateModel& model);

/// Does the one ask for less to be believed than the other, so that it goes first where it explains as much?
bool is_plainer(const Effect& one, const Effect& other);

/// Why the effect that came last is not itself, though it may fit (Effect::implausible); "" = it is.
std::string why_not_itself(const TableModel& fitted);

}  // namespace hysteron
