// Decides which effects are missing by choosing among models: the user's model with everything that nobody knows
// exactly is the null, each effect at each place with each law is a rival, and one score compares them all
// (block_score.h). Takes values and returns a value, as discover() does. See docs/discovery.md.
#pragma once

#include "discover/search/discover.h"

namespace hysteron {

/// As discover(), by models in place of steps.
Discovery select_model(const Diagram& diagram, const DataSet& data, const Registry& registry, const Effects& effects,
                       const DiscoverOptions& options = {});

}  // namespace hysteron
