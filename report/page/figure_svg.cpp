#include "report/page/figure_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "report/page/canvas.h"
#include "report/page/decimate.h"
#include "report/page/html.h"
#include "report/page/waterfall_svg.h"

namespace hysteron {
namespace {

/// Of the static picture: two points per pixel draw the same line as all of them.
constexpr std::size_t points_per_curve = 2000;

/// Which colour of the scale of time.
int shade_of(double gone) { return std::clamp(static_cast<int>(gone * shades), 0, shades - 1); }

/// SVG path data of some points of a curve: a line, a staircase (a value holds until the next), or dots.
std::string path_of(const PreparedCurve& curve, std::span<const std::size_t> points, const Canvas& canvas) {
  std::string d;
  bool pen_down = false;
  for (const auto i : points) {
    const double x = curve.x[i], y = curve.y[i];
    if (!std::isfinite(x) || !std::isfinite(y) || (canvas.x.log && !(x > 0)) || (canvas.y.log && !(y > 0))) {
      pen_down = false;
      continue;
    }
    const std::string at_x = px(canvas.x(x)), at_y = px(canvas.y(y));
    if (curve.style == "points")
      d += "M" + at_x + " " + at_y + "h0";
    else if (!pen_down)
      d += "M" + at_x + " " + at_y;
    else if (curve.style == "steps")
      d += "H" + at_x + "V" + at_y;
    else
      d += "L" + at_x + " " + at_y;
    pen_down = true;
  }
  return d;
}

/// One path; where time is shown by colour, one for each colour of its scale, each from where the last one ended.
std::string paths_of(const PreparedCurve& curve, const Canvas& canvas) {
  const auto points = decimate(curve.x, curve.y, points_per_curve);
  const auto path = [&](std::size_t from, std::size_t to, const std::string& colour) {
    return fmt::format("<path class=\"{}\" d=\"{}\"/>", curve_css(curve, colour),
                       path_of(curve, std::span(points).subspan(from, to - from), canvas));
  };
  if (curve.shade.empty()) return path(0, points.size(), curve.colour);
  std::string out;
  for (std::size_t from = 0; from < points.size();) {
    const int shade = shade_of(curve.shade[points[from]]);
    std::size_t to = from + 1;
    while (to < points.size() && shade_of(curve.shade[points[to]]) == shade) ++to;
    out += path(from, std::min(points.size(), to + 1), fmt::format("t{}", shade));
    from = to;
  }
  return out;
}

/// Does a part of the curve lie outside the axes? Only where a figure wishes for its ranges.
bool leaves(const PreparedCurve& curve, const Canvas& canvas) {
  const double foot = canvas.height - canvas.bottom, right = canvas.width - canvas.right;
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    const double x = canvas.x(curve.x[i]), y = canvas.y(curve.y[i]);
    if (x < canvas.left - 1 || x > right + 1 || y < canvas.top - 1 || y > foot + 1) return true;
  }
  return false;
}

/// A picture within the picture: nothing is drawn beyond its edge.
std::string within_axes(const std::string& path, const Canvas& canvas) {
  const std::string x = px(canvas.left), y = px(canvas.top), width = px(canvas.width - canvas.left - canvas.right),
                    height = px(canvas.height - canvas.top - canvas.bottom);
  return fmt::format("<svg x=\"{0}\" y=\"{1}\" width=\"{2}\" height=\"{3}\" viewBox=\"{0} {1} {2} {3}\">{4}</svg>", x,
                     y, width, height, path);
}

std::string curves_svg(const PreparedFigure& f) {
  const Canvas canvas = canvas_of(f);
  std::string out = canvas.open(f.title) + canvas.y_axis(f.y_label) + canvas.x_axis(f.x_label);
  for (const auto& curve : f.curves) {
    const auto path = paths_of(curve, canvas);
    out += leaves(curve, canvas) ? within_axes(path, canvas) : path;
  }
  if (f.x.empty() || f.y.empty())
    out += svg_text((canvas.left + canvas.width - canvas.right) / 2, canvas.height / 2, "middle", "no values to show");
  return out + "</svg>";
}

}  // namespace

std::string curve_css(const PreparedCurve& curve, const std::string& colour) {
  return fmt::format("curve {}{}{} c-{}", escape(curve.style), curve.few ? " few" : "", curve.under ? " under" : "",
                     colour);
}

std::string figure_svg(const PreparedFigure& figure) {
  return figure.kind == "waterfall" ? (figure.width > 0 ? waterfall_rows_svg(figure) : waterfall_svg(figure))
                                    : curves_svg(figure);
}

}  // namespace hysteron
