#include "fit/trace_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hysteron {
namespace {

constexpr double same_place = 1e-9;  // of the range: what ten written digits leave of an instant

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  bool holds(double x, double slack) const { return x >= low - slack && x <= high + slack; }
};

Range range_of(const std::vector<double>& x) {
  Range range;
  for (const double v : x) range = {std::min(range.low, v), std::max(range.high, v)};
  return range;
}

/// The value nearest to `wanted` among those that a curve takes within a strip.
struct Nearest {
  double wanted = 0;
  double value = std::numeric_limits<double>::quiet_NaN();
  bool found = false;

  void consider(double y) {
    if (!found || std::abs(y - wanted) < std::abs(value - wanted)) value = y;
    found = true;
  }
  void consider_all_between(double a, double b) { consider(std::clamp(wanted, std::min(a, b), std::max(a, b))); }
};

double on_segment(const TraceLine& line, std::size_t i, double x) {
  const double step = line.x[i + 1] - line.x[i];
  return line.y[i] + (line.y[i + 1] - line.y[i]) * (x - line.x[i]) / step;
}

/// What segment i passes within x - along ... x + along.
void consider_segment(const TraceLine& line, std::size_t i, double x, double along, Nearest& nearest) {
  const double low = std::min(line.x[i], line.x[i + 1]), high = std::max(line.x[i], line.x[i + 1]);
  if (high < x - along || low > x + along) return;
  if (low == high) return nearest.consider_all_between(line.y[i], line.y[i + 1]);  // a jump: all between is passed
  const double from = std::max(low, x - along), to = std::min(high, x + along);
  nearest.consider_all_between(on_segment(line, i, from), on_segment(line, i, to));
}

/// The points of the curve within x - width ... x + width.
bool consider_points(const TraceLine& line, double x, double width, Nearest& nearest) {
  for (auto i = std::lower_bound(line.x.begin(), line.x.end(), x - width); i != line.x.end() && *i <= x + width; ++i)
    nearest.consider(line.y[static_cast<std::size_t>(i - line.x.begin())]);
  return nearest.found;
}

double nearest_value(const TraceLine& line, TraceCourse course, double x, double wanted, double along, double slack) {
  Nearest nearest{wanted};
  if (line.x.size() == 1) return line.y.front();
  if (course == TraceCourse::to_and_fro) {
    for (std::size_t i = 0; i + 1 < line.x.size(); ++i) consider_segment(line, i, x, along, nearest);
  } else {
    if (consider_points(line, x, slack, nearest) && along == 0) return nearest.value;
    const auto begin = std::lower_bound(line.x.begin(), line.x.end(), x - along);
    std::size_t i = begin == line.x.begin() ? 0 : static_cast<std::size_t>(begin - line.x.begin()) - 1;
    for (; i + 1 < line.x.size() && line.x[i] <= x + along; ++i) consider_segment(line, i, x, along, nearest);
  }
  if (nearest.found) return nearest.value;
  return x < line.x.front() ? line.y.front() : line.y.back();  // within rounding of an end
}

std::vector<std::size_t> points_within(const TraceLine& line, const Range& range, double slack) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < line.x.size(); ++i)
    if (range.holds(line.x[i], slack)) rows.push_back(i);
  return rows;
}

void summarize(TraceDistance& d) {
  double squares = 0;
  for (std::size_t i = 0; i < d.x.size(); ++i) {
    const double size = std::abs(d.second[i] - d.first[i]);
    squares += size * size;
    if (size > d.largest) d.largest = size, d.largest_at = i;
    if (d.beyond[i] > d.beyond[d.worst_at]) d.worst_at = i;
    if (d.beyond[i] > 0) ++d.outside;
  }
  if (!d.x.empty()) d.rms = std::sqrt(squares / static_cast<double>(d.x.size()));
}

}  // namespace

TraceDistance distance_of(const TraceLine& first, const TraceLine& second, TraceCourse course,
                          const TraceTolerance& tolerance) {
  const Range a = range_of(first.x), b = range_of(second.x);
  const double slack = same_place * std::max(a.high - a.low, b.high - b.low);
  const auto of_first = points_within(first, b, slack), of_second = points_within(second, a, slack);
  TraceDistance d;
  d.points_of_first = of_first.size() <= of_second.size();
  const TraceLine& points = d.points_of_first ? first : second;
  const TraceLine& curve = d.points_of_first ? second : first;
  const auto& rows = d.points_of_first ? of_first : of_second;
  d.left_out = points.x.size() - rows.size();
  for (const std::size_t row : rows) {
    const double x = points.x[row], y = points.y[row];
    const double there = nearest_value(curve, course, x, y, 0, slack);
    const double near = tolerance.along > 0 ? nearest_value(curve, course, x, y, tolerance.along, slack) : there;
    d.x.push_back(x);
    d.first.push_back(d.points_of_first ? y : there);
    d.second.push_back(d.points_of_first ? there : y);
    d.allowed.push_back(tolerance.absolute + tolerance.relative * std::abs(d.first.back()));
    d.beyond.push_back(std::abs(near - y) - d.allowed.back());
  }
  summarize(d);
  return d;
}

}  // namespace hysteron
