// Decides which numbers of a figure reach the page: curves looked up in the traces, thinned out, coloured, with their
// ranges. Does not draw; figure_svg.h and report.js draw from this alone.
#pragma once

#include <string>
#include <vector>

#include "io/results/result.h"

namespace hysteron {

struct PreparedCurve {
  std::string name;
  std::string style;  ///< "line", "points", "steps"
  std::string
      colour;  ///< CSS class without its prefix: "measured", "simulated", "before", "residual", "floor", "p0" ... "p15"
  std::string source;        ///< "traces/01.csv", or ""
  std::vector<double> x, y;  ///< thinned out to the figure's budget
  std::size_t points = 0;    ///< before that
  bool monotone = false;     ///< x never decreases
  bool few = false;          ///< so few points that each is drawn large
  bool under = false;        ///< measured: drawn as a broad band, so that what lies on it is seen
  /// Share of the time gone at each point, 0 .. 1, where time is shown by colour; else empty.
  std::vector<double> shade{};
};

/// Smallest and largest value; empty = nothing to show.
struct Range {
  double low = 0, high = -1;
  bool empty() const { return !(high >= low); }
};

struct PreparedFigure {
  std::string title, kind, x_label, y_label, caption;
  bool log_x = false, log_y = false;
  std::vector<PreparedCurve> curves;
  std::vector<Bar> bars;
  Range x, y;                        ///< of all points, before thinning out; widened so that it is never a single value
  bool wide = false;                 ///< takes the full width of the page: curves over time, waterfalls
  std::size_t points = 0, kept = 0;  ///< of all curves
  bool part = false;                 ///< shows a chosen part of the x axis
  double width = 0, height = 300;    ///< [px] of the picture; width 0: as wide figures and pairs are
  std::string begins{}, ends{};      ///< of the time shown by colour: "0 s", "60 s"
};

/// Colours of the scale of time (report.css has as many).
constexpr int shades = 12;

/// `budget`: points to embed for all curves of the figure together.
PreparedFigure prepare(const Document& document, const Figure& figure, std::size_t budget);

/// The unit in the brackets at the end of a label: "time [s]" -> "s"; "" if there are none.
std::string unit_of_label(const std::string& label);

/// The number of points that a figure would show if nothing were thinned out.
std::size_t point_count(const Document& document, const Figure& figure);

}  // namespace hysteron
