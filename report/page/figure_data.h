// Decides what report.js is given of a figure: one JSON text. Does not draw.
#pragma once

#include <string>

#include "report/page/prepare.h"

namespace hysteron {

/// JSON of a figure of curves, safe inside a <script> element. `link`: figures with the same text move together in x;
/// may be "".
std::string figure_data(const PreparedFigure& figure, const std::string& link);

}  // namespace hysteron
