// Decides how a figure of curves or a waterfall looks without JavaScript and on paper: static SVG.
// Colours are CSS classes of assets/report.css; report.js draws the same picture when the reader zooms.
#pragma once

#include <string>

#include "report/page/prepare.h"

namespace hysteron {

/// <svg class="plot"> of curves or of a waterfall.
std::string figure_svg(const PreparedFigure& figure);

/// The classes of a curve's path; `colour` as in report.css, without its prefix.
std::string curve_css(const PreparedCurve& curve, const std::string& colour);

}  // namespace hysteron
