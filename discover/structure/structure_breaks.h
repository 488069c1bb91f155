// Decides where a structure breaks in: at a level, at instants, for a while. Internal to discover; structure.cpp lets
// the kinds of structure compete. Each fills `fall` with the fall of chi2 less what its own numbers cost.
#pragma once

#include <cstddef>
#include <optional>

#include "discover/structure/structure.h"

namespace hysteron {

class ResidualParts;

/// A step and another slope beyond a level.
std::optional<Structure> kink_at_level(const ResidualParts& parts, std::size_t level);
/// Jumps at which the drive does not jump, with constant levels between; where they share a level, at that level.
std::optional<Structure> jumps(const ResidualParts& parts);
/// Stretches of a recording in which something shakes that is silent elsewhere. They only tell when: as explanation
/// they cost one number per row.
std::optional<Structure> bursts(const ResidualParts& parts);

/// One above `at` and zero below; what x is above it.
std::vector<Rows> step_and_slope(const Rows& x, double at);

}  // namespace hysteron
