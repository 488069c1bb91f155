// Decides which numbers of a candidate are free in a fit, where they start and what bounds them. Does not fit
// (fit_candidate_model.h). Internal to discover.
#pragma once

#include <vector>

#include "discover/models/candidate_model.h"

namespace hysteron {

/// The frequency of a known line, while the others are fitted, or by itself.
enum class KnownLines { held, tuned };

/// What the user left free, while an effect is fitted: free too, or as it was found without the effect.
enum class Own { free, held };

/// The free parameters: the user's own, and those of the chosen effects. `fresh` = index of the effect that starts from
/// its law instead of its values, -1 = none; `recordings`: those of which each has its own value.
std::vector<FreeParameter> free_of(const FitContext& context, const CandidateModel& c, const std::vector<bool>& chosen,
                                   int fresh, const std::vector<int>& recordings, KnownLines lines = KnownLines::held,
                                   Own own = Own::free);

/// The free parameters of one law where it stands; `recordings`: those of which each has its own value.
std::vector<FreeParameter> free_of_law(const Program& program, const PlacedEffect& standing, bool is_new,
                                       const std::vector<int>& recordings);

/// Does it look for a line: is one of its parameters the frequency of one.
bool has_line(const Law& law);

/// What a line may do beside being steady is left out of the judgement once it is known, about the frequency that it
/// was found at: another one near by would cost nothing.
bool is_known_line(const FitContext& context, const CandidateModel& c, const PlacedEffect& s, const LawParameter& p);

/// Is it a law of levels that the column itself shows.
bool reads_off_column(const PlacedEffect& standing);

/// What silences such levels while all else is fitted; empty where the candidate has none.
Trial silent_levels(const CandidateModel& c, const Program& program);

}  // namespace hysteron
