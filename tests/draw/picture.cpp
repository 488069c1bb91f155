#include "tests/draw/picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <pugixml.hpp>
#include <sstream>
#include <stdexcept>

namespace hysteron::picture {
namespace {

constexpr double near = 0.011;  // the SVG has two decimals

std::vector<Place> places(std::string text) {
  for (char& c : text)
    if (c == 'M' || c == 'L' || c == ',') c = ' ';
  std::istringstream in(text);
  std::vector<Place> list;
  for (Place p; in >> p.x >> p.y;) list.push_back(p);
  return list;
}

Place moved(Place p, Place by) { return {p.x + by.x, p.y + by.y}; }

class Reader {
 public:
  Picture picture;

  void walk(const pugi::xml_node& node, Place shift) {
    const std::string transform = node.attribute("transform").value();
    double x = 0, y = 0;
    if (std::sscanf(transform.c_str(), "translate(%lf,%lf)", &x, &y) == 2) shift = moved(shift, {x, y});
    const std::string css = node.attribute("class").value();
    if (css == "block" || css == "block new" || css == "port-of-sheet") outline(node, shift);
    if (css.starts_with("wire")) wire(node, shift);
    if (css == "branch")
      picture.branches.push_back(moved({node.attribute("cx").as_double(), node.attribute("cy").as_double()}, shift));
    for (const auto& child : node.children()) walk(child, shift);
  }

 private:
  void outline(const pugi::xml_node& group, Place shift) {
    Outline o;
    o.path = group.attribute("data-block").value();
    o.type = group.attribute("data-type").value();
    o.is_new = std::string(group.attribute("class").value()).ends_with(" new");
    for (const auto& node : group.children()) {
      const std::string css = node.attribute("class").value();
      o.open |= css == "inside";
      if (std::string(node.name()) == "text") o.texts += std::string(node.text().get()) + "\n";
      if (css != "box" && css != "frame" && css != "port") continue;
      o.shape = node.name();
      if (o.shape == "rect") {
        o.left = node.attribute("x").as_double();
        o.top = node.attribute("y").as_double();
        o.right = o.left + node.attribute("width").as_double();
        o.bottom = o.top + node.attribute("height").as_double();
      } else if (o.shape == "circle") {
        const double r = node.attribute("r").as_double();
        o.left = node.attribute("cx").as_double() - r;
        o.top = node.attribute("cy").as_double() - r;
        o.right = o.left + 2 * r;
        o.bottom = o.top + 2 * r;
      } else {
        const auto points = places(node.attribute("points").value());
        o.left = o.right = points.at(0).x;
        o.top = o.bottom = points.at(0).y;
        for (const auto& p : points) {
          o.left = std::min(o.left, p.x), o.right = std::max(o.right, p.x);
          o.top = std::min(o.top, p.y), o.bottom = std::max(o.bottom, p.y);
        }
      }
    }
    o.left += shift.x, o.right += shift.x, o.top += shift.y, o.bottom += shift.y;
    picture.outlines.push_back(o);
  }

  void wire(const pugi::xml_node& group, Place shift) {
    Wire w;
    w.signal = group.attribute("data-signal").value();
    w.from = group.attribute("data-from").value();
    w.to = group.attribute("data-to").value();
    w.input = group.attribute("data-input").as_int();
    w.feedback = std::string(group.attribute("class").value()).find("feedback") != std::string::npos;
    for (const auto& p : places(group.child("path").attribute("d").value())) w.path.push_back(moved(p, shift));
    w.tip = moved(places(group.child("polygon").attribute("points").value()).at(0), shift);
    picture.wires.push_back(w);
  }
};

bool between(double low, double value, double high) { return value > low + near && value < high - near; }

/// Length that two pieces have in common if they lie on one line.
double shared(Place a, Place b, Place c, Place d) {
  const auto along = [](double p, double q, double r, double s) {
    return std::min(std::max(p, q), std::max(r, s)) - std::max(std::min(p, q), std::min(r, s));
  };
  if (a.y == b.y && c.y == d.y && std::abs(a.y - c.y) < 1) return along(a.x, b.x, c.x, d.x);
  if (a.x == b.x && c.x == d.x && std::abs(a.x - c.x) < 1) return along(a.y, b.y, c.y, d.y);
  return 0;
}

/// Does a piece run through the inside of an outline?
bool runs_through(Place a, Place b, const Outline& o) {
  if (a.y == b.y)
    return between(o.top, a.y, o.bottom) && std::max(a.x, b.x) > o.left + near && std::min(a.x, b.x) < o.right - near;
  return between(o.left, a.x, o.right) && std::max(a.y, b.y) > o.top + near && std::min(a.y, b.y) < o.bottom - near;
}

bool is_inside(const std::string& path, const std::string& diagram) { return path.starts_with(diagram + "/"); }

void check_wire(const Picture& picture, const Wire& w, std::vector<std::string>& list) {
  const std::string name = fmt::format("wire {} -> {}", w.signal, w.to);
  if (w.path.size() < 2) return list.push_back(name + " has no length");
  for (std::size_t i = 1; i < w.path.size(); ++i)
    if (w.path[i].x != w.path[i - 1].x && w.path[i].y != w.path[i - 1].y) list.push_back(name + " is oblique");
  if (std::abs(w.tip.x - w.path.back().x) > near || std::abs(w.tip.y - w.path.back().y) > near)
    list.push_back(name + ": the arrow head is not at its end");
  bool begins = false, ends = false;
  for (const auto& o : picture.outlines) {
    begins |= o.path == w.from && o.on_border(w.path.front());
    ends |= o.path == w.to && o.on_border(w.path.back());
    for (std::size_t i = 1; i < w.path.size(); ++i)
      if (!(o.open && (is_inside(w.from, o.path) || is_inside(w.to, o.path))) &&
          runs_through(w.path[i - 1], w.path[i], o))
        list.push_back(fmt::format("{} runs through {}", name, o.path));
  }
  if (!begins) list.push_back(name + " does not begin on the border of " + w.from);
  if (!ends) list.push_back(name + " does not end on the border of " + w.to);
}

}  // namespace

bool Outline::on_border(Place p) const {
  if (shape == "circle")
    return std::abs(std::hypot(p.x - (left + right) / 2, p.y - (top + bottom) / 2) - (right - left) / 2) < 2 * near;
  const bool x = std::abs(p.x - left) < near || std::abs(p.x - right) < near;
  const bool y = std::abs(p.y - top) < near || std::abs(p.y - bottom) < near;
  const bool within = p.x > left - near && p.x < right + near && p.y > top - near && p.y < bottom + near;
  // A triangle has its tip at the right, in the middle.
  if (shape == "polygon" && std::abs(p.x - right) < near) return std::abs(p.y - (top + bottom) / 2) < near;
  return within && (x || y);
}

bool Outline::holds(Place p) const { return between(left, p.x, right) && between(top, p.y, bottom); }

const Outline* Picture::find(const std::string& path, bool port) const {
  for (const auto& o : outlines)
    if (o.path == path && (o.type == "input" || o.type == "output") == port) return &o;
  return nullptr;
}

Picture read(const std::string& svg) {
  pugi::xml_document document;
  const auto result = document.load_string(svg.c_str());
  if (!result) throw std::runtime_error(result.description());
  Reader reader;
  const auto root = document.child("svg");
  reader.picture.width = root.attribute("width").as_double();
  reader.picture.height = root.attribute("height").as_double();
  reader.walk(root, {});
  return reader.picture;
}

std::vector<std::string> violations(const Picture& picture) {
  std::vector<std::string> list;
  for (std::size_t i = 0; i < picture.outlines.size(); ++i)
    for (std::size_t k = i + 1; k < picture.outlines.size(); ++k) {
      const Outline &a = picture.outlines[i], &b = picture.outlines[k];
      if ((a.open && is_inside(b.path, a.path)) || (b.open && is_inside(a.path, b.path))) continue;
      if (a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom)
        list.push_back(fmt::format("{} and {} overlap", a.path, b.path));
    }
  for (const auto& o : picture.outlines)
    if (o.left < 0 || o.top < 0 || o.right > picture.width || o.bottom > picture.height)
      list.push_back(o.path + " leaves the sheet");
  for (const auto& w : picture.wires) check_wire(picture, w, list);
  for (std::size_t i = 0; i < picture.wires.size(); ++i)
    for (std::size_t k = i + 1; k < picture.wires.size(); ++k) {
      const Wire &a = picture.wires[i], &b = picture.wires[k];
      if (a.path.empty() || b.path.empty() || a.path.front() == b.path.front()) continue;  // one signal
      for (std::size_t m = 1; m < a.path.size(); ++m)
        for (std::size_t n = 1; n < b.path.size(); ++n)
          if (shared(a.path[m - 1], a.path[m], b.path[n - 1], b.path[n]) > 1)
            list.push_back(
                fmt::format("wires {} -> {} and {} -> {} lie on each other", a.signal, a.to, b.signal, b.to));
    }
  return list;
}

}  // namespace hysteron::picture
