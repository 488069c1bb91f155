// Decides how well a measurement repeats where its drive repeats: the floor below which no model can be judged.
// Knows no diagram and no effect.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "fit/signals/excitation.h"

namespace hysteron {

/// Two takes of the same. `rms` holds for one take: the rms of their difference over the square root of two.
struct Repeatability {
  std::size_t rows = 0;       ///< compared; 0 = nothing repeats
  double rms = 0;             ///< [SI] offset between the takes included
  double without_offset = 0;  ///< [SI] the same with the mean difference of the takes taken off
  bool found() const { return rows > 0; }
};

/// Each period against the one before it; with three periods and more the first is left out, it may hold the start.
/// What a drive `u` that repeats to 1 % only does to the difference is taken off, with the gain that fits it best.
Repeatability between_periods(std::span<const double> y, std::span<const double> u, const Period& period);

/// Row by row; both have the same rows.
Repeatability between_takes(std::span<const double> a, std::span<const double> b);

/// True if two drives are the same row by row, to 0.1 % of their range.
bool same_drive(std::span<const double> a, std::span<const double> b);

}  // namespace hysteron
