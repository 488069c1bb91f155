#include "draw/layout.h"

#include <vector>

#include "draw/columns.h"
#include "draw/place.h"
#include "draw/route.h"

namespace hysteron::draw {

void lay_out(Sheet& sheet) {
  for (auto& item : sheet.items) {
    if (!item.inside) continue;
    lay_out(*item.inside);
    item.symbol.width = item.inside->width;
    item.symbol.height = item.inside->height + header_height;
  }
  find_feedback(sheet);
  // Two loops that end at one sum do not both come from below: such a sum is a box.
  std::vector<int> returns(sheet.items.size(), 0);
  for (const auto& wire : sheet.wires) returns[static_cast<std::size_t>(wire.to)] += wire.feedback ? 1 : 0;
  for (std::size_t i = 0; i < sheet.items.size(); ++i) {
    Symbol& symbol = sheet.items[i].symbol;
    if (symbol.outline == Outline::circle && returns[i] > 1)
      make_sum_box(symbol, static_cast<int>(sheet.items[i].in.size()));
  }
  assign_columns(sheet);
  const auto nets = nets_of(sheet);
  route(sheet, nets, place_rows(sheet, nets));
}

}  // namespace hysteron::draw
