// Decides how one figure becomes a picture file of its own.
#pragma once

#include <cstddef>
#include <string>

#include "io/results/result.h"

namespace hysteron {

/// One figure (a waterfall, or curves with their names above) as an SVG file that brings its own style, for a README or
/// a paper; drawn from so many points at most.
std::string figure_file(const Document& document, const Figure& figure, std::size_t points = 4000);

}  // namespace hysteron
