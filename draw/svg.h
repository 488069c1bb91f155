// Decides how a sheet that is laid out is written as SVG: colours, strokes, texts, arrow heads.
// Does not move anything.
#pragma once

#include <string>

#include "draw/sheet.h"

namespace hysteron::draw {

/// One SVG document. Groups carry what they show: class "block" with data-block and data-type, class "wire" with
/// data-signal, data-from and data-to.
std::string svg_text(const Sheet& sheet, const std::string& title);

}  // namespace hysteron::draw
