#include "report/page/figure_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "report/page/html.h"

namespace hysteron {
namespace {

/// A JSON string. Bytes that are no UTF-8 are left to the browser, which shows them as replacement characters.
std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto u = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      out += fmt::format("\\{}", c);
    else if (u < 0x20)
      out += fmt::format("\\u{:04x}", u);
    else
      out += c;
  }
  return out + '"';
}

/// Digits that resolve the range to a millionth (x: a hundred-millionth, since neighbouring times must stay apart),
/// also where a small range sits on a large offset.
int digits_for(const std::vector<double>& values, int resolution) {
  double low = 0, high = 0, largest = 0;
  bool any = false;
  for (const double v : values) {
    if (!std::isfinite(v)) continue;
    low = any ? std::min(low, v) : v;
    high = any ? std::max(high, v) : v;
    largest = std::max(largest, std::abs(v));
    any = true;
  }
  if (!(high > low)) return 9;
  const int extra = static_cast<int>(std::ceil(std::log10(largest / (high - low))));
  return std::clamp(resolution + std::max(0, extra), resolution, 15);
}

void append_numbers(const std::vector<double>& values, int digits, std::string& out) {
  out += '[';
  bool first = true;
  for (const double v : values) {
    if (!first) out += ',';
    if (std::isfinite(v))
      fmt::format_to(std::back_inserter(out), "{:.{}g}", v, digits);
    else
      out += "null";
    first = false;
  }
  out += ']';
}

void append_range(const char* key, const Range& range, std::string& out) {
  if (range.empty())
    fmt::format_to(std::back_inserter(out), "\"{}\":null", key);
  else
    fmt::format_to(std::back_inserter(out), "\"{}\":[{},{}]", key, range.low, range.high);
}

}  // namespace

std::string figure_data(const PreparedFigure& f, const std::string& link) {
  std::string out = fmt::format(
      "{{\"title\":{},\"x_label\":{},\"y_label\":{},\"log_x\":{},\"log_y\":{},\"wide\":{},\"height\":{},\"link\":{},",
      quoted(f.title), quoted(f.x_label), quoted(f.y_label), f.log_x, f.log_y, f.wide, f.height, quoted(link));
  append_range("x", f.x, out);
  out += ',';
  append_range("y", f.y, out);
  out += ",\"curves\":[";
  for (std::size_t i = 0; i < f.curves.size(); ++i) {
    const auto& c = f.curves[i];
    if (i > 0) out += ',';
    out += fmt::format("{{\"name\":{},\"style\":{},\"colour\":\"{}\",\"monotone\":{},\"few\":{},\"under\":{},\"x\":",
                       quoted(c.name), quoted(c.style), c.colour, c.monotone, c.few, c.under);
    append_numbers(c.x, digits_for(c.x, 8), out);
    out += ",\"y\":";
    append_numbers(c.y, digits_for(c.y, 6), out);
    if (!c.shade.empty()) {
      out += ",\"shade\":";
      append_numbers(c.shade, 4, out);
    }
    out += '}';
  }
  return escape_json(out + "]}");
}

}  // namespace hysteron
