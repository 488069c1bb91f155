// Decides over which stretches of time the rows of each part of a split lie. Does not decide the parts (splits.cpp).
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace hysteron {

/// From the first to the last of rows that follow one another [s]; of a single row both are the same.
struct TimeSpan {
  double from = 0, to = 0;
};

struct SpansInRecording {
  std::string recording;  ///< its name
  std::vector<TimeSpan> spans;
};

/// Of one part in one recording. Where there are more, as of a noisy rate, the shortest gaps between them are closed.
inline constexpr std::size_t most_spans = 50;

/// [part][span], in order of time. `t`: times of the rows [s], increasing; `part`: of each row, below `parts`.
std::vector<std::vector<TimeSpan>> spans_of(const std::vector<double>& t, const std::vector<int>& part,
                                            std::size_t parts);

}  // namespace hysteron
