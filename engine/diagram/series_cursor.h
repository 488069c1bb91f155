// Decides what a series is at times that only go on, without a search for each.
#pragma once

#include <cstddef>

#include "engine/diagram/series.h"

namespace hysteron {

/// What Series::value() says, for branches that do not go back: the piece is the last one or near behind it.
class SeriesCursor {
 public:
  /// The series must outlive the cursor.
  explicit SeriesCursor(const Series& series) : s_(series) {}

  /// The value at t [s] on the piece that holds `branch` [s]; at a sample it is that sample to the last bit.
  double value(double t, double branch) {
    const std::size_t n = s_.t.size();
    while (next_ < n && s_.t[next_] <= branch) ++next_;
    if (next_ == 0) return n == 0 ? 0.0 : s_.v.front();
    const std::size_t i = next_ - 1;
    if (s_.between == Between::hold || next_ == n) return s_.v[i];
    if (t == s_.t[next_]) return s_.v[next_];
    return s_.v[i] + (s_.v[next_] - s_.v[i]) * ((t - s_.t[i]) / (s_.t[next_] - s_.t[i]));
  }

 private:
  const Series& s_;
  std::size_t next_ = 0;  // first sample behind the piece
};

}  // namespace hysteron
