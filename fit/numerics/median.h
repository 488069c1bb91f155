// Decides what the middle of some numbers is.
#pragma once

#include <span>
#include <vector>

namespace hysteron {

/// Of an even number of values the upper one of the middle two; 0 of none.
double median(std::vector<double> values);
/// The same of values whose order does not matter any more.
double median_of(std::span<double> values);
/// Median difference of consecutive times, in their unit; 0 of fewer than two.
double median_step(std::span<const double> t);

}  // namespace hysteron
