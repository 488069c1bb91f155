// Decides how one figure becomes a picture file of its own. Draws nothing itself (figure_svg.h).
#include <fmt/format.h>

#include "report/assets.h"
#include "report/figure_svg.h"
#include "report/report.h"

namespace hysteron {

std::string figure_file(const Document& document, const Figure& figure) {
  constexpr std::size_t points = 4000;
  std::string svg = figure_svg(prepare(document, figure, points));
  const std::string open = "<svg ";
  svg.insert(open.size(), "xmlns=\"http://www.w3.org/2000/svg\" ");
  svg.insert(svg.find('>') + 1, fmt::format("<style>{}</style>", report_css));
  return svg + '\n';
}

}  // namespace hysteron
