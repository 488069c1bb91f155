// Decides how a structure that no effect explains is shown: what is known of it, when it is there, and where that is in
// the residual. Does not find it (discover/structure/structure.h).
#pragma once

#include "discover/search/discovery.h"
#include "io/results/result.h"
#include "report/pages/curves.h"

namespace hysteron {

/// Sentences, a table of when, and the residual of the recording in which it is most. `document` has the traces of
/// judged_recordings(); of the recordings, only `unseen` are drawn.
Section structure_section(const Document& document, const Discovery& found, const DataModel& model,
                          const std::vector<int>& unseen);

/// Marks the rows of one recording at which the structure is there in the figure of its output's residual; nothing
/// where it has no times.
void mark_structure(Section& section, const Discovery& found, const std::string& recording, const CsvTable& table);

}  // namespace hysteron
