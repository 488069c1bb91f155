#include "draw/branches.h"

#include <algorithm>
#include <set>
#include <utility>

namespace hysteron::draw {
namespace {

bool is_between(double value, double a, double b) { return value >= std::min(a, b) && value <= std::max(a, b); }

/// Do pieces of the signal of `wire` lead away from `p` in three directions at least?
bool parts_at(const Sheet& sheet, const Wire& wire, const Point& p) {
  bool left = false, right = false, up = false, down = false;
  for (const auto& other : sheet.wires) {
    if (other.from != wire.from || other.out != wire.out) continue;
    for (std::size_t i = 1; i < other.path.size(); ++i) {
      const Point &a = other.path[i - 1], &b = other.path[i];
      if (a.y == b.y && p.y == a.y && is_between(p.x, a.x, b.x)) {
        left |= std::min(a.x, b.x) < p.x;
        right |= std::max(a.x, b.x) > p.x;
      }
      if (a.x == b.x && p.x == a.x && is_between(p.y, a.y, b.y)) {
        up |= std::min(a.y, b.y) < p.y;
        down |= std::max(a.y, b.y) > p.y;
      }
    }
  }
  return left + right + up + down >= 3;
}

}  // namespace

std::vector<Point> branches_of(const Sheet& sheet) {
  std::set<std::pair<double, double>> dots;
  for (const auto& wire : sheet.wires)
    for (const Point& p : wire.path)
      if (parts_at(sheet, wire, p)) dots.insert({p.x, p.y});
  std::vector<Point> list;
  for (const auto& [x, y] : dots) list.push_back({x, y});
  return list;
}

}  // namespace hysteron::draw
