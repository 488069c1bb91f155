// Decides which effects there are: those that a source of discover/effects defines.
#pragma once

#include <vector>

#include "discover/hypotheses/effect.h"

namespace hysteron {

/// The library, in the order in which the documentation shows it.
Effects all_effects();

namespace effects {
/// The functions that make them, each defined as `Effect name() {`. The build writes this list
/// (discover/CMakeLists.txt).
std::vector<Effect (*)()> effect_functions();
}  // namespace effects

}  // namespace hysteron
