#include "draw/drawing.h"

#include "draw/layout.h"
#include "draw/svg.h"

namespace hysteron {
namespace {

void set_off(draw::Sheet& sheet, const std::string& path) {
  for (auto& item : sheet.items) {
    const bool inside = path.starts_with(item.path + "/");
    if (!item.is_port() && (item.path == path || (inside && !item.inside))) item.is_new = true;
    if (inside && item.inside) set_off(*item.inside, path);
  }
}

}  // namespace

std::string diagram_svg(const Diagram& diagram, const Program& program, const Registry& registry,
                        const DrawOptions& options) {
  draw::Sheet sheet = draw::sheet_of(diagram, program, registry, options.depth);
  for (const auto& path : options.added) set_off(sheet, path);
  draw::lay_out(sheet);
  if (!options.places.empty()) {
    draw::move_items(sheet, options.places);
    draw::shift_to_corner(sheet);
  }
  return draw::svg_text(sheet, diagram.title);
}

}  // namespace hysteron
