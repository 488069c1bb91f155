// Decides how results look to a person: one self-contained HTML page, readable without a network, with zoomable plots.
#pragma once

#include <string>

#include "io/results/result.h"

namespace hysteron {

/// The page of a document: headline, verdict, sentences, warnings, sections with tables and figures.
std::string report_html(const Document& document);

}  // namespace hysteron
