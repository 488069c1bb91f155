// Decides what is recorded of the laws of a candidate while they compete: what each takes away, and why one was not
// taken. Does not decide which is taken. Internal to discover.
#pragma once

#include <vector>

#include "discover/search/investigation.h"

namespace hysteron {

/// A law as it was fitted, beside the model before it; not taken yet.
TriedLaw tried_law(const Law& law, const CandidateModel& fitted, const ModelError& before);
/// The present law of the candidate begins the record, or is told anew in it.
void record_present(TriedEffect& t, const ModelError& before);
/// One that was tried against it: where it is taken, the present one was not.
void record(std::vector<TriedLaw>& laws, TriedLaw tried);
/// Why a law that was fitted does not take the place of the present one, "" where it explains more. `for_the_same`: so
/// much must the score fall where it has more numbers.
std::string why_no_better(const CandidateModel& fitted, const CandidateModel& present, const Law& present_law,
                          double for_the_same);

}  // namespace hysteron
