// Decides what the recordings show at a place: range, reversals, holds, pace of the signal on the wire.
// Does not judge whether that suffices (each effect does).
#pragma once

#include "discover/effect.h"
#include "discover/places.h"
#include "engine/kernel.h"
#include "io/dataset.h"

namespace hysteron {

/// Drives the diagram with the recordings and looks at the wire of `place`. Throws where the diagram does not compile
/// or run.
Circumstances circumstances_at(const Diagram& diagram, const Registry& registry, const DataSet& data,
                               const Place& place);

/// The same for several places with one simulation per recording.
std::vector<Circumstances> circumstances_at(const Diagram& diagram, const Registry& registry, const DataSet& data,
                                            const std::vector<Place>& places);

}  // namespace hysteron
