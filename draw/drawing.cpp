#include "draw/drawing.h"

#include "draw/layout.h"
#include "draw/svg.h"

namespace hysteron {

std::string diagram_svg(const Diagram& diagram, const Program& program, const Registry& registry,
                        const DrawOptions& options) {
  draw::Sheet sheet = draw::sheet_of(diagram, program, registry, options.depth);
  draw::lay_out(sheet);
  return draw::svg_text(sheet, diagram.title);
}

}  // namespace hysteron
