// Decides where on a wire an effect enters among those that stand there, and which wires are measured. Internal to
// discover.
#pragma once

#include <string>
#include <vector>

#include "discover/placement/places.h"
#include "discover/wiring/wiring.h"

namespace hysteron {

/// A place on `wire` for an effect of `kind`: behind the effects that stand there already, but before those that come
/// later along the signal: a lag of the amplifier enters before a hysteresis that was found first, a resonance before
/// the curve of a sensor.
Place on_wire(const Wiring& w, const Registry& registry, const std::string& kind, const std::string& wire);
/// The signal before constant offsets and what a cable picks up: a gain-like effect must not act on the zero of a
/// sensor, and nothing in the device delays the mains.
std::string before_offset(const Wiring& w, const std::string& signal);
/// A signal that is the end of a chain of effects, told as the wire on which they stand: "u" rather than
/// "u_hysteresis".
std::string start_of_chain(const Wiring& w, const std::string& signal);
/// The wires that are measured: that of each output, or those that a mux bundles for it, each with a law of its own.
std::vector<std::string> measured_wires(const Wiring& w);
/// Marks with which other places it would be one finding (Place::group).
void set_groups(const Wiring& w, Place& place);

}  // namespace hysteron
