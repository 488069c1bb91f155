// Decides how values become places in an SVG: size, margins, scales, and the frame with its grid and labels.
#pragma once

#include <string>
#include <vector>

#include "report/page/prepare.h"
#include "report/page/ticks.h"

namespace hysteron {

/// One axis: values to pixels.
struct Scale {
  Range range;
  bool log = false;
  double from = 0, to = 1;  ///< pixels at range.low and range.high
  double operator()(double value) const;
  Ticks ticks(int count) const;
};

/// The area of a figure in pixels.
struct Canvas {
  double width = 1000, height = 300;
  double left = 70, right = 16, top = 12, bottom = 48;
  Scale x, y;

  std::string open(const std::string& title) const;  ///< "<svg ...><title>...</title>"
  std::string x_axis(const std::string& label) const;
  std::string y_axis(const std::string& label) const;
};

/// The canvas of a figure: margins by its longest label, ranges with some air in y.
Canvas canvas_of(const PreparedFigure& figure);

/// A coordinate with one decimal, no trailing zero.
std::string px(double value);

/// <text> at a place; `anchor` start, middle or end.
std::string svg_text(double x, double y, const std::string& anchor, const std::string& text,
                     const std::string& css_class = "");

/// Width of a text in the figures' font (12 px), estimated: no font is at hand here.
double text_width(const std::string& text);

/// The text in at most `lines` lines of about `width` pixels, broken at spaces and behind underscores; what does not
/// fit ends in an ellipsis.
std::vector<std::string> wrap(const std::string& text, double width, std::size_t lines);

}  // namespace hysteron
