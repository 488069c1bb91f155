#include "report/page/figure_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/page/canvas.h"
#include "report/page/decimate.h"
#include "report/page/html.h"

namespace hysteron {
namespace {

/// Of the static picture: two points per pixel draw the same line as all of them.
constexpr std::size_t points_per_curve = 2000;

/// SVG path data of a curve: a line, a staircase (a value holds until the next), or dots.
std::string path_of(const PreparedCurve& curve, const Canvas& canvas) {
  std::string d;
  bool pen_down = false;
  for (const auto i : decimate(curve.x, curve.y, points_per_curve)) {
    const double x = curve.x[i], y = curve.y[i];
    if (!std::isfinite(x) || !std::isfinite(y) || (canvas.x.log && !(x > 0)) || (canvas.y.log && !(y > 0))) {
      pen_down = false;
      continue;
    }
    const std::string at_x = px(canvas.x(x)), at_y = px(canvas.y(y));
    if (curve.style == "points")
      d += "M" + at_x + " " + at_y + "h0";
    else if (!pen_down)
      d += "M" + at_x + " " + at_y;
    else if (curve.style == "steps")
      d += "H" + at_x + "V" + at_y;
    else
      d += "L" + at_x + " " + at_y;
    pen_down = true;
  }
  return d;
}

/// Does a part of the curve lie outside the axes? Only where a figure wishes for its ranges.
bool leaves(const PreparedCurve& curve, const Canvas& canvas) {
  const double foot = canvas.height - canvas.bottom, right = canvas.width - canvas.right;
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    const double x = canvas.x(curve.x[i]), y = canvas.y(curve.y[i]);
    if (x < canvas.left - 1 || x > right + 1 || y < canvas.top - 1 || y > foot + 1) return true;
  }
  return false;
}

/// A picture within the picture: nothing is drawn beyond its edge.
std::string within_axes(const std::string& path, const Canvas& canvas) {
  const std::string x = px(canvas.left), y = px(canvas.top), width = px(canvas.width - canvas.left - canvas.right),
                    height = px(canvas.height - canvas.top - canvas.bottom);
  return fmt::format("<svg x=\"{0}\" y=\"{1}\" width=\"{2}\" height=\"{3}\" viewBox=\"{0} {1} {2} {3}\">{4}</svg>", x,
                     y, width, height, path);
}

std::string curves_svg(const PreparedFigure& f) {
  const Canvas canvas = canvas_of(f);
  std::string out = canvas.open(f.title) + canvas.y_axis(f.y_label) + canvas.x_axis(f.x_label);
  for (const auto& curve : f.curves) {
    const auto path = fmt::format("<path class=\"curve {}{} c-{}\" d=\"{}\"/>", escape(curve.style),
                                  curve.few ? " few" : "", curve.colour, path_of(curve, canvas));
    out += leaves(curve, canvas) ? within_axes(path, canvas) : path;
  }
  if (f.x.empty() || f.y.empty())
    out += svg_text((canvas.left + canvas.width - canvas.right) / 2, canvas.height / 2, "middle", "no values to show");
  return out + "</svg>";
}

/// Colour of a step of a waterfall: orange where we start, blue where we end, pale blue between.
std::string waterfall_colour(const Bar& bar, std::size_t index, std::size_t count) {
  if (bar.role == "before" || (bar.role.empty() && index == 0)) return "before";
  if (bar.role == "after" || bar.role == "simulated" || (bar.role.empty() && index + 1 == count)) return "simulated";
  if (bar.role == "residual" || bar.role == "measured") return bar.role;
  return "step";
}

std::string rect(double x, double y, double width, double height, const std::string& css, const std::string& hover) {
  return fmt::format("<rect class=\"{}\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"><title>{}</title></rect>", css,
                     px(x), px(y), px(width), px(std::max(0.0, height)), escape(hover));
}

Canvas waterfall_canvas(const PreparedFigure& f, bool floor, std::size_t label_lines) {
  Canvas c;
  c.bottom = 12 + 15 * static_cast<double>(label_lines);
  c.height = 278 + c.bottom;
  c.top = 40;
  if (floor) c.right = 132;
  double low = 0, high = 0;
  for (const auto& bar : f.bars) {
    if (!std::isfinite(bar.value) || !(bar.value > 0)) continue;
    high = std::max(high, bar.value);
    low = low > 0 ? std::min(low, bar.value) : bar.value;
  }
  if (!(high > 0)) low = high = 1;
  c.y = {f.log_y ? Range{low / 2, high * 1.3} : Range{0, high * 1.04}, f.log_y, c.height - c.bottom, c.top};
  c.x = {Range{0, 1}, false, c.left, c.width - c.right};
  return c;
}

/// "+ creep" must not leave its plus alone on a line.
std::string keep_plus(std::string label) {
  if (label.starts_with("+ ")) label.replace(1, 1, "\u00a0");
  return label;
}

/// One step: its bar, what it took away from the step before as an outline, value above, label below.
std::string step_svg(const Bar& bar, const Bar* before, double x, double width, const std::string& colour,
                     const Canvas& c) {
  const double foot = c.height - c.bottom, slot = width / 0.62;
  const bool drawable = std::isfinite(bar.value) && (!c.y.log || bar.value > 0);
  const double head = drawable ? std::clamp(c.y(bar.value), c.top, foot) : foot;
  const std::string text = bar.text.empty() ? fmt::format("{:.3g}", bar.value) : bar.text;
  std::string out;
  double text_y = head - 6;
  if (before && drawable && before->value > bar.value) {
    const double former = std::clamp(c.y(before->value), c.top, foot);
    const double share = 100 * (1 - bar.value / before->value);
    out += rect(x, former, width, head - former, "ghost",
                fmt::format("{}: {:.1f} % less than the step before", bar.label, share));
    if (head - former > 62)
      out += svg_text(x + width / 2, (former + head) / 2 - 12, "middle", fmt::format("−{:.3g} %", share), "fall");
    // A text that would cross the outline's upper edge stands above it instead.
    if (head - former > 1 && head - former < 20) text_y = former - 6;
  }
  out += rect(x, head, width, foot - head, "bar c-" + colour, bar.label + ": " + text);
  const auto value_lines = wrap(text, 0.85 * slot, 2);  // bold, so wider than the estimate
  for (std::size_t i = 0; i < value_lines.size(); ++i)
    out += svg_text(x + width / 2, text_y - 16 * static_cast<double>(value_lines.size() - 1 - i), "middle",
                    value_lines[i], "value");
  double y = foot + 17;
  for (const auto& line : wrap(keep_plus(bar.label), slot - 8, 3)) {
    out += svg_text(x + width / 2, y, "middle", line);
    y += 15;
  }
  return out;
}

/// A dashed line for each floor, its words at the right end; where two lie close, the words of the lower one stand
/// below those of the upper one.
std::string floors_svg(std::vector<Bar> floors, const Canvas& c) {
  std::erase_if(floors, [&](const Bar& b) { return !std::isfinite(b.value) || (c.y.log && !(b.value > 0)); });
  std::stable_sort(floors.begin(), floors.end(), [](const Bar& a, const Bar& b) { return a.value > b.value; });
  const double foot = c.height - c.bottom;
  std::string out;
  double free_from = c.top;
  for (const auto& floor : floors) {
    const double y = std::clamp(c.y(floor.value), c.top, foot);
    out += fmt::format("<line class=\"floor\" x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\"/>", px(c.left), px(y),
                       px(c.width - c.right), px(y));
    double text_y = std::max(free_from, std::min(y + 4, foot - 14));
    for (const auto& text : {floor.label, floor.text})
      for (const auto& line : wrap(text, c.right - 12, 2)) {
        out += svg_text(c.width - c.right + 8, text_y, "start", line, "fall");
        text_y += 15;
      }
    free_from = text_y + 4;
  }
  return out;
}

std::string waterfall_svg(const PreparedFigure& f) {
  std::vector<Bar> steps, floors;
  for (const auto& bar : f.bars) (bar.role == "floor" ? floors : steps).push_back(bar);
  Canvas c = waterfall_canvas(f, !floors.empty(), 1);
  const double room = c.width - c.left - c.right;
  const double slot = std::min(190.0, room / static_cast<double>(std::max<std::size_t>(1, steps.size())));
  std::size_t label_lines = 1;
  for (const auto& step : steps) label_lines = std::max(label_lines, wrap(keep_plus(step.label), slot - 8, 3).size());
  c = waterfall_canvas(f, !floors.empty(), label_lines);
  const double foot = c.height - c.bottom;
  const double begin = c.left + (room - slot * static_cast<double>(steps.size())) / 2;
  std::string out = c.open(f.title) + c.y_axis(f.y_label);
  for (std::size_t i = 0; i < steps.size(); ++i)
    out += step_svg(steps[i], i > 0 ? &steps[i - 1] : nullptr, begin + slot * (static_cast<double>(i) + 0.19),
                    0.62 * slot, waterfall_colour(steps[i], i, steps.size()), c);
  out += fmt::format("<line class=\"axis\" x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\"/>", px(c.left), px(foot),
                     px(c.width - c.right), px(foot));
  return out + floors_svg(std::move(floors), c) + "</svg>";
}

}  // namespace

std::string figure_svg(const PreparedFigure& figure) {
  return figure.kind == "waterfall" ? waterfall_svg(figure) : curves_svg(figure);
}

std::string bars_html(const PreparedFigure& figure) {
  double low = 0, high = 0;
  for (const auto& bar : figure.bars) {
    if (!std::isfinite(bar.value)) continue;
    low = std::min(low, bar.value);
    high = std::max(high, bar.value);
  }
  const double span = high > low ? high - low : 1;
  const bool long_texts =
      std::any_of(figure.bars.begin(), figure.bars.end(), [](const Bar& bar) { return bar.text.size() > 18; });
  std::string out = fmt::format("<table class=\"bars{}\">", long_texts ? " long" : "");
  for (const auto& bar : figure.bars) {
    const double value = std::isfinite(bar.value) ? bar.value : 0;
    const double begin = 100 * (std::min(0.0, value) - low) / span, width = 100 * std::abs(value) / span;
    const std::string css = bar.role == "after" ? "simulated" : bar.role.empty() ? "p0" : bar.role;
    out += fmt::format(
        "<tr><th scope=\"row\"{}>{}</th><td class=\"track\"><svg><rect class=\"bar c-{}\" x=\"{:.2f}%\" "
        "width=\"{:.2f}%\" "
        "y=\"0\" height=\"100%\"/></svg></td><td>{}</td></tr>",
        bar.label.size() > 26 ? " class=\"prose\"" : "", escape(bar.label), escape(css), begin, width,
        escape_prose(bar.text.empty() ? fmt::format("{:.3g}", bar.value) : bar.text));
  }
  return out + "</table>";
}

std::string legend_html(const PreparedFigure& figure) {
  if (figure.curves.empty() || (figure.curves.size() == 1 && figure.curves.front().name.empty())) return "";
  std::string out = "<ul class=\"legend\">";
  for (const auto& curve : figure.curves)
    out += fmt::format("<li><svg viewBox=\"0 0 22 10\"><path class=\"curve {0} c-{1}\" d=\"{2}\"/></svg>{3}</li>",
                       escape(curve.style), curve.colour, curve.style == "points" ? "M4 5h0M11 5h0M18 5h0" : "M1 5h20",
                       escape(curve.name));
  return out + "</ul>";
}

}  // namespace hysteron
