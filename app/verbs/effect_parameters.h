// Decides which numbers a fit may change where a diagram has effects in it: those that the effect's law leaves free.
// Does not fit.
#pragma once

#include <string>
#include <vector>

#include "discover/hypotheses/effect.h"
#include "engine/program/program.h"
#include "fit/estimate/fit.h"

namespace hysteron {

/// Program paths of the free parameters of the effects that stand in `diagram` and are switched on:
/// "drive_creep.amounts[0]" ...
std::vector<std::string> effect_parameters(const Diagram& diagram, const Program& program, const Effects& effects);

/// Sentences on values that are possible, but unusual for the effect that they belong to.
std::vector<std::string> unusual_values(const Diagram& diagram, const FitResult& result, const Effects& effects);

}  // namespace hysteron
