// Decides where an axis has its ticks and what stands at them. Does not draw.
// report.js follows the same rules when the reader zooms.
#pragma once

#include <string>
#include <vector>

namespace hysteron {

struct Tick {
  double at = 0;
  std::string label;
};

struct Ticks {
  std::vector<Tick> list;
  int exponent =
      0;  ///< labels are values / 10^exponent; a multiple of 3, shown once at the axis: "displacement [m] ×10⁻⁶"
};

/// Ticks at 1, 2 or 5 times a power of ten, at most about `count` of them, all within [low, high].
Ticks linear_ticks(double low, double high, int count);

/// Ticks at powers of ten, with 2 and 5 between them where there is room; below one decade, linear ticks. low > 0.
Ticks log_ticks(double low, double high, int count);

/// "×10⁻⁶", or "" for 0.
std::string exponent_text(int exponent);

}  // namespace hysteron
