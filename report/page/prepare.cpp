#include "report/page/prepare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <span>

#include "report/page/decimate.h"

namespace hysteron {
namespace {

constexpr int palette_size = 16;         // eight colours, the second time dashed
constexpr std::size_t few_points = 150;  ///< drawn as larger dots

/// Where the numbers of a curve stand.
struct Source {
  std::span<const double> x, y;
  const CsvColumn* x_column = nullptr;
  const CsvColumn* y_column = nullptr;
  const CsvColumn* time = nullptr;  ///< first column of the trace
};

Source source_of(const Document& document, const Curve& curve) {
  Source s{curve.x, curve.y};
  if (!curve.trace.empty()) {
    s = {};
    for (const auto& trace : document.traces) {
      if (trace.file != curve.trace) continue;
      s.x_column = trace.find(curve.x_column);
      s.y_column = trace.find(curve.y_column);
      if (!trace.columns.empty()) s.time = &trace.columns.front();
      if (s.x_column) s.x = s.x_column->values;
      if (s.y_column) s.y = s.y_column->values;
    }
  }
  const auto n = std::min(s.x.size(), s.y.size());
  s.x = s.x.first(n);
  s.y = s.y.first(n);
  return s;
}

/// The first curve of a role has the role's colour; further ones, and those without a role, take the palette in turn.
std::vector<std::string> colours(const std::vector<Curve>& curves) {
  static const std::map<std::string, std::string> of_role{{"measured", "measured"}, {"simulated", "simulated"},
                                                          {"after", "simulated"},   {"before", "before"},
                                                          {"residual", "residual"}, {"floor", "floor"}};
  // Palette entries that look like a role's colour are passed over while that role is in the figure.
  static const std::map<std::string, std::string> twins{{"p0", "simulated"}, {"p1", "before"}, {"p3", "residual"},
                                                        {"p8", "simulated"}, {"p9", "before"}, {"p11", "residual"}};
  std::set<std::string> used;
  for (const auto& c : curves)
    if (const auto found = of_role.find(c.role); found != of_role.end()) used.insert(found->second);
  std::vector<std::string> result;
  std::set<std::string> given;
  int next = 0;
  for (const auto& c : curves) {
    const auto found = of_role.find(c.role);
    if (found != of_role.end() && given.insert(found->second).second) {
      result.push_back(found->second);
      continue;
    }
    std::string name;
    do {
      name = fmt::format("p{}", next++ % palette_size);
    } while (twins.contains(name) && used.contains(twins.at(name)));
    result.push_back(name);
  }
  return result;
}

std::string label_of_column(const CsvColumn& column) {
  return column.unit.text.empty() ? column.name : fmt::format("{} [{}]", column.name, column.unit.text);
}

void include(std::span<const double> values, bool log, Range& range) {
  for (const double v : values) {
    if (!std::isfinite(v) || (log && !(v > 0))) continue;
    if (range.empty()) range = {v, v};
    range.low = std::min(range.low, v);
    range.high = std::max(range.high, v);
  }
}

/// A constant signal still needs an axis.
void widen(Range& range, bool log) {
  if (range.empty() || range.high > range.low) return;
  const double around = range.low == 0 ? 1 : 0.1 * std::abs(range.low);
  range = log ? Range{range.low / 2, range.high * 2} : Range{range.low - around, range.high + around};
}

/// Some air, so that points at the ends are not cut.
void add_air(Range& range, bool log) {
  if (range.empty()) return;
  const double air = 0.03;
  if (log) {
    const double factor = std::pow(range.high / range.low, air);
    range = {range.low / factor, range.high * factor};
  } else {
    const double margin = air * (range.high - range.low);
    range = {range.low - margin, range.high + margin};
  }
}

/// Of a curve over increasing x, the part that a wished range shows, with a neighbour on each side: its points are not
/// thinned out for what lies outside.
void cut_to(const std::vector<double>& range, Source& s) {
  if (range.size() != 2 || !never_decreases(s.x)) return;
  const auto first = std::lower_bound(s.x.begin(), s.x.end(), range[0]) - s.x.begin();
  const auto last = std::upper_bound(s.x.begin(), s.x.end(), range[1]) - s.x.begin();
  const auto begin = static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, first - 1));
  const auto end = std::min(s.x.size(), static_cast<std::size_t>(last) + 1);
  if (end <= begin) return;
  s.x = s.x.subspan(begin, end - begin);
  s.y = s.y.subspan(begin, end - begin);
}

/// How much of the time has gone at point `k` of `n`; by the rows where the trace has no times.
double time_gone(const Source& s, std::size_t k, std::size_t n) {
  if (s.time != nullptr && s.time->values.size() == n && s.time->values.back() > s.time->values.front())
    return (s.time->values[k] - s.time->values.front()) / (s.time->values.back() - s.time->values.front());
  return n > 1 ? static_cast<double>(k) / static_cast<double>(n - 1) : 0;
}

/// The ends of the scale of time, as words beside it.
void name_ends(const Source& s, PreparedFigure& p) {
  if (!p.begins.empty()) return;
  p.begins = "start";
  p.ends = "end";
  if (s.time == nullptr || s.time->values.empty()) return;
  p.begins = fmt::format("{:.4g} {}", s.time->values.front(), s.time->unit.text);
  p.ends = fmt::format("{:.4g} {}", s.time->values.back(), s.time->unit.text);
}

bool is_time(const std::string& label) {
  static const std::set<std::string> units{"s", "ms", "us", "ns", "min", "h", "d", "hour", "day"};
  return units.contains(unit_of_label(label)) || label.rfind("time", 0) == 0;
}

}  // namespace

std::string unit_of_label(const std::string& label) {
  const auto open = label.rfind('[');
  if (open == std::string::npos || label.back() != ']') return "";
  return label.substr(open + 1, label.size() - open - 2);
}

std::size_t point_count(const Document& document, const Figure& figure) {
  std::size_t count = 0;
  for (const auto& curve : figure.curves) count += source_of(document, curve).x.size();
  return count;
}

/// Curve `i` of the figure with at most `share` of its points; the axes of the figure take all of them in.
PreparedCurve prepare_curve(const Figure& figure, std::size_t i, const Source& source, const std::string& colour,
                            std::size_t share, PreparedFigure& p) {
  const Curve& curve = figure.curves[i];
  PreparedCurve c;
  c.name = curve.name;
  c.style = curve.style.empty() ? "line" : curve.style;
  const bool by_time = curve.colour == "time";
  c.colour = by_time ? "time" : colour;
  c.under = curve.role == "measured" && c.style == "line" && figure.curves.size() > 1;
  if (by_time) name_ends(source, p);
  if (!curve.trace.empty()) c.source = "traces/" + curve.trace;
  c.points = source.x.size();
  c.monotone = never_decreases(source.x);
  c.few = c.points <= few_points;
  for (const auto k : decimate(source.x, source.y, share)) {
    c.x.push_back(source.x[k]);
    c.y.push_back(source.y[k]);
    if (by_time) c.shade.push_back(time_gone(source, k, source.x.size()));
  }
  include(source.x, p.log_x, p.x);
  include(source.y, p.log_y, p.y);
  p.points += c.points;
  p.kept += c.x.size();
  return c;
}

PreparedFigure prepare(const Document& document, const Figure& figure, std::size_t budget) {
  PreparedFigure p{figure.title,
                   figure.kind,
                   figure.x_label,
                   figure.y_label,
                   figure.caption,
                   figure.log_x,
                   figure.log_y,
                   {},
                   figure.bars,
                   {},
                   {},
                   false,
                   0,
                   0};
  std::vector<Source> sources;
  std::vector<std::size_t> points;
  for (const auto& curve : figure.curves) {
    sources.push_back(source_of(document, curve));
    cut_to(figure.x_range, sources.back());
    points.push_back(sources.back().x.size());
    if (p.x_label.empty() && sources.back().x_column) p.x_label = label_of_column(*sources.back().x_column);
    if (p.y_label.empty() && sources.back().y_column) p.y_label = label_of_column(*sources.back().y_column);
  }
  const auto shares = share_budget(points, budget);
  const auto colour = colours(figure.curves);
  bool monotone = true;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    p.curves.push_back(prepare_curve(figure, i, sources[i], colour[i], shares[i], p));
    monotone = monotone && p.curves.back().monotone;
  }
  widen(p.x, p.log_x);
  widen(p.y, p.log_y);
  const bool over_time = p.kind == "curves" && monotone && is_time(p.x_label);
  const bool points_only =
      std::all_of(p.curves.begin(), p.curves.end(), [](const PreparedCurve& c) { return c.style == "points"; });
  if (!monotone || points_only) add_air(p.x, p.log_x);
  if (figure.x_range.size() == 2) p.x = {figure.x_range[0], figure.x_range[1]};
  if (figure.y_range.size() == 2) p.y = {figure.y_range[0], figure.y_range[1]};
  p.part = figure.x_range.size() == 2;
  p.wide = p.kind == "waterfall" || (over_time && figure.x_range.empty());
  return p;
}

}  // namespace hysteron
