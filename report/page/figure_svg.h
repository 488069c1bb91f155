// Decides how a figure looks without JavaScript and on paper: static SVG (curves, waterfall) or a table of bars.
// Colours are CSS classes of assets/report.css; report.js draws the same picture when the reader zooms.
#pragma once

#include <string>

#include "report/page/prepare.h"

namespace hysteron {

/// <svg class="plot"> of curves or of a waterfall.
std::string figure_svg(const PreparedFigure& figure);

/// Horizontal bars, one row each: label, bar, text.
std::string bars_html(const PreparedFigure& figure);

/// The legend as a list; "" for a single unnamed curve.
std::string legend_html(const PreparedFigure& figure);

}  // namespace hysteron
