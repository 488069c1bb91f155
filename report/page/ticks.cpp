#include "report/page/ticks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace hysteron {
namespace {

std::string superscript(int n) {
  static const char* const digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = n < 0 ? "⁻" : "";
  for (const char c : std::to_string(std::abs(n))) text += digits[c - '0'];
  return text;
}

/// A true minus sign, as wide as a plus.
std::string with_minus(std::string text) {
  if (!text.empty() && text.front() == '-') text.replace(0, 1, "−");
  return text;
}

/// The smallest of 1, 2, 5, 10 times a power of ten that is not below `rough`.
double nice_step(double rough) {
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double m : {1.0, 2.0, 5.0})
    if (m * power >= rough * (1 - 1e-9)) return m * power;
  return 10 * power;
}

std::string decade_label(int k) {
  if (k >= -3 && k <= 4) return fmt::format("{:g}", std::pow(10.0, k));
  return "10" + superscript(k);
}

}  // namespace

std::string exponent_text(int exponent) { return exponent == 0 ? "" : "×10" + superscript(exponent); }

Ticks linear_ticks(double low, double high, int count) {
  Ticks ticks;
  if (!std::isfinite(low) || !std::isfinite(high) || !(high > low)) return ticks;
  const double step = nice_step((high - low) / std::max(1, count));
  const double largest = std::max(std::abs(low), std::abs(high));
  // Beyond these sizes digits that only place the point would fill the axis.
  if (largest >= 1e5 || largest < 1e-2) ticks.exponent = 3 * static_cast<int>(std::floor(std::log10(largest) / 3));
  const double factor = std::pow(10.0, ticks.exponent);
  const int decimals = std::clamp(-static_cast<int>(std::floor(std::log10(step / factor) + 1e-9)), 0, 12);
  const double first = std::ceil(low / step - 1e-9), last = std::floor(high / step + 1e-9);
  // Where numbers lie so close that the last digit of k is gone, adding one to it would not move it.
  for (int i = 0; i <= static_cast<int>(std::min(last - first, 1e6)); ++i) {
    const double k = first + i;
    const double at = k == 0 ? 0.0 : k * step;  // never "-0"
    ticks.list.push_back({at, with_minus(fmt::format("{:.{}f}", at / factor, decimals))});
  }
  return ticks;
}

Ticks log_ticks(double low, double high, int count) {
  Ticks ticks;
  if (!(low > 0) || !std::isfinite(high) || !(high > low)) return ticks;
  const double decades = std::log10(high / low);
  if (decades < 1) return linear_ticks(low, high, count);
  const int first = static_cast<int>(std::floor(std::log10(low))), last = static_cast<int>(std::ceil(std::log10(high)));
  const int stride = std::max(1, static_cast<int>(std::ceil(decades / std::max(1, count))));
  const bool between = 3 * decades <= count;
  for (int k = first; k <= last; ++k) {
    if (k % stride != 0) continue;
    for (const double m : {1.0, 2.0, 5.0}) {
      const double at = m * std::pow(10.0, k);
      if (at < low * (1 - 1e-9) || at > high * (1 + 1e-9)) continue;
      if (m == 1.0)
        ticks.list.push_back({at, decade_label(k)});
      else if (between)
        ticks.list.push_back(
            {at, k >= -3 && k <= 4 ? fmt::format("{:g}", at) : fmt::format("{:g}·{}", m, decade_label(k))});
    }
  }
  return ticks;
}

}  // namespace hysteron
