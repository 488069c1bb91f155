// Wires. Between two columns lies a channel; in it, each net has at most one vertical piece, on a track of its own,
// from where the net comes in at the left to everything that reads it at the right. Tracks are ordered so that pieces
// of different nets never lie on each other and cross as little as may be. Feedback leaves its block to the right, goes
// down to a row below everything that it passes, returns to the left, and comes up: into a sum from below, into
// anything else from the left. Short loops lie above long ones.
#include "draw/route.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace hysteron::draw {
namespace {

constexpr double track = 11;       // between vertical pieces
constexpr double unit_room = 26;   // behind an output: its unit stands there
constexpr double arrow_room = 16;  // before an input
constexpr double row = 15;         // between rows of feedback
constexpr double margin = 12;      // around the sheet
constexpr double same = 4;         // pieces nearer than this would look like one

/// The vertical piece of one net in one channel.
struct Trunk {
  int net = 0;
  std::vector<double> left{}, right{};  ///< heights at which it is joined from the left and from the right
  double x = 0;
  double low() const {
    double least = std::numeric_limits<double>::infinity();
    for (const auto* list : {&left, &right})
      for (const double y : *list) least = std::min(least, y);
    return least;
  }
  double high() const {
    double most = -std::numeric_limits<double>::infinity();
    for (const auto* list : {&left, &right})
      for (const double y : *list) most = std::max(most, y);
    return most;
  }
  bool straight() const { return high() - low() < 1e-6; }
};

/// How a wire ends: the height at which it leaves its channel, and whether it comes from the channel at all.
struct Entry {
  double y = 0;           ///< height of its last horizontal piece
  bool from_row = false;  ///< comes straight up from the row of its feedback
};

class Router {
 public:
  Router(Sheet& sheet, const std::vector<Net>& nets, const std::vector<std::vector<Cell>>& columns)
      : sheet_(sheet),
        nets_(nets),
        columns_(columns),
        net_of_(sheet.wires.size(), -1),
        channels_(columns.size() + 1),
        entry_(sheet.wires.size()) {
    for (std::size_t n = 0; n < nets.size(); ++n)
      for (const int w : nets[n].wires) net_of_[static_cast<std::size_t>(w)] = static_cast<int>(n);
  }

  void run() {
    find_heights();
    choose_sides();
    enter_forward();
    enter_feedback();
    for (auto& channel : channels_) order_tracks(channel);
    set_columns();
    for (std::size_t w = 0; w < sheet_.wires.size(); ++w) draw(w);
    fit();
  }

 private:
  Item& item(int i) { return sheet_.items[static_cast<std::size_t>(i)]; }
  const Cell& cell(int i) const { return cells_[static_cast<std::size_t>(i)]; }

  void find_heights() {
    cells_.resize(sheet_.items.size());
    for (const auto& column : columns_)
      for (const auto& c : column) {
        if (c.item >= 0) {
          cells_[static_cast<std::size_t>(c.item)] = c;
          item(c.item).y = c.y - item(c.item).height() / 2;
        } else {
          passage_[{c.net, c.column}] = c.y;
        }
      }
  }

  /// Height of a net where it leaves a column to the right.
  double height_of(int net, int column) {
    const Net& n = nets_[static_cast<std::size_t>(net)];
    Item& source = item(n.item);
    if (source.column == column) return source.y + out_port(source, n.out).y;
    return passage_.at({net, column});
  }

  int net_of(int wire) const { return net_of_[static_cast<std::size_t>(wire)]; }

  // --- how wires enter sums ------------------------------------------------------------------------------------------

  /// Feedback comes from below, the wire that is nearest in height from the left, others from above or below.
  void choose_sides() {
    std::vector<std::vector<int>> into(sheet_.items.size());
    for (std::size_t w = 0; w < sheet_.wires.size(); ++w)
      into[static_cast<std::size_t>(sheet_.wires[w].to)].push_back(static_cast<int>(w));
    for (std::size_t i = 0; i < sheet_.items.size(); ++i) {
      Item& sum = sheet_.items[i];
      sum.side.assign(sum.in.size(), Side::left);
      if (sum.symbol.outline != Outline::circle) continue;
      const double line = cell(static_cast<int>(i)).y;
      std::vector<std::pair<double, int>> forward;  // height, wire
      bool below_taken = false;
      for (const int w : into[i]) {
        const Wire& wire = sheet_.wires[static_cast<std::size_t>(w)];
        if (wire.feedback && !below_taken) {
          side(w) = Side::bottom;
          below_taken = true;
        } else {
          const double from = wire.feedback ? line + 1e6 : height_of(net_of(w), sum.column - 1);
          forward.emplace_back(from, w);
        }
      }
      std::stable_sort(forward.begin(), forward.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
      // Places from top to bottom that are free, and the choice of `forward.size()` neighbours among them.
      std::vector<Side> places{Side::top, Side::left};
      if (!below_taken) places.push_back(Side::bottom);
      std::size_t first = 0;
      if (forward.size() < places.size()) {
        std::size_t nearest = 0;
        for (std::size_t k = 1; k < forward.size(); ++k)
          if (std::abs(forward[k].first - line) < std::abs(forward[nearest].first - line)) nearest = k;
        // The nearest goes to the left side (place 1), the rest keep their order around it.
        if (nearest == 0) first = 1;
        if (forward.size() + first > places.size()) first = places.size() - forward.size();
      }
      for (std::size_t k = 0; k < forward.size(); ++k)
        side(forward[k].second) = places[std::min(first + k, places.size() - 1)];
    }
  }

  Side& side(int w) {
    const Wire& wire = sheet_.wires[static_cast<std::size_t>(w)];
    return item(wire.to).side[static_cast<std::size_t>(wire.in)];
  }

  double port_height(const Wire& wire) { return item(wire.to).y + in_port(item(wire.to), wire.in).y; }

  /// Does nothing stand between this height and the sum, in the column of the sum?
  bool is_free(const Item& sum, int index, double y) const {
    const double line = cell(index).y;
    const double low = std::min(y, line), high = std::max(y, line);
    for (const auto& c : columns_[static_cast<std::size_t>(sum.column)])
      if (c.item != index && high > c.y - c.up - same && low < c.y + c.down + same) return false;
    return true;
  }

  void enter_forward() {
    for (std::size_t w = 0; w < sheet_.wires.size(); ++w) {
      const Wire& wire = sheet_.wires[w];
      if (wire.feedback) continue;
      const int net = net_of(static_cast<int>(w));
      Item& to = item(wire.to);
      double y = port_height(wire);
      const Side at = side_of(wire);
      if (at != Side::left) {
        const double comes = height_of(net, to.column - 1);
        const double room = at == Side::top ? y - 13 - comes : comes - y - 13;
        y = room >= 0 && is_free(to, wire.to, comes) ? comes : y + (at == Side::top ? -14 : 14);
      }
      entry_[w].y = y;
      for (int channel = item(wire.from).column + 1; channel <= to.column; ++channel) {
        Trunk& t = trunk(channel, net);
        join(t.left, height_of(net, channel - 1));
        join(t.right, channel == to.column ? y : height_of(net, channel));
      }
    }
  }

  Side side_of(const Wire& wire) {
    const Item& to = item(wire.to);
    return to.symbol.outline == Outline::circle ? to.side[static_cast<std::size_t>(wire.in)] : Side::left;
  }

  static void join(std::vector<double>& list, double y) {
    if (std::find(list.begin(), list.end(), y) == list.end()) list.push_back(y);
  }

  Trunk& trunk(int channel, int net) {
    auto& list = channels_[static_cast<std::size_t>(channel)];
    for (auto& t : list)
      if (t.net == net) return t;
    list.push_back({net});
    return list.back();
  }

  // --- feedback ------------------------------------------------------------------------------------------------------

  struct Row {
    int net = 0;
    int first = 0, last = 0;  ///< columns that it passes below
    double y = 0;
  };

  void enter_feedback() {
    std::vector<Row> rows;
    for (std::size_t n = 0; n < nets_.size(); ++n) {
      Row r{static_cast<int>(n), std::numeric_limits<int>::max(), item(nets_[n].item).column, 0};
      for (const int w : nets_[n].wires)
        if (sheet_.wires[static_cast<std::size_t>(w)].feedback)
          r.first = std::min(r.first, item(sheet_.wires[static_cast<std::size_t>(w)].to).column);
      if (r.first <= r.last) rows.push_back(r);
    }
    std::stable_sort(rows.begin(), rows.end(),
                     [](const Row& a, const Row& b) { return a.last - a.first < b.last - b.first; });
    for (std::size_t i = 0; i < rows.size(); ++i) {
      Row& r = rows[i];
      r.y = bottom_of(r.first, r.last) + row;
      for (std::size_t k = 0; k < i; ++k)  // rows whose channels touch
        if (rows[k].first <= r.last + 1 && r.first <= rows[k].last + 1) r.y = std::max(r.y, rows[k].y + row);
    }
    for (const Row& r : rows) {
      row_[r.net] = r.y;
      Trunk& down = trunk(r.last + 1, r.net);
      join(down.left, height_of(r.net, r.last));
      join(down.left, r.y);
      for (const int w : nets_[static_cast<std::size_t>(r.net)].wires) {
        const Wire& wire = sheet_.wires[static_cast<std::size_t>(w)];
        if (wire.feedback) come_up(static_cast<std::size_t>(w), wire, r);
      }
    }
  }

  void come_up(std::size_t w, const Wire& wire, const Row& r) {
    const int column = item(wire.to).column;
    double y = port_height(wire);
    if (side_of(wire) != Side::left) {
      const auto& cells = columns_[static_cast<std::size_t>(column)];
      const bool blocked = std::any_of(cells.begin(), cells.end(), [&](const Cell& c) {
        return c.item >= 0 && c.item != wire.to && c.y > cell(wire.to).y;
      });
      entry_[w].from_row = !blocked;
      if (!blocked) return;
      y += 14;
    }
    entry_[w].y = y;
    Trunk& up = trunk(column, r.net);
    join(up.right, r.y);
    join(up.right, y);
  }

  /// The lowest of all that stands in these columns and in the channels at their sides.
  double bottom_of(int first, int last) const {
    double bottom = -std::numeric_limits<double>::infinity();  // heights are negative as well
    for (int c = first; c <= last; ++c)
      for (const auto& cell : columns_[static_cast<std::size_t>(c)]) bottom = std::max(bottom, cell.y + cell.down);
    for (int c = first; c <= last + 1; ++c)
      for (const auto& t : channels_[static_cast<std::size_t>(c)]) bottom = std::max(bottom, t.high());
    return bottom;
  }

  // --- tracks --------------------------------------------------------------------------------------------------------

  /// How often wires cross if `a` is left of `b`.
  static int crossings(const Trunk& a, const Trunk& b) {
    const auto inside = [](const Trunk& t) {
      return [low = t.low(), high = t.high()](double y) { return y > low && y < high; };
    };
    // What joins b from the left passes the vertical piece of a; what leaves a to the right passes that of b.
    return static_cast<int>(std::count_if(b.left.begin(), b.left.end(), inside(a)) +
                            std::count_if(a.right.begin(), a.right.end(), inside(b)));
  }

  /// Must `a` be left of `b`? Else what joins a from the left and what leaves b to the right would lie on each other.
  static bool must_be_left(const Trunk& a, const Trunk& b) {
    for (const double left : a.left)
      for (const double right : b.right)
        if (std::abs(left - right) < same) return true;
    return false;
  }

  static bool overlap(const Trunk& a, const Trunk& b) {
    return a.low() < b.high() + 2 * same && b.low() < a.high() + 2 * same;
  }

  /// Orders the pieces of a channel; then `x` is the number of the track, from 0.
  void order_tracks(std::vector<Trunk>& channel) {
    std::erase_if(channel, [](const Trunk& t) { return t.straight(); });
    const std::size_t n = channel.size();
    // From left to right, each time the piece that crosses least if it stands left of all that remain, among those
    // that no remaining one must precede.
    std::vector<std::size_t> left(n), order;
    std::iota(left.begin(), left.end(), std::size_t{0});
    std::vector<int> of_pair(n * n, 0), cost(n, 0);  // of standing left of another one, and of all that remain
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < n; ++k) {
        if (i == k) continue;
        of_pair[i * n + k] = crossings(channel[i], channel[k]) - crossings(channel[k], channel[i]) +
                             (must_be_left(channel[k], channel[i]) ? 1000 : 0);
        cost[i] += of_pair[i * n + k];
      }
    while (!left.empty()) {
      const auto best =
          std::min_element(left.begin(), left.end(), [&](std::size_t a, std::size_t b) { return cost[a] < cost[b]; });
      const std::size_t taken = *best;
      order.push_back(taken);
      left.erase(best);
      for (const std::size_t i : left) cost[i] -= of_pair[i * n + taken];
    }
    std::vector<Trunk> sorted;
    for (const std::size_t i : order) sorted.push_back(channel[i]);
    channel = std::move(sorted);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < i; ++k)
        if (overlap(channel[k], channel[i]) || must_be_left(channel[k], channel[i]))
          channel[i].x = std::max(channel[i].x, channel[k].x + 1);
  }

  // --- places --------------------------------------------------------------------------------------------------------

  double unit_room_behind(const std::vector<Cell>& column) {
    double room = unit_room;
    for (const auto& c : column)
      if (c.item >= 0)
        for (const auto& unit : item(c.item).out_units) room = std::max(room, std::ceil(text_width(unit, 9)) + 8);
    return room;
  }

  void set_columns() {
    double x = margin;
    for (std::size_t c = 0; c <= columns_.size(); ++c) {
      auto& channel = channels_[c];
      double tracks = 0;
      for (const auto& t : channel) tracks = std::max(tracks, t.x + 1);
      const bool outer = c == 0 || c == columns_.size();
      const double before = c == 0 ? 0 : unit_room_behind(columns_[c - 1]);
      for (auto& t : channel) t.x = x + before + track * t.x;
      if (tracks > 0 || !outer)
        x += before + (tracks > 0 ? track * (tracks - 1) : 0) + (c == columns_.size() ? 4 : arrow_room);
      if (c == columns_.size()) break;
      double left = 0, right = 0;
      for (const auto& cell : columns_[c])
        if (cell.item >= 0) {
          const Room room = room_of(item(cell.item));
          left = std::max(left, room.left), right = std::max(right, room.right);
        }
      const double middle = std::ceil(x + left);
      for (const auto& cell : columns_[c])
        if (cell.item >= 0) item(cell.item).x = middle - item(cell.item).width() / 2;
      x = std::ceil(middle + right);
    }
    sheet_.width = x + margin;
  }

  // --- paths ---------------------------------------------------------------------------------------------------------

  const Trunk* find_trunk(int channel, int net) const {
    for (const auto& t : channels_[static_cast<std::size_t>(channel)])
      if (t.net == net) return &t;
    return nullptr;
  }

  void draw(std::size_t w) {
    Wire& wire = sheet_.wires[w];
    const int net = net_of(static_cast<int>(w));
    Item& from = item(wire.from);
    Item& to = item(wire.to);
    const Point start{from.x + out_port(from, wire.out).x, from.y + out_port(from, wire.out).y};
    const Point end{to.x + in_port(to, wire.in).x, to.y + in_port(to, wire.in).y};
    std::vector<Point> path{start};
    const auto go_x = [&](double x) { path.push_back({x, path.back().y}); };
    const auto go_y = [&](double y) { path.push_back({path.back().x, y}); };
    const auto pass = [&](int channel, double y) {
      if (const Trunk* t = find_trunk(channel, net); t != nullptr && path.back().y != y) go_x(t->x), go_y(y);
    };
    if (wire.feedback) {
      pass(from.column + 1, row_.at(net));
      if (!entry_[w].from_row) pass(to.column, entry_[w].y);
    } else {
      for (int channel = from.column + 1; channel <= to.column; ++channel)
        pass(channel, channel == to.column ? entry_[w].y : height_of(net, channel));
    }
    if (path.back().y != end.y) go_x(end.x), go_y(end.y);
    path.push_back(end);
    wire.path = simplified(path);
  }

  /// Moves everything to the upper left corner of the sheet.
  void fit() {
    double top = std::numeric_limits<double>::infinity(), bottom = -top;
    const auto see = [&](double y) { top = std::min(top, y), bottom = std::max(bottom, y); };
    for (const auto& column : columns_)
      for (const auto& c : column)
        if (c.item >= 0) see(item(c.item).y), see(c.y + item(c.item).height() / 2 + room_of(item(c.item)).below);
    for (const auto& wire : sheet_.wires)
      for (const auto& p : wire.path) see(p.y);
    const double shift = std::round(margin - top);
    for (auto& i : sheet_.items) i.y += shift;
    for (auto& wire : sheet_.wires)
      for (auto& p : wire.path) p.y += shift;
    sheet_.height = bottom + shift + margin;
  }

  Sheet& sheet_;
  const std::vector<Net>& nets_;
  const std::vector<std::vector<Cell>>& columns_;
  std::vector<int> net_of_;                        ///< per wire
  std::vector<std::vector<Trunk>> channels_;       ///< channel c lies left of column c
  std::vector<Entry> entry_;                       ///< per wire
  std::vector<Cell> cells_;                        ///< per item
  std::map<std::pair<int, int>, double> passage_;  ///< net and column -> height
  std::map<int, double> row_;                      ///< net -> height of its feedback
};

}  // namespace

std::vector<Point> simplified(const std::vector<Point>& path) {
  std::vector<Point> result;
  for (const Point& p : path) {
    if (!result.empty() && result.back() == p) continue;
    if (result.size() >= 2) {
      const Point &a = result[result.size() - 2], &b = result.back();
      if ((a.x == b.x && b.x == p.x) || (a.y == b.y && b.y == p.y)) result.pop_back();
    }
    result.push_back(p);
  }
  return result;
}

void route(Sheet& sheet, const std::vector<Net>& nets, const std::vector<std::vector<Cell>>& columns) {
  Router(sheet, nets, columns).run();
}

}  // namespace hysteron::draw
