#include "report/page/waterfall_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "report/page/canvas.h"
#include "report/page/html.h"

namespace hysteron {
namespace {

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

/// From zero, on a log axis from below the smallest, to above the largest.
Range range_of(const PreparedFigure& f) {
  double low = 0, high = 0;
  for (const auto& bar : f.bars) {
    if (!std::isfinite(bar.value) || !(bar.value > 0)) continue;
    high = std::max(high, bar.value);
    low = low > 0 ? std::min(low, bar.value) : bar.value;
  }
  if (!(high > 0)) low = high = 1;
  return f.log_y ? Range{low / 2, high * 1.3} : Range{0, high * 1.04};
}

Canvas waterfall_canvas(const PreparedFigure& f, bool floor, std::size_t label_lines) {
  Canvas c;
  c.bottom = 12 + 15 * static_cast<double>(label_lines);
  c.height = 278 + c.bottom;
  c.top = 40;
  if (floor) c.right = 132;
  c.y = {range_of(f), f.log_y, c.height - c.bottom, c.top};
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

// ---- in rows --------------------------------------------------------------------------------------------------------

/// Steps and floors of a waterfall apart.
std::pair<std::vector<Bar>, std::vector<Bar>> apart(const PreparedFigure& f) {
  std::pair<std::vector<Bar>, std::vector<Bar>> list;
  for (const auto& bar : f.bars) (bar.role == "floor" ? list.second : list.first).push_back(bar);
  return list;
}

Canvas rows_canvas(const PreparedFigure& f, std::size_t floors) {
  Canvas c;
  c.width = f.width;
  c.height = f.height;
  c.left = 14;
  c.top = 8 + 15 * static_cast<double>(floors);
  c.x = {range_of(f), f.log_y, c.left, c.width - c.right};
  return c;
}

/// One step: its label, below it its bar, behind that what it took away and the value.
std::string row_svg(const Bar& bar, const Bar* before, double y, double thick, const std::string& colour,
                    const Canvas& c) {
  const double foot = c.left;
  const bool drawable = std::isfinite(bar.value) && (!c.x.log || bar.value > 0);
  const double head = drawable ? std::max(foot, c.x(bar.value)) : foot;
  const std::string text = bar.text.empty() ? fmt::format("{:.3g}", bar.value) : bar.text;
  std::string label = bar.label;
  std::string out;
  if (before != nullptr && drawable && before->value > bar.value) {
    const double share = 100 * (1 - bar.value / before->value);
    label += fmt::format(" (−{:.3g} %)", share);
    out += rect(head, y, c.x(before->value) - head, thick, "ghost",
                fmt::format("{}: {:.1f} % less than the step before", bar.label, share));
  }
  out += rect(foot, y, head - foot, thick, "bar c-" + colour, bar.label + ": " + text);
  out += svg_text(foot, y - 5, "start", wrap(label, c.width - c.left - c.right, 1).front(), "label");
  const double room = c.width - c.right - head - 8;
  const double width = 1.15 * text_width(text);  // bold
  return out + (width <= room ? svg_text(head + 8, y + thick / 2 + 5, "start", text, "value")
                              : svg_text(head - 8, y + thick / 2 + 5, "end", text, "value"));
}

/// A dashed line for each floor, its words above the rows, the lower floor's first.
std::string floor_lines(std::vector<Bar> floors, const Canvas& c) {
  std::stable_sort(floors.begin(), floors.end(), [](const Bar& a, const Bar& b) { return a.value < b.value; });
  std::string out;
  double y = 14;
  for (const auto& floor : floors) {
    if (!std::isfinite(floor.value) || (c.x.log && !(floor.value > 0))) continue;
    const double x = std::max(c.left, c.x(floor.value));
    const bool left = x < c.width / 2;
    out += fmt::format("<line class=\"floor\" x1=\"{0}\" y1=\"{1}\" x2=\"{0}\" y2=\"{2}\"/>", px(x), px(y - 8),
                       px(c.height - c.bottom));
    out += svg_text(left ? x + 6 : x - 6, y, left ? "start" : "end", floor.label + " " + floor.text, "fall");
    y += 15;
  }
  return out;
}

}  // namespace

std::string waterfall_svg(const PreparedFigure& f) {
  auto [steps, floors] = apart(f);
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

std::string waterfall_rows_svg(const PreparedFigure& f) {
  const auto [steps, floors] = apart(f);
  const Canvas c = rows_canvas(f, floors.size());
  const double slot = (c.height - c.bottom - c.top) / static_cast<double>(std::max<std::size_t>(1, steps.size()));
  const double thick = std::clamp(slot - 34, 8.0, 56.0);
  std::string out = c.open(f.title) + c.x_axis(f.y_label) + floor_lines(floors, c);
  for (std::size_t i = 0; i < steps.size(); ++i)
    out += row_svg(steps[i], i > 0 ? &steps[i - 1] : nullptr,
                   c.top + slot * static_cast<double>(i) + 22 + (slot - 34 - thick) / 4, thick,
                   waterfall_colour(steps[i], i, steps.size()), c);
  return out + "</svg>";
}

}  // namespace hysteron
