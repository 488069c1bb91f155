#include "report/page/figure_file.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "report/page/assets.h"
#include "report/page/canvas.h"
#include "report/page/figure_svg.h"

namespace hysteron {
namespace {

constexpr double legend_height = 24;

struct Legend {
  std::string svg;
  double height = 0;  ///< of its lines
};

/// Names of the curves with a piece of each, above the picture, in as many lines as its width asks for.
Legend legend_of(const PreparedFigure& figure, double width) {
  constexpr double left = 70, sample = 28, gap = 24;
  std::vector<std::vector<std::pair<double, const PreparedCurve*>>> lines(1);
  double x = left;
  for (const auto& curve : figure.curves) {
    const double taken = sample + text_width(curve.name);
    if (x + taken > width && x > left) {
      lines.emplace_back();
      x = left;
    }
    lines.back().emplace_back(x, &curve);
    x += taken + gap;
  }
  Legend legend;
  legend.height = legend_height * static_cast<double>(lines.size());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const double up = legend_height * static_cast<double>(lines.size() - 1 - i);
    for (const auto& [at, curve] : lines[i]) {
      legend.svg +=
          fmt::format("<path class=\"curve line c-{}\" d=\"M{} {}h22\"/>", curve->colour, px(at), px(-8 - up));
      legend.svg += svg_text(at + sample, -4 - up, "start", curve->name);
    }
  }
  return legend;
}

/// Room for it: the view begins so much higher.
void make_room(std::string& svg, const Canvas& canvas, double height) {
  const std::string view = fmt::format("viewBox=\"0 0 {} {}\"", px(canvas.width), px(canvas.height));
  const auto at = svg.find(view);
  if (at != std::string::npos)
    svg.replace(at, view.size(),
                fmt::format("viewBox=\"0 -{} {} {}\"", px(height), px(canvas.width), px(canvas.height + height)));
}

}  // namespace

std::string figure_file(const Document& document, const Figure& figure, std::size_t points) {
  const PreparedFigure prepared = prepare(document, figure, points);
  std::string svg = figure_svg(prepared);
  if (prepared.curves.size() > 1) {
    const Canvas canvas = canvas_of(prepared);
    const Legend legend = legend_of(prepared, canvas.width);
    make_room(svg, canvas, legend.height);
    svg.insert(svg.rfind("</svg>"), legend.svg);
  }
  const std::string open = "<svg ";
  svg.insert(open.size(), "xmlns=\"http://www.w3.org/2000/svg\" ");
  svg.insert(svg.find('>') + 1, fmt::format("<style>{}</style>", report_css));
  return svg + '\n';
}

}  // namespace hysteron
