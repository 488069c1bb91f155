#include "draw/branches.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace hysteron::draw {
namespace {

bool is_between(double value, double a, double b) { return value >= std::min(a, b) && value <= std::max(a, b); }

using Wires = std::vector<const Wire*>;

/// Do pieces of these wires lead away from `p` in three directions at least?
bool parts_at(const Wires& wires, const Point& p) {
  bool left = false, right = false, up = false, down = false;
  for (const Wire* wire : wires) {
    for (std::size_t i = 1; i < wire->path.size(); ++i) {
      const Point &a = wire->path[i - 1], &b = wire->path[i];
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
  std::map<std::pair<int, int>, Wires> of_signal;
  for (const auto& wire : sheet.wires) of_signal[{wire.from, wire.out}].push_back(&wire);
  std::set<std::pair<double, double>> dots;
  for (const auto& [output, wires] : of_signal)
    for (const Wire* wire : wires)
      for (const Point& p : wire->path)
        if (parts_at(wires, p)) dots.insert({p.x, p.y});
  std::vector<Point> list;
  for (const auto& [x, y] : dots) list.push_back({x, y});
  return list;
}

}  // namespace hysteron::draw
