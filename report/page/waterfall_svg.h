// Decides how an error that falls step by step is drawn: in columns across a page, or in rows where it is narrow.
// Does not decide which steps there are.
#pragma once

#include <string>

#include "report/page/prepare.h"

namespace hysteron {

/// Columns, one beside the other, each with an outline of what it took away; floors as lines across.
std::string waterfall_svg(const PreparedFigure& figure);

/// Rows, one below the other, for a figure of a given width and height: room for long names.
std::string waterfall_rows_svg(const PreparedFigure& figure);

}  // namespace hysteron
