// Decides how one figure becomes a picture file of its own. Draws nothing itself (figure_svg.h).
#include <fmt/format.h>

#include "report/assets.h"
#include "report/canvas.h"
#include "report/figure_svg.h"
#include "report/report.h"

namespace hysteron {
namespace {

constexpr double legend_height = 24;

/// Names of the curves with a piece of each, on a line above the picture.
std::string legend_line(const PreparedFigure& figure) {
  std::string out;
  double x = 70;
  for (const auto& curve : figure.curves) {
    out += fmt::format("<path class=\"curve line c-{}\" d=\"M{} -8h22\"/>", curve.colour, px(x));
    out += svg_text(x + 28, -4, "start", curve.name);
    x += 28 + text_width(curve.name) + 24;
  }
  return out;
}

/// Room for it: the view begins so much higher.
void make_room(std::string& svg, const Canvas& canvas) {
  const std::string view = fmt::format("viewBox=\"0 0 {} {}\"", px(canvas.width), px(canvas.height));
  const auto at = svg.find(view);
  if (at != std::string::npos)
    svg.replace(
        at, view.size(),
        fmt::format("viewBox=\"0 -{} {} {}\"", px(legend_height), px(canvas.width), px(canvas.height + legend_height)));
}

}  // namespace

std::string figure_file(const Document& document, const Figure& figure, std::size_t points) {
  const PreparedFigure prepared = prepare(document, figure, points);
  std::string svg = figure_svg(prepared);
  if (prepared.curves.size() > 1) {
    make_room(svg, canvas_of(prepared));
    svg.insert(svg.rfind("</svg>"), legend_line(prepared));
  }
  const std::string open = "<svg ";
  svg.insert(open.size(), "xmlns=\"http://www.w3.org/2000/svg\" ");
  svg.insert(svg.find('>') + 1, fmt::format("<style>{}</style>", report_css));
  return svg + '\n';
}

}  // namespace hysteron
