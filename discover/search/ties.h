// Decides what stands beside a winner that explains the recordings as well, and which experiment would tell. Internal
// to discover.
#pragma once

#include "discover/search/search_state.h"

namespace hysteron {

/// Could the law describe this effect, or what looks like it, besides its own (Law::holds)?
bool could_hold(const SearchState& state, const Law& law, const Effect& e);

/// With spare numbers `t` is the winner itself: who explains no more is no rival of what it can imitate.
bool is_the_winner_and_more(const SearchState& state, const TriedEffect& t, const Effect& winner);

/// A rival of the step's winner, and the experiment that would tell the two, and those before, apart. Both stand last
/// in their models.
void add_tie(SearchState& state, int step, FoundStep& found, const TriedEffect& winner, const TriedEffect& rival);

/// Rivals that all recordings could have told apart are tied by noise, and another recording must be far better than
/// they were. One that no recording could show needs only to be seen.
bool would_tell(const Experiment& experiment, bool hidden);

}  // namespace hysteron
