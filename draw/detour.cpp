// A shortest way by A* (Hart, Nilsson, Raphael 1968) on the lines along which a wire may run: past the borders of the
// blocks and through its own ends. Only blocks near the wire are looked at; where these leave no way, all are.
#include "draw/detour.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>

#include "draw/route.h"

namespace hysteron::draw {
namespace {

constexpr double clear = 10;     // between a wire and a block that it passes
constexpr double lead = 14;      // straight before an input and behind an output: the arrow, the unit
constexpr double bend = 24;      // costs as much as so many pixels
constexpr double crossing = 30;  // of another wire
constexpr double along = 40;     // per pixel would be more than any way: per piece that lies on another wire, and
constexpr double along_px = 3;   // ... per pixel of it
constexpr double around = 240;   // blocks so far from the ends are looked at first
constexpr double too_near = 4;   // wires nearer than this would look like one

struct Box {
  double left = 0, top = 0, right = 0, bottom = 0;
};

struct Piece {
  Point a, b;
  int net = 0;  ///< of one output: these may share
};

enum Way { level, upright };

class Search {
 public:
  Search(const std::vector<Box>& boxes, const std::vector<Piece>& pieces, int net, Point from, Point to)
      : boxes_(boxes), pieces_(pieces), net_(net), from_(from), to_(to) {
    add_lines();
  }

  /// From end to end; empty where there is no way.
  std::vector<Point> run(Way first, Way last) {
    const std::size_t start = node(index(xs_, from_.x), index(ys_, from_.y), first);
    const std::size_t goal = node(index(xs_, to_.x), index(ys_, to_.y), last);
    cost_.assign(2 * xs_.size() * ys_.size(), std::numeric_limits<double>::infinity());
    before_.assign(cost_.size(), none);
    cost_[start] = 0;
    open_.push({estimate(start), start});
    while (!open_.empty()) {
      const auto [reached, at] = open_.top();
      open_.pop();
      if (at == goal) return path_to(goal);
      if (reached > cost_[at] + estimate(at) + 1e-9) continue;
      go_on(at);
    }
    return {};
  }

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  void add_lines() {
    for (const auto& p : {from_, to_}) xs_.push_back(p.x), ys_.push_back(p.y);
    xs_.push_back(std::round((from_.x + to_.x) / 2));
    ys_.push_back(std::round((from_.y + to_.y) / 2));
    for (const auto& box : boxes_) {
      for (const double more : {0.0, clear}) {
        xs_.insert(xs_.end(), {box.left - more, box.right + more});
        ys_.insert(ys_.end(), {box.top - more, box.bottom + more});
      }
    }
    for (auto* lines : {&xs_, &ys_}) {
      std::sort(lines->begin(), lines->end());
      lines->erase(std::unique(lines->begin(), lines->end()), lines->end());
    }
  }

  static std::size_t index(const std::vector<double>& lines, double at) {
    return static_cast<std::size_t>(std::lower_bound(lines.begin(), lines.end(), at) - lines.begin());
  }
  std::size_t node(std::size_t x, std::size_t y, Way way) const {
    return 2 * (y * xs_.size() + x) + (way == level ? 0 : 1);
  }
  Point point(std::size_t node) const { return {xs_[node / 2 % xs_.size()], ys_[node / 2 / xs_.size()]}; }
  static Way way(std::size_t node) { return node % 2 == 0 ? level : upright; }
  double estimate(std::size_t node) const {
    const Point p = point(node);
    const bool off = p.x != to_.x && p.y != to_.y;
    return std::abs(p.x - to_.x) + std::abs(p.y - to_.y) + (off ? bend : 0);
  }

  void go_on(std::size_t at) {
    const std::size_t x = at / 2 % xs_.size(), y = at / 2 / xs_.size();
    reach(at, at ^ 1U, bend);
    if (way(at) == level) {
      if (x > 0) step(at, node(x - 1, y, level));
      if (x + 1 < xs_.size()) step(at, node(x + 1, y, level));
    } else {
      if (y > 0) step(at, node(x, y - 1, upright));
      if (y + 1 < ys_.size()) step(at, node(x, y + 1, upright));
    }
  }

  void step(std::size_t at, std::size_t next) {
    const Point a = point(at), b = point(next);
    if (is_blocked(a, b)) return;
    reach(at, next, std::abs(a.x - b.x) + std::abs(a.y - b.y) + disturbance(a, b));
  }

  void reach(std::size_t at, std::size_t next, double more) {
    const double cost = cost_[at] + more;
    if (cost >= cost_[next] - 1e-9) return;
    cost_[next] = cost;
    before_[next] = at;
    open_.push({cost + estimate(next), next});
  }

  bool is_blocked(const Point& a, const Point& b) const {
    const auto [left, right] = std::minmax(a.x, b.x);
    const auto [top, bottom] = std::minmax(a.y, b.y);
    return std::any_of(boxes_.begin(), boxes_.end(), [&, l = left, r = right, t = top, u = bottom](const Box& box) {
      return r > box.left && l < box.right && u > box.top && t < box.bottom;
    });
  }

  /// What other wires make of this piece.
  double disturbance(const Point& a, const Point& b) const {
    const bool is_level = a.y == b.y;
    const auto [low, high] = is_level ? std::minmax(a.x, b.x) : std::minmax(a.y, b.y);
    double sum = 0;
    for (const auto& piece : pieces_) {
      if (piece.net == net_) continue;
      const bool other_level = piece.a.y == piece.b.y;
      const auto [from, to] = other_level ? std::minmax(piece.a.x, piece.b.x) : std::minmax(piece.a.y, piece.b.y);
      const double line = other_level ? piece.a.y : piece.a.x, here = is_level ? a.y : a.x;
      if (other_level == is_level) {
        const double shared = std::min(high, to) - std::max(low, from);
        if (shared > 0 && std::abs(line - here) < too_near) sum += along + along_px * shared;
      } else if (here > from && here < to && line > low && line <= high) {
        sum += crossing;
      }
    }
    return sum;
  }

  std::vector<Point> path_to(std::size_t goal) const {
    std::vector<Point> path;
    for (std::size_t at = goal; at != none; at = before_[at]) path.push_back(point(at));
    std::reverse(path.begin(), path.end());
    return path;
  }

  using Reached = std::pair<double, std::size_t>;
  const std::vector<Box>& boxes_;
  const std::vector<Piece>& pieces_;
  int net_;
  Point from_, to_;
  std::vector<double> xs_{}, ys_{}, cost_{};
  std::vector<std::size_t> before_{};
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> open_{};
};

class Detours {
 public:
  Detours(Sheet& sheet, const std::set<int>& wires) : sheet_(sheet), wires_(wires) {
    for (std::size_t w = 0; w < sheet.wires.size(); ++w)
      if (!wires.contains(static_cast<int>(w))) add_pieces(static_cast<int>(w));
  }

  void run() {
    std::vector<int> order(wires_.begin(), wires_.end());
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return distance(a) < distance(b); });
    for (const int w : order) {
      Wire& wire = sheet_.wires[static_cast<std::size_t>(w)];
      wire.path = way_of(wire);
      add_pieces(w);
    }
  }

 private:
  const Item& item(int i) const { return sheet_.items[static_cast<std::size_t>(i)]; }
  Point start(const Wire& wire) const {
    const Point port = out_port(item(wire.from), wire.out);
    return {item(wire.from).x + port.x, item(wire.from).y + port.y};
  }
  Point end(const Wire& wire) const {
    const Point port = in_port(item(wire.to), wire.in);
    return {item(wire.to).x + port.x, item(wire.to).y + port.y};
  }
  double distance(int w) const {
    const Wire& wire = sheet_.wires[static_cast<std::size_t>(w)];
    return std::abs(start(wire).x - end(wire).x) + std::abs(start(wire).y - end(wire).y);
  }
  int net_of(const Wire& wire) const { return 1000 * wire.from + wire.out; }

  void add_pieces(int w) {
    const Wire& wire = sheet_.wires[static_cast<std::size_t>(w)];
    for (std::size_t i = 1; i < wire.path.size(); ++i)
      pieces_.push_back({wire.path[i - 1], wire.path[i], net_of(wire)});
  }

  Side side_of(const Wire& wire) const {
    const auto& sides = item(wire.to).side;
    return static_cast<std::size_t>(wire.in) < sides.size() ? sides[static_cast<std::size_t>(wire.in)] : Side::left;
  }

  /// The symbol with room around it, and what is written below.
  static Box box_of(const Item& item) {
    const Room room = room_of(item);
    const double middle = item.x + item.width() / 2;
    const bool is_sum = item.symbol.outline == Outline::circle;
    const double half = is_sum ? item.width() / 2 : std::max(room.left, item.width() / 2);
    return {std::min(item.x - clear, middle - half), item.y - clear,
            std::max(item.x + item.width() + clear, middle + half),
            item.y + item.height() + (is_sum ? clear : std::max(clear, room.below))};
  }

  std::vector<Box> boxes_near(const Point& a, const Point& b, double reach) const {
    std::vector<Box> near;
    for (const auto& i : sheet_.items) {
      const Box box = box_of(i);
      if (box.right >= std::min(a.x, b.x) - reach && box.left <= std::max(a.x, b.x) + reach &&
          box.bottom >= std::min(a.y, b.y) - reach && box.top <= std::max(a.y, b.y) + reach)
        near.push_back(box);
    }
    return near;
  }

  std::vector<Piece> pieces_near(const std::vector<Box>& boxes) const {
    Box all{from_.x, from_.y, from_.x, from_.y};
    const auto see = [&](double x, double y) {
      all.left = std::min(all.left, x), all.right = std::max(all.right, x);
      all.top = std::min(all.top, y), all.bottom = std::max(all.bottom, y);
    };
    see(to_.x, to_.y);
    for (const auto& box : boxes) see(box.left - clear, box.top - clear), see(box.right + clear, box.bottom + clear);
    std::vector<Piece> near;
    for (const auto& p : pieces_)
      if (std::max(p.a.x, p.b.x) >= all.left && std::min(p.a.x, p.b.x) <= all.right &&
          std::max(p.a.y, p.b.y) >= all.top && std::min(p.a.y, p.b.y) <= all.bottom)
        near.push_back(p);
    return near;
  }

  /// Does a straight piece between two blocks meet no other?
  bool is_free(const Point& a, const Point& b, const Wire& wire) const {
    for (int i = 0; i < static_cast<int>(sheet_.items.size()); ++i) {
      const Item& other = item(i);
      if (i == wire.from || i == wire.to || b.x <= other.x || a.x >= other.x + other.width()) continue;
      if (a.y > other.y - too_near && a.y < other.y + other.height() + room_of(other).below) return false;
    }
    return std::none_of(pieces_.begin(), pieces_.end(), [&](const Piece& p) {
      return p.net != net_of(wire) && p.a.y == p.b.y && std::abs(p.a.y - a.y) < too_near &&
             std::max(p.a.x, p.b.x) > a.x && std::min(p.a.x, p.b.x) < b.x;
    });
  }

  std::vector<Point> way_of(const Wire& wire) {
    const Point begin = start(wire), last = end(wire);
    const Side side = side_of(wire);
    if (side == Side::left && begin.y == last.y && begin.x < last.x && is_free(begin, last, wire)) return {begin, last};
    // The leads reach beyond the boxes of the two ends, in which no way begins.
    from_ = {std::max(begin.x + lead, box_of(item(wire.from)).right), begin.y};
    const Box target = box_of(item(wire.to));
    to_ = side == Side::left  ? Point{std::min(last.x - lead, target.left), last.y}
          : side == Side::top ? Point{last.x, std::min(last.y - lead, target.top)}
                              : Point{last.x, std::max(last.y + lead, target.bottom)};
    for (const double reach : {around, std::numeric_limits<double>::infinity()}) {
      const auto boxes = boxes_near(from_, to_, reach);
      const auto pieces = pieces_near(boxes);
      const auto found =
          Search(boxes, pieces, net_of(wire), from_, to_).run(level, side == Side::left ? level : upright);
      if (found.empty()) continue;
      std::vector<Point> path{begin};
      path.insert(path.end(), found.begin(), found.end());
      path.push_back(last);
      return simplified(path);
    }
    // Blocks that lie on each other leave no way: a wire is drawn all the same.
    const double middle = std::round((from_.x + to_.x) / 2);
    return simplified({begin, from_, {middle, from_.y}, {middle, to_.y}, to_, last});
  }

  Sheet& sheet_;
  const std::set<int>& wires_;
  std::vector<Piece> pieces_{};
  Point from_{}, to_{};
};

}  // namespace

void lead_anew(Sheet& sheet, const std::set<int>& wires) { Detours(sheet, wires).run(); }

}  // namespace hysteron::draw
