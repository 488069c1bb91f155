// Decides how a sampled signal moves between its samples. Does not know where the samples come from.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace hysteron {

/// Straight lines from sample to sample; each until the next; or a cubic spline through them, which the engine is given
/// as straight pieces (smooth_series.h).
enum class Between { linear, hold, smooth };
/// As files say it: "linear", "hold", "smooth".
std::string to_text(Between between);
/// What to_text() wrote; linear for anything else.
Between between_of(const std::string& text);

/// A recorded signal: strictly increasing times [s], values [SI]. Before the first and behind the last sample it is
/// constant.
struct Series {
  std::vector<double> t;
  std::vector<double> v;
  Between between = Between::linear;  ///< not smooth: see in_straight_pieces()

  /// Index k of the piece [t_k, t_k+1) that holds `time`: -1 before the first sample, size-1 behind the last.
  long piece(double time) const;
  /// Value at `time` on the piece that holds `branch`; with branch = time the right-continuous value.
  double value(double time, double branch) const;
  double slope(double branch) const;  ///< [SI/s]
  /// First sample time behind `time`, or infinity.
  double next_breakpoint(double time) const;
};

using SeriesPointer = std::shared_ptr<const Series>;

}  // namespace hysteron
