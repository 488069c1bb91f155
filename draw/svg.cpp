#include "draw/svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <pugixml.hpp>
#include <set>
#include <sstream>

#include "draw/branches.h"
#include "draw/pictogram.h"

namespace hysteron::draw {
namespace {

using pugi::xml_node;

constexpr char style[] = R"(
svg { background: #fff; font-family: "DejaVu Sans", Verdana, Arial, sans-serif; }
text { fill: #1b2733; stroke: none; }
.box, .frame { fill: #fff; stroke: #1b2733; stroke-width: 1.4; }
.frame { fill: #f6f8fa; }
.shadow { fill: #e9edf1; stroke: #8894a0; stroke-width: 1; }
.port { fill: #eef3f8; stroke: #1b2733; stroke-width: 1.2; }
.axis { stroke: #b9c2cb; stroke-width: 1; fill: none; }
.curve { stroke: #0b62a4; stroke-width: 1.6; fill: none; stroke-linejoin: round; }
.mark { fill: #0b62a4; }
.bar { stroke: #1b2733; stroke-width: 1; }
.wire path { fill: none; stroke: #1b2733; stroke-width: 1; shape-rendering: crispEdges; }
.vector path { stroke-width: 2; }
.wire polygon, .branch { fill: #1b2733; }
.new > .box, .new > .frame { stroke: #b3470a; stroke-width: 2.6; fill: #fff3ea; }
.mark-new { font-size: 11px; font-weight: bold; fill: #b3470a; paint-order: stroke; stroke: #fff; stroke-width: 3px; }
.title { font-size: 15px; font-weight: bold; }
.name { font-size: 12px; font-weight: bold; }
.formula { font-size: 12px; }
.value { font-size: 11px; }
.line { font-size: 10px; fill: #45525f; }
.small { font-size: 9px; fill: #45525f; }
.unit { font-size: 9px; fill: #6a7580; }
.name, .line, .unit, .sign { paint-order: stroke; stroke: #fff; stroke-width: 3px; stroke-linejoin: round; }
.inside .name, .inside .line, .inside .unit, .inside .sign { stroke: #f6f8fa; }
.sign { font-size: 12px; }
)";

constexpr double head = 8;  // length of an arrow head

std::string px(double value) {
  std::string text = fmt::format("{:.2f}", value);
  while (text.ends_with('0')) text.pop_back();
  if (text.ends_with('.')) text.pop_back();
  return text == "-0" ? "0" : text;
}

xml_node add(xml_node parent, const char* name, const char* css = nullptr) {
  xml_node node = parent.append_child(name);
  if (css != nullptr) node.append_attribute("class") = css;
  return node;
}

void set(xml_node node, const char* name, double value) { node.append_attribute(name) = px(value).c_str(); }

void text(xml_node parent, double x, double y, const char* anchor, const std::string& content, const char* css) {
  xml_node node = add(parent, "text", css);
  set(node, "x", x);
  set(node, "y", y);
  node.append_attribute("text-anchor") = anchor;
  node.text() = content.c_str();
}

void line(xml_node parent, Point a, Point b, const char* css) {
  xml_node node = add(parent, "line", css);
  set(node, "x1", a.x), set(node, "y1", a.y), set(node, "x2", b.x), set(node, "y2", b.y);
}

xml_node rectangle(xml_node parent, double x, double y, double width, double height, double round, const char* css) {
  xml_node node = add(parent, "rect", css);
  set(node, "x", x), set(node, "y", y), set(node, "width", width), set(node, "height", height);
  if (round > 0) set(node, "rx", round);
  return node;
}

void polygon(xml_node parent, const std::vector<Point>& points, const char* css) {
  std::string list;
  for (const auto& p : points) list += (list.empty() ? "" : " ") + px(p.x) + "," + px(p.y);
  add(parent, "polygon", css).append_attribute("points") = list.c_str();
}

/// An arrow head with its tip at `tip`, coming from `from`.
void arrow_head(xml_node parent, Point from, Point tip, double length, const char* css) {
  const double distance = std::hypot(tip.x - from.x, tip.y - from.y);
  if (distance == 0) return;
  const Point along{(tip.x - from.x) / distance, (tip.y - from.y) / distance};
  const Point foot{tip.x - length * along.x, tip.y - length * along.y};
  const double half = 0.38 * length;
  polygon(parent,
          {tip, {foot.x - half * along.y, foot.y + half * along.x}, {foot.x + half * along.y, foot.y - half * along.x}},
          css);
}

// --- symbols ---------------------------------------------------------------------------------------------------------

/// The pictogram in an area of the box, its middle at (x, y).
void draw_pictogram(xml_node parent, const Pictogram& picture, double x, double y, double half_width,
                    double half_height) {
  const auto at = [&](const std::pair<double, double>& p) {
    return Point{x + half_width * p.first, y - half_height * p.second};
  };
  if (picture.axes) {
    line(parent, at({-1.1, 0}), at({1.1, 0}), "axis");
    line(parent, at({0, -1.1}), at({0, 1.1}), "axis");
  }
  if (picture.time) {
    line(parent, at({-1, 0}), at({1.1, 0}), "axis");
    line(parent, at({-1, -1.1}), at({-1, 1.1}), "axis");
  }
  for (const auto& curve : picture.curves) {
    std::string points;
    for (const auto& p : curve) points += (points.empty() ? "" : " ") + px(at(p).x) + "," + px(at(p).y);
    add(parent, "polyline", "curve").append_attribute("points") = points.c_str();
  }
  for (const auto& [way, size] : picture.arrows) arrow_head(parent, at(way.front()), at(way.back()), 6 * size, "mark");
}

void draw_outline(xml_node group, const Item& item) {
  const double x = item.x, y = item.y, width = item.width(), height = item.height();
  const bool stacked = item.candidates > 1;
  switch (item.symbol.outline) {
    case Outline::circle: {
      xml_node circle = add(group, "circle", "box");
      set(circle, "cx", x + width / 2), set(circle, "cy", y + height / 2), set(circle, "r", width / 2);
      return;
    }
    case Outline::triangle:
      if (stacked)
        polygon(group, {{x + 4, y - 4}, {x + 4 + width, y - 4 + height / 2}, {x + 4, y - 4 + height}}, "shadow");
      polygon(group, {{x, y}, {x + width, y + height / 2}, {x, y + height}}, "box");
      return;
    case Outline::port:
      rectangle(group, x, y, width, height, height / 2, "port");
      return;
    case Outline::frame:
      if (stacked) rectangle(group, x + 4, y - 4, width, height, 0, "shadow");
      rectangle(group, x, y, width, height, 0, "frame");
      if (!item.inside) rectangle(group, x + 3, y + 3, width - 6, height - 6, 0, "axis");
      return;
    case Outline::box:
      if (stacked) rectangle(group, x + 4, y - 4, width, height, 0, "shadow");
      rectangle(group, x, y, width, height, 0, "box");
      return;
  }
}

void draw_text(xml_node group, const Item& item) {
  const Symbol& s = item.symbol;
  const double middle = item.y + item.height() / 2;
  double centre = item.x + item.width() / 2;
  const char* css = "formula";
  if (s.outline == Outline::triangle) centre = item.x + 0.36 * item.width(), css = "value";
  if (s.outline == Outline::port) css = "value";
  if (s.fraction) {
    double wide = 0;
    for (const auto& t : s.text) wide = std::max(wide, text_width(t, 12));
    text(group, centre, middle - 6, "middle", s.text[0], css);
    text(group, centre, middle + 15, "middle", s.text[1], css);
    line(group, {centre - wide / 2 - 2, middle}, {centre + wide / 2 + 2, middle}, "bar");
    return;
  }
  const double first = middle + 4 - 7.5 * (static_cast<double>(s.text.size()) - 1);
  for (std::size_t i = 0; i < s.text.size(); ++i)
    text(group, centre, first + 15 * static_cast<double>(i), "middle", s.text[i], css);
}

/// Signs of a sum: outside the circle beside each arrow, or in the box at each port.
void draw_signs(xml_node group, const Item& item) {
  for (std::size_t i = 0; i < item.in.size(); ++i) {
    const std::string sign = i < item.symbol.signs.size() && item.symbol.signs[i] == '-' ? "−" : "+";
    const Point port = in_port(item, static_cast<int>(i));
    const Point at{item.x + port.x, item.y + port.y};
    if (item.symbol.outline != Outline::circle)
      text(group, at.x + 9, at.y + 4, "middle", sign, "formula");
    else if (item.side[i] == Side::left)
      text(group, at.x - 7, at.y - 6, "middle", sign, "sign");
    else
      text(group, at.x + 8, item.side[i] == Side::top ? at.y - 4 : at.y + 12, "middle", sign, "sign");
  }
}

void draw_port_names(xml_node group, const Item& item) {
  if (!item.symbol.port_names || !item.symbol.signs.empty()) return;
  const bool alike = std::set<std::string>(item.in.begin(), item.in.end()).size() <= 1;  // the inputs of a mux
  for (std::size_t i = 0; i < item.in.size() && !alike; ++i) {
    const Point port = in_port(item, static_cast<int>(i));
    text(group, item.x + 5, item.y + port.y + 3, "start", item.in[i], "small");
  }
  for (std::size_t i = 0; i < item.out.size() && item.out.size() > 1; ++i) {
    const Point port = out_port(item, static_cast<int>(i));
    text(group, item.x + item.width() - 5, item.y + port.y + 3, "end", item.out[i], "small");
  }
}

/// Name, choice and values below the symbol; of an open diagram above its blocks, in one line.
void draw_caption(xml_node group, const Item& item) {
  if (item.is_port()) return;
  std::vector<std::string> lines;
  if (item.candidates > 1) lines.push_back(fmt::format("{} (1 of {})", item.chosen, item.candidates));
  lines.insert(lines.end(), item.caption.begin(), item.caption.end());
  if (item.inside) {
    text(group, item.x + 8, item.y + 16, "start", item.name, "name");
    const std::string all = fmt::format("{}", fmt::join(lines, ", "));
    text(group, item.x + 20 + 1.08 * text_width(item.name, 12), item.y + 16, "start", all, "line");
    return;
  }
  const double centre = item.x + item.width() / 2;
  double y = item.y + item.height() + 13;
  // The loop of a sum comes up in the middle below it: its name stands beside.
  const bool beside = item.symbol.outline == Outline::circle;
  text(group, beside ? centre + sum_name_offset : centre, y, beside ? "start" : "middle", item.name, "name");
  for (const auto& line : lines) text(group, centre, y += 12, "middle", line, "line");
}

/// The unit stands at the beginning of a wire.
void draw_units(xml_node group, const Sheet& sheet, int index) {
  const Item& item = sheet.items[static_cast<std::size_t>(index)];
  for (std::size_t i = 0; i < item.out_units.size(); ++i) {
    const bool is_read = std::any_of(sheet.wires.begin(), sheet.wires.end(), [&](const Wire& wire) {
      return wire.from == index && wire.out == static_cast<int>(i);
    });
    if (!is_read || item.out_units[i].empty()) continue;
    const Point port = out_port(item, static_cast<int>(i));
    text(group, item.x + port.x + 4, item.y + port.y - 4, "start", item.out_units[i], "unit");
  }
}

void draw_sheet(xml_node parent, const Sheet& sheet, bool open);

void draw_item(xml_node parent, const Sheet& sheet, int index) {
  const Item& item = sheet.items[static_cast<std::size_t>(index)];
  xml_node group = add(parent, "g", item.is_port() ? "port-of-sheet" : item.is_new ? "block new" : "block");
  group.append_attribute("data-block") = item.path.c_str();
  group.append_attribute("data-type") = item.type.c_str();
  add(group, "title").text() = item.tip.c_str();
  draw_outline(group, item);
  if (item.inside) {
    xml_node inside = add(group, "g", "inside");
    inside.append_attribute("transform") =
        fmt::format("translate({},{})", px(item.x), px(item.y + header_height)).c_str();
    draw_sheet(inside, *item.inside, true);
  } else {
    if (const Pictogram* picture = find_pictogram(item.symbol.picture)) {
      const double note = item.symbol.note.empty() ? 0 : 6;
      draw_pictogram(group, *picture, item.x + item.width() / 2, item.y + item.height() / 2 - note, pictogram_width / 2,
                     pictogram_height / 2);
    }
    if (!item.symbol.note.empty())
      text(group, item.x + item.width() / 2, item.y + item.height() - 4, "middle", item.symbol.note, "small");
    draw_text(group, item);
    if (!item.symbol.signs.empty()) draw_signs(group, item);
    draw_port_names(group, item);
  }
  draw_caption(group, item);
  if (item.is_new) text(group, item.x, item.y - (item.candidates > 1 ? 7 : 4), "start", "new", "mark-new");
  draw_units(group, sheet, index);
}

/// In an open diagram, what comes in or goes out continues to its border.
void draw_continuations(xml_node parent, const Sheet& sheet) {
  for (const auto& item : sheet.items) {
    const double y = item.y + item.height() / 2;
    if (item.type == "input") line(parent, {0, y}, {item.x, y}, "bar");
    if (item.type == "output") line(parent, {item.x + item.width(), y}, {sheet.width, y}, "bar");
  }
}

// --- wires -----------------------------------------------------------------------------------------------------------

void draw_wire(xml_node parent, const Sheet& sheet, const Wire& wire) {
  const Item& from = sheet.items[static_cast<std::size_t>(wire.from)];
  const bool is_vector = from.out_lengths[static_cast<std::size_t>(wire.out)] > 1;
  const std::string css = std::string("wire") + (is_vector ? " vector" : "") + (wire.feedback ? " feedback" : "");
  xml_node group = add(parent, "g", css.c_str());
  const Item& to = sheet.items[static_cast<std::size_t>(wire.to)];
  group.append_attribute("data-signal") = wire.signal.c_str();
  group.append_attribute("data-from") = from.path.c_str();
  group.append_attribute("data-to") = to.path.c_str();
  group.append_attribute("data-input") = wire.in;
  std::string d;
  for (const auto& p : wire.path) d += (d.empty() ? "M" : " L") + px(p.x) + " " + px(p.y);
  add(group, "path").append_attribute("d") = d.c_str();
  arrow_head(group, wire.path[wire.path.size() - 2], wire.path.back(), head, nullptr);
}

void draw_branches(xml_node parent, const Sheet& sheet) {
  for (const Point& p : branches_of(sheet)) {
    xml_node dot = add(parent, "circle", "branch");
    set(dot, "cx", p.x), set(dot, "cy", p.y), set(dot, "r", 2.6);
  }
}

void draw_sheet(xml_node parent, const Sheet& sheet, bool open) {
  if (open) draw_continuations(parent, sheet);
  for (const auto& wire : sheet.wires) draw_wire(parent, sheet, wire);
  draw_branches(parent, sheet);
  for (std::size_t i = 0; i < sheet.items.size(); ++i) draw_item(parent, sheet, static_cast<int>(i));
}

}  // namespace

std::string svg_text(const Sheet& sheet, const std::string& title) {
  pugi::xml_document document;
  xml_node svg = add(document, "svg");
  svg.append_attribute("xmlns") = "http://www.w3.org/2000/svg";
  const double top = title.empty() ? 0 : 30;
  const double width = std::max(sheet.width, title.empty() ? 0 : 1.1 * text_width(title, 15) + 24);
  const double height = sheet.height + top;
  svg.append_attribute("viewBox") = fmt::format("0 0 {} {}", px(std::ceil(width)), px(std::ceil(height))).c_str();
  set(svg, "width", std::ceil(width));
  set(svg, "height", std::ceil(height));
  svg.append_attribute("role") = "img";
  if (!title.empty()) add(svg, "title").text() = title.c_str();
  add(svg, "style").text() = style;
  if (!title.empty()) text(svg, 12, 24, "start", title, "title");
  xml_node root = add(svg, "g", "sheet");
  if (top > 0) root.append_attribute("transform") = fmt::format("translate(0,{})", px(top)).c_str();
  draw_sheet(root, sheet, false);
  std::ostringstream out;
  document.save(out, " ", pugi::format_indent | pugi::format_no_declaration);
  return out.str();
}

}  // namespace hysteron::draw
