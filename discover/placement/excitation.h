// Decides what the recordings show at a place: range, reversals, holds, pace of the signal on the wire.
// Does not judge whether that suffices (each effect does).
#pragma once

#include <optional>

#include "discover/hypotheses/effect.h"
#include "discover/placement/places.h"
#include "engine/block/kernel.h"
#include "engine/program/program.h"
#include "io/data/dataset.h"

namespace hysteron {

/// Excitation::damping of a place in a diagram, compiled.
std::optional<double> damping_behind(const Program& program, const Place& place, const Unit& of_wire);
/// Excitation::inertia likewise.
std::optional<double> inertia_before(const Program& program, const Place& place);

/// Drives the diagram with the recordings and looks at the wires of `places`, one simulation per recording.
/// `free_paths`: parameters that are free beside those that the diagram declares free ("stage.gain").
/// Throws where the diagram does not compile or run.
std::vector<Excitation> circumstances_at(const Diagram& diagram, const Registry& registry, const DataSet& data,
                                         const std::vector<Place>& places,
                                         const std::vector<std::string>& free_paths = {});

/// The same at one place.
Excitation circumstances_at(const Diagram& diagram, const Registry& registry, const DataSet& data, const Place& place,
                            const std::vector<std::string>& free_paths = {});

}  // namespace hysteron
