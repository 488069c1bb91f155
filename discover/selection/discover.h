// Decides which effects are missing by choosing among models: the user's model with everything that nobody knows
// exactly is the null, each effect at each place with each law is a rival, and one score compares them all
// (block_score.h). Takes values and
// returns a value. See docs/discovery.md.
#pragma once

#include "discover/search/discovery.h"

namespace hysteron {

/// The whole loop. Throws Error where diagram and data do not fit together; a candidate that fails costs only itself.
/// Throws Stopped where the caller's own scope (engine/diagram/stop.h) ends it before the user's model was simulated
/// once.
Discovery discover(const Diagram& diagram, const DataSet& data, const Registry& registry, const Effects& effects,
                   const DiscoverOptions& options = {});

/// WHICH effect is missing: the first step of discover alone.
Discovery diagnose(const Diagram& diagram, const DataSet& data, const Registry& registry, const Effects& effects,
                   DiscoverOptions options = {});

}  // namespace hysteron
