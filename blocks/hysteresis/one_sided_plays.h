// Decides what the laws of one-sided play operators share: one memory for each threshold, which begin with 0. Does not
// weigh them.
#pragma once

#include <span>
#include <string>

#include "engine/block/block.h"

namespace hysteron::blocks {

/// As many of `where` (memory, sampled states) as there are thresholds, of which each has its weight.
Sizes one_play_per_threshold(const Shape& shape, int Sizes::*where);

/// Writes the operators as they are behind an input of `before` into v.out.
void start_one_sided_plays(const View<double>& v, std::span<const double> thresholds, double before);

/// "" or what is wrong with the first threshold.
std::string begins_at_zero(double first);

}  // namespace hysteron::blocks
