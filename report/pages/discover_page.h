// Decides how a discovery is told: sections, figures, facts, and the files of its folder.
// Does not discover anything.
#pragma once

#include <string>

#include "discover/selection/check.h"
#include "io/results/result.h"
#include "report/pages/inspection_page.h"

namespace hysteron {

struct DiscoveryFiles {
  std::string diagram_file;  ///< as the user named it
  std::string data_file;
  std::string folder;  ///< where the results go
};

/// The document of a discovery (or of a diagnosis): verdict, the fall of the error (discover_fall.h), parameters,
/// residual before and after, candidates, what was refused, the next experiment; each step's diagram as a file of its
/// own.
/// `inspected` is its section on the data. The answer to --check, where that was asked, stands before everything else.
Document discovery_document(const std::string& verb, const Discovery& found, const DataSet& data,
                            const Registry& registry, const Inspected& inspected, const DiscoveryFiles& files,
                            const Check* answer = nullptr);

}  // namespace hysteron
