// Decides how an inspection reads: the sentences on what the data are.
// Finds nothing itself (inspection.h). Internal to fit/.
#pragma once

#include <string>
#include <vector>

#include "fit/inspect/inspection.h"

namespace hysteron {

std::string count_of(std::size_t n, const std::string& noun);  ///< "1 row", "3 rows"
std::string share_text(double share);                          ///< 0.25: "25 %"
std::string list_text(const std::vector<std::string>& names);  ///< "01.csv, 02.csv and 5 more"

/// What is judged where nothing was fitted: a recording that moves this input a tenth of the fitted range beyond it.
/// "" = none does.
std::string note_of_reach(const Inspection& seen, const std::string& input);

/// What was cut, where, and what it means.
std::string cut_sentence(const InspectedCut& cut);

/// What the data are, most important first: rows, each input, each output, and whether anything was recorded twice.
std::vector<std::string> sentences_of(const Inspection& seen, const std::vector<std::string>& inputs,
                                      const std::vector<std::string>& outputs);

}  // namespace hysteron
