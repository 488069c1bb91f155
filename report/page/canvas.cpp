#include "report/page/canvas.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/page/html.h"

namespace hysteron {

double Scale::operator()(double value) const {
  const auto place = [&](double v) { return log ? std::log10(v) : v; };
  return from + (to - from) * (place(value) - place(range.low)) / (place(range.high) - place(range.low));
}

Ticks Scale::ticks(int count) const {
  return log ? log_ticks(range.low, range.high, count) : linear_ticks(range.low, range.high, count);
}

std::string px(double value) {
  if (!std::isfinite(value)) return "0";
  std::string text = fmt::format("{:.1f}", value);
  if (text.ends_with(".0")) text.resize(text.size() - 2);
  return text == "-0" ? "0" : text;
}

std::string svg_text(double x, double y, const std::string& anchor, const std::string& text,
                     const std::string& css_class) {
  const std::string css = css_class.empty() ? "" : fmt::format(" class=\"{}\"", css_class);
  return fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"{}\"{}>{}</text>", px(x), px(y), anchor, css, escape(text));
}

double text_width(const std::string& text) {
  // Continuation bytes of UTF-8 have no width of their own.
  const auto letters =
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; });
  return 6.6 * static_cast<double>(letters);
}

std::vector<std::string> wrap(const std::string& text, double width, std::size_t lines) {
  std::vector<std::string> result(1);
  std::string glue;  // between the line and the next piece: a space, or nothing behind an underscore
  for (std::size_t begin = 0; begin < text.size();) {
    const auto end = std::min(text.find_first_of(" _", begin), text.size());
    const bool underscore = end < text.size() && text[end] == '_';
    const std::string piece = text.substr(begin, end - begin) + (underscore ? "_" : "");
    auto& line = result.back();
    if (line.empty() || text_width(line + glue + piece) <= width)
      line += (line.empty() ? "" : glue) + piece;
    else
      result.push_back(piece);
    glue = underscore ? "" : " ";
    begin = end + 1;
  }
  const bool cut = result.size() > lines;
  if (cut) result.resize(lines);
  for (auto& line : result) {
    const bool ellipsis = (cut && &line == &result.back()) || text_width(line) > width;
    if (!ellipsis) continue;
    while (!line.empty() && text_width(line) + 6.6 > width) {
      while (!line.empty() && (static_cast<unsigned char>(line.back()) & 0xC0) == 0x80) line.pop_back();
      if (!line.empty()) line.pop_back();
    }
    line += "…";
  }
  return result;
}

Canvas canvas_of(const PreparedFigure& f) {
  Canvas c;
  c.width = f.width > 0 ? f.width : f.wide ? 1000 : 490;
  c.height = f.height;
  c.x = {f.x.empty() ? Range{0, 1} : f.x, f.log_x && !f.x.empty(), 0, 0};
  c.y = {f.y.empty() ? Range{0, 1} : f.y, f.log_y && !f.y.empty(), c.height - c.bottom, c.top};
  const double air = 0.05;
  if (c.y.log) {
    const double factor = std::pow(c.y.range.high / c.y.range.low, air);
    c.y.range = {c.y.range.low / factor, c.y.range.high * factor};
  } else {
    const double margin = air * (c.y.range.high - c.y.range.low);
    c.y.range = {c.y.range.low - margin, c.y.range.high + margin};
  }
  double widest = 0;
  for (const auto& tick : c.y.ticks(6).list) widest = std::max(widest, text_width(tick.label));
  c.left = std::max(c.left, widest + 36);
  c.x.from = c.left;
  c.x.to = c.width - c.right;
  return c;
}

std::string Canvas::open(const std::string& title) const {
  return fmt::format("<svg class=\"plot\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">", px(width), px(height),
                     escape(title));
}

namespace {

std::string line(double x1, double y1, double x2, double y2, const char* css) {
  return fmt::format("<line class=\"{}\" x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\"/>", css, px(x1), px(y1), px(x2),
                     px(y2));
}

std::string with_exponent(const std::string& label, int exponent) {
  return exponent == 0 ? label : label + (label.empty() ? "" : " ") + exponent_text(exponent);
}

}  // namespace

std::string Canvas::x_axis(const std::string& label) const {
  const auto ticks = x.ticks(std::max(3, static_cast<int>((width - left - right) / 70)));
  const double foot = height - bottom;
  std::string out;
  for (const auto& tick : ticks.list) {
    out += line(x(tick.at), top, x(tick.at), foot, "grid");
    out += svg_text(x(tick.at), foot + 17, "middle", tick.label);
  }
  out += line(left, foot, width - right, foot, "axis");
  return out +
         svg_text((left + width - right) / 2, height - 9, "middle", with_exponent(label, ticks.exponent), "label");
}

std::string Canvas::y_axis(const std::string& label) const {
  const auto ticks = y.ticks(6);
  std::string out;
  for (const auto& tick : ticks.list) {
    const bool zero = !y.log && tick.at == 0;
    out += line(left, y(tick.at), width - right, y(tick.at), zero ? "grid zero" : "grid");
    out += svg_text(left - 8, y(tick.at) + 4, "end", tick.label);
  }
  const double middle = (top + height - bottom) / 2;
  const auto lines = wrap(with_exponent(label, ticks.exponent), height - bottom - top + 30, 1);
  return out + fmt::format(
                   "<text class=\"label\" transform=\"translate(15 {}) rotate(-90)\" text-anchor=\"middle\">{}</text>",
                   px(middle), escape(lines.front()));
}

}  // namespace hysteron
