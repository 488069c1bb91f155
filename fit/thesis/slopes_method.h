// Decides how the weights of a Prandtl-Ishlinskii model of one-sided operators are read off the rising branch of a
// measured loop. Does not simulate, and does not judge what it finds.
#pragma once

#include <span>
#include <vector>

namespace hysteron {

struct SlopesFound {
  std::vector<double> weights;     ///< c_0 = m_0, c_i = m_i - m_(i-1) [y per u]
  std::vector<double> slopes;      ///< m_i of the straight line between thresholds i and i + 1 [y per u]
  std::vector<double> intercepts;  ///< of that line, at u = 0 [y]
  std::vector<int> samples;        ///< rows on each line; two lie on it whatever they are
};

/// Ordinary least squares with a free intercept over the rows between r_i and r_(i+1) (the last one: and the largest
/// input) that rise from the bottom of the input. After threshold r_i the virgin branch is straight with the slope m_i
/// = c_0 + ... + c_i; so is every branch that rises from an input of zero, where one-sided operators have no memory. A
/// rise counts if it begins at most 1 % of the span of u above its lowest value; it ends where u falls.
///
/// u and y: one row each, thresholds in the unit of u, the first 0, increasing. An offset of y does not matter.
/// Throws Error "bad_thresholds", "too_few_rows" where an interval has less than two rows.
/// Source: thesis Eqs. 2.6, 2.7 as corrected: the slope is the sum of the weights so far.
SlopesFound weights_by_slopes(std::span<const double> u, std::span<const double> y, std::span<const double> thresholds);

}  // namespace hysteron
