// Decides what stands beside the code for people: how it is called, what it remembers and costs, what it was made of
// and how far it is from the diagram. Does not measure.
#pragma once

#include <string>
#include <vector>

#include "export/c/c_source.h"

namespace hysteron {

/// What was measured in the engine.
struct CFindings {
  std::vector<std::string> replaced;  ///< SampledForm::replaced
  std::vector<double> off;            ///< per output: largest difference of the sampled form from the diagram [SI]
  std::string rows_from;              ///< "the diagram's own signals"
  std::size_t rows = 0;
};

/// Markdown.
std::string c_page(const CPlan& plan, const CSource& source, const CWish& wish, const CFindings& findings);

/// "drive: at most 0.0012 V". off [SI].
std::string deviation_text(const CPort& port, double off);

}  // namespace hysteron
