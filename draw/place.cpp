// Rows. Graphviz orders the cells of each column so that few wires cross and proposes heights; here the wires between
// neighbouring columns are made straight where that is possible, as one draws by hand: cells that are joined by
// straight wires form a line, lines never cross, and each line moves as near as it can to what it is wired to.
#include "draw/place.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "draw/graphviz.h"

namespace hysteron::draw {
namespace {

constexpr double gap = 14;           // between cells of a column
constexpr double wire_room = 5;      // above and below a wire that passes
constexpr double entry_room = 20;    // above and below a sum: wires come in from there
constexpr double smallest_step = 6;  // less than half of the gap
constexpr int sweeps = 24;

/// A wire, or a piece of one, between cells of neighbouring columns.
struct Link {
  int from = 0, to = 0;                   ///< cells
  double from_offset = 0, to_offset = 0;  ///< of the ports from the lines of the cells
  int priority = 0;                       ///< small = made straight first
};

struct Cells {
  std::vector<Cell> list;
  std::vector<Link> links;
};

Cell item_cell(const Sheet& sheet, std::size_t i) {
  const Item& item = sheet.items[i];
  Cell cell;
  cell.item = static_cast<int>(i);
  cell.column = item.column;
  const double entry = item.symbol.outline == Outline::circle ? entry_room : 0;
  cell.up = item.height() / 2 + entry;
  cell.down = item.height() / 2 + std::max(entry, room_of(item).below);
  return cell;
}

double line_offset(const Item& item, const Point& port) { return port.y - item.height() / 2; }

/// Cells of all items and passages, and the links between them, one column further each.
Cells make_cells(const Sheet& sheet, const std::vector<Net>& nets) {
  Cells cells;
  for (std::size_t i = 0; i < sheet.items.size(); ++i) cells.list.push_back(item_cell(sheet, i));
  for (std::size_t n = 0; n < nets.size(); ++n) {
    const Net& net = nets[n];
    const Item& source = sheet.items[static_cast<std::size_t>(net.item)];
    int last = source.column;
    for (const int w : net.wires) {
      const Wire& wire = sheet.wires[static_cast<std::size_t>(w)];
      if (!wire.feedback) last = std::max(last, sheet.items[static_cast<std::size_t>(wire.to)].column);
    }
    int previous = net.item;
    double offset = line_offset(source, out_port(source, net.out));
    for (int column = source.column + 1; column <= last; ++column) {
      for (const int w : net.wires) {
        const Wire& wire = sheet.wires[static_cast<std::size_t>(w)];
        const Item& to = sheet.items[static_cast<std::size_t>(wire.to)];
        if (wire.feedback || to.column != column) continue;
        cells.links.push_back({previous, wire.to, offset, line_offset(to, in_port(to, wire.in)), 1 + wire.in});
      }
      if (column == last) break;
      Cell passage;
      passage.net = static_cast<int>(n);
      passage.column = column;
      passage.up = passage.down = wire_room;
      const int here = static_cast<int>(cells.list.size());
      cells.list.push_back(passage);
      cells.links.push_back(
          {previous, here, offset, 0, cells.list[static_cast<std::size_t>(previous)].item < 0 ? 0 : 8});
      previous = here;
      offset = 0;
    }
  }
  return cells;
}

using Columns = std::vector<std::vector<int>>;  ///< cells from top to bottom

Columns order_by_dot(Cells& cells) {
  std::vector<double> heights;
  for (const auto& cell : cells.list) heights.push_back(cell.up + cell.down);
  std::vector<DotEdge> edges;
  for (const auto& link : cells.links)
    edges.push_back({link.from, link.to, link.priority == 0 ? 8 : link.priority == 1 ? 4 : 1});
  const auto middle = heights_by_dot(heights, edges);
  int last = 0;
  for (std::size_t i = 0; i < cells.list.size(); ++i) {
    Cell& cell = cells.list[i];
    cell.y = std::round(middle[i] - (cell.down - cell.up) / 2);
    last = std::max(last, cell.column);
  }
  Columns columns(static_cast<std::size_t>(last) + 1);
  for (std::size_t i = 0; i < cells.list.size(); ++i)
    columns[static_cast<std::size_t>(cells.list[i].column)].push_back(static_cast<int>(i));
  for (auto& column : columns)
    std::stable_sort(column.begin(), column.end(), [&](int a, int b) {
      return cells.list[static_cast<std::size_t>(a)].y < cells.list[static_cast<std::size_t>(b)].y;
    });
  return columns;
}

/// Where a loop comes into a sum from below, a source beside the first input stands above it and comes in from above.
void raise_sources(const Sheet& sheet, const Cells& cells, Columns& columns) {
  std::vector<int> links(cells.list.size(), 0);
  for (const auto& link : cells.links)
    ++links[static_cast<std::size_t>(link.from)], ++links[static_cast<std::size_t>(link.to)];
  for (const auto& wire : sheet.wires) {
    const auto sum = static_cast<std::size_t>(wire.to);
    if (!wire.feedback || sheet.items[sum].symbol.outline != Outline::circle) continue;
    int first = -1, source = -1;
    for (const auto& link : cells.links) {
      if (link.to != wire.to) continue;
      if (first < 0)
        first = link.from;
      else if (links[static_cast<std::size_t>(link.from)] == 1)
        source = link.from;
    }
    if (first < 0 || source < 0) continue;
    auto& column = columns[static_cast<std::size_t>(cells.list[static_cast<std::size_t>(source)].column)];
    const auto at = std::find(column.begin(), column.end(), first);
    const auto now = std::find(column.begin(), column.end(), source);
    if (at < now) std::rotate(at, now, now + 1);
  }
}

/// Lines of cells that straight wires join. `offset`: of a cell from the height of its line.
struct Lines {
  std::vector<int> of;
  std::vector<double> offset;
};

/// Which links are straight: first those of passages, then first inputs; none may cross another, and a cell has one
/// straight link to each side.
std::vector<bool> straight_links(const Cells& cells, const Columns& columns) {
  std::vector<int> rank(cells.list.size(), 0);
  for (const auto& column : columns)
    for (std::size_t i = 0; i < column.size(); ++i) rank[static_cast<std::size_t>(column[i])] = static_cast<int>(i);
  std::vector<int> order(cells.links.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
  const auto link = [&](int i) -> const Link& { return cells.links[static_cast<std::size_t>(i)]; };
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return link(a).priority < link(b).priority; });
  std::vector<bool> straight(cells.links.size(), false), left_taken(cells.list.size(), false),
      right_taken(cells.list.size(), false);
  std::map<int, std::vector<int>> accepted;  // per column of the left end
  for (const int i : order) {
    const auto from = static_cast<std::size_t>(link(i).from), to = static_cast<std::size_t>(link(i).to);
    if (right_taken[from] || left_taken[to]) continue;
    auto& others = accepted[cells.list[from].column];
    const bool crosses = std::any_of(others.begin(), others.end(), [&](int other) {
      const auto a = rank[static_cast<std::size_t>(link(other).from)],
                 b = rank[static_cast<std::size_t>(link(other).to)];
      return (a < rank[from]) != (b < rank[to]);
    });
    if (crosses) continue;
    others.push_back(i);
    straight[static_cast<std::size_t>(i)] = right_taken[from] = left_taken[to] = true;
  }
  return straight;
}

Lines lines_of(const Cells& cells, const std::vector<bool>& straight) {
  Lines lines;
  lines.of.assign(cells.list.size(), -1);
  lines.offset.assign(cells.list.size(), 0);
  // Links lead to the right, so walking the cells by column meets the beginning of a line first.
  std::vector<int> next(cells.list.size(), -1);
  std::vector<bool> begins(cells.list.size(), true);
  for (std::size_t i = 0; i < cells.links.size(); ++i)
    if (straight[i]) {
      next[static_cast<std::size_t>(cells.links[i].from)] = static_cast<int>(i);
      begins[static_cast<std::size_t>(cells.links[i].to)] = false;
    }
  int count = 0;
  for (std::size_t i = 0; i < cells.list.size(); ++i) {
    if (!begins[i]) continue;
    std::size_t cell = i;
    lines.of[cell] = count;
    while (next[cell] >= 0) {
      const Link& link = cells.links[static_cast<std::size_t>(next[cell])];
      const auto to = static_cast<std::size_t>(link.to);
      lines.of[to] = count;
      lines.offset[to] = lines.offset[cell] + link.from_offset - link.to_offset;
      cell = to;
    }
    ++count;
  }
  return lines;
}

/// `below` is at least `distance` below `above`.
struct Separation {
  int above = 0, below = 0;
  double distance = 0;
};

class Compaction {
 public:
  Compaction(const Cells& cells, const Columns& columns, const Lines& lines, const std::vector<bool>& straight)
      : cells_(cells), lines_(lines) {
    const int n = lines.of.empty() ? 0 : *std::max_element(lines.of.begin(), lines.of.end()) + 1;
    height_.assign(static_cast<std::size_t>(n), 0);
    above_.resize(height_.size());
    below_.resize(height_.size());
    wants_.resize(height_.size());
    std::vector<double> members(height_.size(), 0);
    for (std::size_t i = 0; i < cells.list.size(); ++i) {
      height_[line(i)] += cells.list[i].y - lines.offset[i];
      members[line(i)] += 1;
    }
    for (std::size_t i = 0; i < height_.size(); ++i) height_[i] = std::round(height_[i] / members[i]);
    for (const auto& column : columns)
      for (std::size_t i = 1; i < column.size(); ++i) separate(column[i - 1], column[i]);
    for (std::size_t i = 0; i < cells.links.size(); ++i)
      if (!straight[i]) pull(cells.links[i]);
  }

  /// False if the lines cannot be told above from below (then nothing is changed).
  bool solve() {
    if (!order()) return false;
    for (const int l : order_) push(static_cast<std::size_t>(l));
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      for (std::size_t i = 0; i < order_.size(); ++i)
        move(static_cast<std::size_t>(sweep % 2 == 0 ? order_[order_.size() - 1 - i] : order_[i]));
    }
    return true;
  }

  double height(std::size_t cell) const { return height_[line(cell)] + lines_.offset[cell]; }

 private:
  std::size_t line(std::size_t cell) const { return static_cast<std::size_t>(lines_.of[cell]); }

  void separate(int upper, int lower) {
    const auto a = static_cast<std::size_t>(upper), b = static_cast<std::size_t>(lower);
    const double distance =
        std::ceil(lines_.offset[a] + cells_.list[a].down + gap + cells_.list[b].up - lines_.offset[b]);
    below_[line(a)].push_back({lines_.of[a], lines_.of[b], distance});
    above_[line(b)].push_back({lines_.of[a], lines_.of[b], distance});
  }

  void pull(const Link& link) {
    const auto a = static_cast<std::size_t>(link.from), b = static_cast<std::size_t>(link.to);
    const double difference = lines_.offset[a] + link.from_offset - lines_.offset[b] - link.to_offset;
    wants_[line(b)].emplace_back(lines_.of[a], difference);
    wants_[line(a)].emplace_back(lines_.of[b], -difference);
  }

  bool order() {
    std::vector<int> waiting(height_.size(), 0);
    for (const auto& list : below_)
      for (const auto& s : list) ++waiting[static_cast<std::size_t>(s.below)];
    for (std::size_t i = 0; i < waiting.size(); ++i)
      if (waiting[i] == 0) order_.push_back(static_cast<int>(i));
    for (std::size_t at = 0; at < order_.size(); ++at)
      for (const auto& s : below_[static_cast<std::size_t>(order_[at])])
        if (--waiting[static_cast<std::size_t>(s.below)] == 0) order_.push_back(s.below);
    return order_.size() == height_.size();
  }

  double lowest(std::size_t l) const {
    double bound = -std::numeric_limits<double>::infinity();
    for (const auto& s : above_[l]) bound = std::max(bound, height_[static_cast<std::size_t>(s.above)] + s.distance);
    return bound;
  }
  double highest(std::size_t l) const {
    double bound = std::numeric_limits<double>::infinity();
    for (const auto& s : below_[l]) bound = std::min(bound, height_[static_cast<std::size_t>(s.below)] - s.distance);
    return bound;
  }
  void push(std::size_t l) { height_[l] = std::max(height_[l], lowest(l)); }
  void move(std::size_t l) {
    if (wants_[l].empty()) return;
    std::vector<double> wished;
    for (const auto& [other, difference] : wants_[l])
      wished.push_back(height_[static_cast<std::size_t>(other)] + difference);
    std::sort(wished.begin(), wished.end());
    const double median = wished[(wished.size() - 1) / 2];
    const double allowed = std::max(lowest(l), std::min(highest(l), median));
    // A step of a few pixels looks like a mistake: part of the gap is given away for a straight wire.
    height_[l] = std::abs(allowed - median) <= smallest_step ? median : allowed;
  }

  const Cells& cells_;
  const Lines& lines_;
  std::vector<double> height_;
  std::vector<std::vector<Separation>> above_, below_;
  std::vector<std::vector<std::pair<int, double>>> wants_;
  std::vector<int> order_;
};

}  // namespace

std::vector<std::vector<Cell>> place_rows(const Sheet& sheet, const std::vector<Net>& nets) {
  Cells cells = make_cells(sheet, nets);
  Columns columns = order_by_dot(cells);
  raise_sources(sheet, cells, columns);
  std::vector<bool> straight = straight_links(cells, columns);
  for (bool solved = false; !solved;) {
    const Lines lines = lines_of(cells, straight);
    Compaction compaction(cells, columns, lines, straight);
    solved = compaction.solve();
    if (solved)
      for (std::size_t i = 0; i < cells.list.size(); ++i) cells.list[i].y = compaction.height(i);
    else
      straight.assign(straight.size(), false);  // every cell its own line: columns alone are always in order
  }
  std::vector<std::vector<Cell>> result(columns.size());
  for (std::size_t c = 0; c < columns.size(); ++c)
    for (const int cell : columns[c]) result[c].push_back(cells.list[static_cast<std::size_t>(cell)]);
  return result;
}

}  // namespace hysteron::draw
