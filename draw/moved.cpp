#include "draw/moved.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "draw/detour.h"

namespace hysteron::draw {
namespace {

constexpr double sheet_margin = 12;  // around the sheet

Point end_of(const Sheet& sheet, const Wire& wire, bool at_source) {
  const Item& item = sheet.items[static_cast<std::size_t>(at_source ? wire.from : wire.to)];
  const Point port = at_source ? out_port(item, wire.out) : in_port(item, wire.in);
  return {item.x + port.x, item.y + port.y};
}

/// Does a piece of the way pass through the symbol?
bool passes(const std::vector<Point>& way, const Item& item) {
  for (std::size_t i = 1; i < way.size(); ++i) {
    const auto [left, right] = std::minmax(way[i - 1].x, way[i].x);
    const auto [top, bottom] = std::minmax(way[i - 1].y, way[i].y);
    if (right > item.x && left < item.x + item.width() && bottom > item.y && top < item.y + item.height()) return true;
  }
  return false;
}

/// A step of a pixel or two in a wire looks like a mistake: the block follows its first wire that is nearly straight.
void straighten(Sheet& sheet, std::size_t moved) {
  for (const auto& wire : sheet.wires) {
    const bool starts = wire.from == static_cast<int>(moved), ends = wire.to == static_cast<int>(moved);
    if (starts == ends) continue;
    const double step = end_of(sheet, wire, starts).y - end_of(sheet, wire, !starts).y;
    const bool is_level =
        ends ? sheet.items[moved].side.empty() ||
                   sheet.items[moved].side[static_cast<std::size_t>(wire.in)] == Side::left
             : sheet.items[static_cast<std::size_t>(wire.to)].side.empty() ||
                   sheet.items[static_cast<std::size_t>(wire.to)].side[static_cast<std::size_t>(wire.in)] == Side::left;
    if (!is_level || std::abs(step) > 0.5 * grid) continue;
    sheet.items[moved].y -= step;
    return;
  }
}

}  // namespace

void move_items(Sheet& sheet, const Places& places) {
  std::vector<std::size_t> moved;
  for (std::size_t i = 0; i < sheet.items.size(); ++i) {
    Item& item = sheet.items[i];
    const auto place = places.find(item.name);
    if (place == places.end()) continue;
    item.x = grid * place->second[0];
    item.y = grid * place->second[1];
    moved.push_back(i);
  }
  for (const auto i : moved) straighten(sheet, i);
  std::set<int> concerned;
  for (std::size_t w = 0; w < sheet.wires.size(); ++w) {
    const Wire& wire = sheet.wires[w];
    const bool concerns = std::any_of(moved.begin(), moved.end(), [&](std::size_t i) {
      const int item = static_cast<int>(i);
      return wire.from == item || wire.to == item || passes(wire.path, sheet.items[i]);
    });
    if (concerns) concerned.insert(static_cast<int>(w));
  }
  lead_anew(sheet, concerned);
}

void shift_to_corner(Sheet& sheet) {
  double left = std::numeric_limits<double>::infinity(), top = left, right = -left, bottom = -left;
  const auto see = [&](double x, double y) {
    left = std::min(left, x), top = std::min(top, y), right = std::max(right, x), bottom = std::max(bottom, y);
  };
  for (const auto& item : sheet.items) {
    const Room room = room_of(item);
    const double middle = item.x + item.width() / 2;
    see(middle - room.left, item.y);
    see(middle + room.right, item.y + item.height() + room.below);
  }
  for (const auto& wire : sheet.wires)
    for (const auto& p : wire.path) see(p.x, p.y);
  if (!(left < right)) return;
  const double dx = std::round(sheet_margin - left), dy = std::round(sheet_margin - top);
  for (auto& item : sheet.items) item.x += dx, item.y += dy;
  for (auto& wire : sheet.wires)
    for (auto& p : wire.path) p.x += dx, p.y += dy;
  sheet.width = right + dx + sheet_margin;
  sheet.height = bottom + dy + sheet_margin;
}

}  // namespace hysteron::draw
