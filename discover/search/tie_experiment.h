// Decides which experiment a tie of candidates asks for. Internal to discover; of two candidates see books.h.
#pragma once

#include "discover/search/books.h"

namespace hysteron {

/// The experiment of a tie that another rival joins: chosen anew, to tell all of them apart.
Separation with_another_rival(Books& books, const Experiment& so_far, const Tried& rival);

}  // namespace hysteron
