#include "fit/compare/trace_distance.h"

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

/// A curve with its segments sorted into bins along x, so that a loop of many rows is not gone through for each point.
class BinnedCurve {
 public:
  BinnedCurve(const TraceLine& line, const Range& range) : line_(&line), low_(range.low) {
    constexpr std::size_t rows_per_bin = 16, most_bins = 256;
    const std::size_t n = std::clamp<std::size_t>(line.x.size() / rows_per_bin, 1, most_bins);
    width_ = range.high > range.low ? (range.high - range.low) / static_cast<double>(n) : 1;
    bins_.resize(n);
    for (std::size_t i = 0; i + 1 < line.x.size(); ++i) {
      const auto [a, b] = std::minmax(line.x[i], line.x[i + 1]);
      for (std::size_t bin = bin_of(a); bin <= bin_of(b); ++bin) bins_[bin].push_back(i);
    }
  }

  void consider(double x, double along, Nearest& nearest) const {
    for (std::size_t bin = bin_of(x - along); bin <= bin_of(x + along); ++bin)
      for (const std::size_t i : bins_[bin]) consider_segment(*line_, i, x, along, nearest);
  }

 private:
  std::size_t bin_of(double x) const {
    const double bin = (x - low_) / width_;
    return bin <= 0 ? 0 : std::min(static_cast<std::size_t>(bin), bins_.size() - 1);
  }

  const TraceLine* line_;
  double low_, width_ = 1;
  std::vector<std::vector<std::size_t>> bins_;
};

/// What a rising curve passes within x - along ... x + along; without `along` a point at x itself counts alone.
void consider_rising(const TraceLine& line, double x, double along, double slack, Nearest& nearest) {
  if (consider_points(line, x, slack, nearest) && along == 0) return;
  const auto begin = std::lower_bound(line.x.begin(), line.x.end(), x - along);
  std::size_t i = begin == line.x.begin() ? 0 : static_cast<std::size_t>(begin - line.x.begin()) - 1;
  for (; i + 1 < line.x.size() && line.x[i] <= x + along; ++i) consider_segment(line, i, x, along, nearest);
}

/// The nearest of the points at the largest or smallest x: for one that lies beyond them by rounding.
double at_the_end(const TraceLine& line, double x, double wanted) {
  const auto nearer = [&](std::size_t a, std::size_t b) {
    return std::abs(line.x[a] - x) != std::abs(line.x[b] - x)
               ? std::abs(line.x[a] - x) < std::abs(line.x[b] - x)
               : std::abs(line.y[a] - wanted) < std::abs(line.y[b] - wanted);
  };
  std::size_t best = 0;
  for (std::size_t i = 1; i < line.x.size(); ++i)
    if (nearer(i, best)) best = i;
  return line.y[best];
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
  // Few points lie between rows: the file that has none within the other is the curve.
  d.points_of_first = of_second.empty() || (!of_first.empty() && of_first.size() <= of_second.size());
  const TraceLine& points = d.points_of_first ? first : second;
  const TraceLine& curve = d.points_of_first ? second : first;
  const auto& rows = d.points_of_first ? of_first : of_second;
  d.left_out = points.x.size() - rows.size();
  const TraceLine nothing;
  const BinnedCurve loop(course == TraceCourse::to_and_fro ? curve : nothing, d.points_of_first ? b : a);
  const auto value_near = [&](double x, double wanted, double along) {
    Nearest nearest{wanted};
    if (course == TraceCourse::to_and_fro)
      loop.consider(x, along, nearest);
    else
      consider_rising(curve, x, along, slack, nearest);
    return nearest.found ? nearest.value : at_the_end(curve, x, wanted);
  };
  for (const std::size_t row : rows) {
    const double x = points.x[row], y = points.y[row];
    const double there = value_near(x, y, 0);
    const double near = tolerance.along > 0 ? value_near(x, y, tolerance.along) : there;
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
