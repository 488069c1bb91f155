// Decides how results look to a person: one self-contained HTML page, readable without a network, with zoomable plots.
#pragma once

#include <cstddef>
#include <string>

#include "io/results/result.h"

namespace hysteron {

/// The page of a document: headline, verdict, sentences, warnings, sections with tables and figures.
std::string report_html(const Document& document);

/// One figure (a waterfall, or curves with their names above) as an SVG file that brings its own style, for a README or
/// a paper; drawn from so many points at most.
std::string figure_file(const Document& document, const Figure& figure, std::size_t points = 4000);

}  // namespace hysteron
