// Decides at which frequencies a model rings by itself. What a law that is not quite right leaves before a plant rings
// there, whatever it is.
#pragma once

#include <vector>

#include "discover/hypotheses/effect.h"
#include "engine/program/program.h"

namespace hysteron {

/// The pairs of complex poles of the program near rest, all inputs at zero, by rising frequency; none where it cannot
/// be linearized there (sampled blocks).
std::vector<Resonance> own_resonances(const Program& program);

}  // namespace hysteron
