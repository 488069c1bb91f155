// Decides what one structure explains of rows, at its best, and how many numbers that takes.
#pragma once

#include <vector>

#include "discover/structure/structure.h"

namespace hysteron {

class ResidualParts;

/// What is left of one output, as all other models of it are counted.
struct StructureFit {
  std::vector<Rows> left;  ///< [SI] of each part
  /// What it takes to say it, in numbers that are known to 1/sqrt(n): heights, amplitudes and phases are. Where it
  /// jumps is known to 1/n and counts for two, a frequency to n^(-3/2) and counts for three (Djuric, IEEE Transactions
  /// on Signal Processing 46 (1998) 2726).
  int numbers = 0;
};

/// By least squares over all recordings alike. `rows`: measured less predicted [SI], `weights`: of each row, of each
/// part. `with_gain`: beside a gain and an offset of the whole output. What does not
/// explain, bursts or more levels than a thousand, leaves the rows as they are.
StructureFit fit_structure(const Structure& structure, const ResidualParts& parts, const std::vector<Rows>& rows,
                           const std::vector<Rows>& weights, bool with_gain);

}  // namespace hysteron
