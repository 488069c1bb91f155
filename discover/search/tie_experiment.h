// Decides which experiment a tie of candidates asks for. Internal to discover; of two candidates see search_state.h.
#pragma once

#include "discover/search/search_state.h"

namespace hysteron {

/// The experiment of a tie that another rival joins: chosen anew, to tell all of them apart.
Separation with_another_rival(SearchState& state, const Experiment& so_far, const TriedEffect& rival);

}  // namespace hysteron
