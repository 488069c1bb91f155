// Decides which points of a long curve are kept, so that a picture of it stays the same. Does not draw.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace hysteron {

/// Indices of the points to keep, increasing, about `budget` at most (all, if there are no more than that).
/// The curve is cut into buckets; of each, the first, last, lowest and highest point stay, so no peak is lost and a
/// line through the kept points covers the same pixels (the M4 rule: Jugel et al., Proc. VLDB 7 (2014) 797-808).
/// Buckets are equal in x where x never decreases; else (a loop, y over x) in the number of points, and extremes of x
/// stay too. A NaN (a gap) stays a gap.
std::vector<std::size_t> decimate(std::span<const double> x, std::span<const double> y, std::size_t budget);

/// True if x never decreases (NaN = false).
bool never_decreases(std::span<const double> x);

/// Divides `total` points among curves with these numbers of points: short curves keep all, the long ones share the
/// rest.
std::vector<std::size_t> share_budget(const std::vector<std::size_t>& points, std::size_t total);

}  // namespace hysteron
