// Decides which effects hysteron knows.
#pragma once

#include "discover/hypotheses/effect.h"

namespace hysteron {

/// The library. One line per effect, one file per effect: discover/effects/.
Effects all_effects();

}  // namespace hysteron
