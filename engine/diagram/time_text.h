// Decides how a time is written for people where three digits of it are enough.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace hysteron {

/// "0.2 ms", "16 s", "30 min", "2.5 h"; seconds [s], negative ones too.
inline std::string time_text(double seconds) {
  const double size = std::abs(seconds);
  if (size >= 3600) return fmt::format("{:.3g} h", seconds / 3600);
  // What three digits would make "1e+03" of is told in the next unit.
  if (size >= 999.5) return fmt::format("{:.3g} min", seconds / 60);
  if (size >= 0.9995 || size == 0) return fmt::format("{:.3g} s", seconds);
  if (size >= 0.9995e-3) return fmt::format("{:.3g} ms", seconds * 1e3);
  return fmt::format("{:.3g} us", seconds * 1e6);
}

}  // namespace hysteron
