// Decides how curves look in a terminal. See text_plot.h.
#include "report/pages/text_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "report/pages/numbers.h"

namespace hysteron {
namespace {

constexpr int width = 72, height = 15;

struct Ends {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  void take(double v) {
    low = std::min(low, v);
    high = std::max(high, v);
  }
  bool empty() const { return !(high >= low); }
  /// What is nothing beside the other end, and a span that is nothing beside its place, is rounding.
  void without_rounding() {
    const double nothing = 1e-9 * std::max(std::abs(low), std::abs(high));
    if (high - low <= nothing) low = high = 0.5 * (low + high);
    if (std::abs(low) <= nothing) low = 0;
    if (std::abs(high) <= nothing) high = 0;
  }
  double part(double v) const { return high > low ? std::clamp((v - low) / (high - low), 0.0, 1.0) : 0.5; }
};

/// A frame of characters; (0, 0) is its lower left corner.
class Frame {
 public:
  Frame() : rows_(height, std::string(width, ' ')) {}
  void mark(double x, double y, char c) {
    const auto column = static_cast<std::size_t>(std::lround(x * (width - 1)));
    const auto row = static_cast<std::size_t>(std::lround((1 - y) * (height - 1)));
    rows_[row][column] = c;
  }
  /// As many marks as the line passes characters.
  void line(double x0, double y0, double x1, double y1, char c) {
    const double steps = std::max({1.0, std::abs(x1 - x0) * width, std::abs(y1 - y0) * height});
    for (int k = 0; k <= static_cast<int>(std::ceil(steps)); ++k) {
      const double part = std::min(1.0, k / steps);
      mark(x0 + part * (x1 - x0), y0 + part * (y1 - y0), c);
    }
  }
  const std::vector<std::string>& rows() const { return rows_; }

 private:
  std::vector<std::string> rows_;
};

bool drawable(double x, double y, bool log_x) { return std::isfinite(x) && std::isfinite(y) && (!log_x || x > 0); }

void draw_curve(Frame& frame, const TextCurve& curve, const Ends& across, const Ends& up, bool log_x) {
  double x_before = 0, y_before = 0;
  bool pen_down = false;
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    const bool here = drawable(curve.x[i], curve.y[i], log_x);
    if (here) {
      const double x = across.part(log_x ? std::log10(curve.x[i]) : curve.x[i]), y = up.part(curve.y[i]);
      frame.line(pen_down ? x_before : x, pen_down ? y_before : y, x, y, curve.mark);
      x_before = x;
      y_before = y;
    }
    pen_down = here;
  }
}

}  // namespace

std::string text_plot(const std::vector<TextCurve>& curves, const std::string& x_label, const std::string& y_label,
                      bool log_x) {
  Ends across, up;
  for (const auto& curve : curves)
    for (std::size_t i = 0; i < curve.x.size(); ++i) {
      if (!drawable(curve.x[i], curve.y[i], log_x)) continue;
      across.take(log_x ? std::log10(curve.x[i]) : curve.x[i]);
      up.take(curve.y[i]);
    }
  if (across.empty()) return "";
  up.without_rounding();
  Frame frame;
  for (const auto& curve : curves) draw_curve(frame, curve, across, up, log_x);
  std::string out = "  " + y_label;
  for (const auto& curve : curves) out += fmt::format("   {} {}", std::string(2, curve.mark), curve.name);
  out += '\n';
  const std::string high = number_text(up.high, 3), low = number_text(up.low, 3);
  const auto margin = std::max(high.size(), low.size());
  for (std::size_t r = 0; r < frame.rows().size(); ++r) {
    const std::string end = r == 0 ? high : r + 1 == frame.rows().size() ? low : "";
    std::string line = fmt::format("  {:>{}} |{}", end, margin, frame.rows()[r]);
    line.erase(line.find_last_not_of(' ') + 1);
    out += line + '\n';
  }
  const auto end_text = [&](double v) { return number_text(log_x ? std::pow(10, v) : v, 3); };
  const std::string left = end_text(across.low), right = end_text(across.high);
  out += fmt::format("  {:>{}} +{}\n", "", margin, std::string(width, '-'));
  const auto room = static_cast<std::size_t>(width) - std::min<std::size_t>(width, left.size() + right.size());
  out += fmt::format("  {:>{}}  {}{:^{}}{}\n", "", margin, left, x_label + (log_x ? ", by decades" : ""), room, right);
  return out;
}

}  // namespace hysteron
