// Decides how a discovery answers a case of hidden effects: verdict, ranking, place, experiment, predicted rows, in the
// layout that the README of the set asks for. Does not discover.
#pragma once

#include <string>
#include <vector>

#include "benchmarks/hidden_case.h"
#include "discover/search/discovery.h"

namespace hysteron {

/// Names, most likely first: what was claimed, what explains the recordings as well, then whatever else was tried on
/// the base, by its score. One place for the order in which a person should think of them.
std::vector<std::string> ranked_effects(const Discovery& found);

/// Writes ID.json, ID.diagram.json and ID.predicted/ into the folder `results`, and ID.data.json anew where inputs
/// were found to move otherwise between their samples. seconds: of the processor that the discovery took.
void write_hidden_answer(const HiddenCase& hidden, const DataSet& data, const Discovery& found, double seconds,
                         const std::string& results);

}  // namespace hysteron
