// Decides how far two curves are apart: at the instants of the coarser one, within a tolerance in value and along the
// axis. Knows no files and no units: numbers are SI.
#pragma once

#include <cstddef>
#include <vector>

namespace hysteron {

/// A curve: points in the order in which it passes them, straight between.
struct TraceLine {
  std::vector<double> x, y;
};

/// How x moves along a curve: a time only rises, the drive of a loop goes to and fro.
enum class TraceCourse { rising, to_and_fro };

/// A value may differ by absolute + relative * |value of the first curve|, at a place at most `along` away.
struct TraceTolerance {
  double absolute = 0;
  double relative = 0;
  double along = 0;
};

/// The second curve minus the first, at the points of the coarser one that lie in the range of the other.
struct TraceDistance {
  std::vector<double> x, first, second;  ///< values at the same place; of a loop's branches the nearest
  std::vector<double> allowed;           ///< absolute + relative * |first|
  std::vector<double> beyond;            ///< by how much the tolerance is exceeded; <= 0 within
  bool points_of_first = true;           ///< whose points were judged
  std::size_t left_out = 0;              ///< points of that curve outside the common range
  std::size_t outside = 0;               ///< points with beyond > 0
  double largest = 0, rms = 0;           ///< of |second - first|
  std::size_t largest_at = 0;            ///< row of the largest difference
  std::size_t worst_at = 0;              ///< row that is furthest beyond the tolerance
};

/// Compares two curves; the one with fewer points in the common range gives the points. Of `rising` curves x must not
/// fall. Where the other curve has a point at the same x (to 1e-9 of the range) that point counts, else the straight
/// line between its neighbours; nothing is extrapolated.
TraceDistance distance_of(const TraceLine& first, const TraceLine& second, TraceCourse course,
                          const TraceTolerance& tolerance);

}  // namespace hysteron
