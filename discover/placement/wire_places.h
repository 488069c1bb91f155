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
/// the curve of a sensor. And before what moves a reading alone, unless it is `behind_offset` itself: nothing in the
/// device delays the mains or what the zero of an amplifier drifts.
Place on_wire(const Wiring& w, const Registry& registry, const std::string& kind, const std::string& wire,
              bool behind_offset = false);
/// The signal before what moves a reading alone, and constant offsets: a gain-like effect must not act on the zero of
/// a sensor.
std::string before_offset(const Wiring& w, const std::string& signal);
/// A signal of a chain of effects, told as the wire on which they stand: "u" rather than "u_hysteresis".
std::string start_of_chain(const Wiring& w, const std::string& signal);
/// A wire that is measured, and who reads it there: an output of the diagram, or a mux that bundles it for one.
struct Reading {
  std::string wire;
  Reader by;
};
/// Of each output, or of what a mux bundles for it, each with a law of its own.
std::vector<Reading> readings(const Wiring& w);
std::vector<std::string> measured_wires(const Wiring& w);
/// Where an effect of a sensor enters that reads `reading`. Of a wire that moves other blocks as well (the speed of a
/// motor, which makes its back-EMF) it is what is read: the speed itself knows nothing of the sensor. Where a
/// controller of the diagram acts on it the wire is a second one, for the controller may read the sensor, too.
/// `behind_offset`: also behind the zero of the sensor.
std::vector<Place> measured_places(const Wiring& w, const Registry& registry, const Reading& reading,
                                   bool behind_offset);
/// "outputs.x" names what is read off a signal for an output; nothing else.
const std::string* output_of_reading(const Diagram& diagram, const std::string& at);
/// The place there.
Place place_of_reading(const Wiring& w, const std::string& output);
/// Is the block a gain that makes a force of a speed, or a torque of that of a rotation, by its unit?
bool is_damping(const Wiring& w, const std::string& block);
/// Beside the damping `block`: what enters there brakes as it does, and whoever else reads the speed knows nothing of
/// it.
Place place_of_damping(const Wiring& w, const std::string& block);
/// Beside every damping that moves an output, of nested diagrams, too.
std::vector<Place> damping_places(const Wiring& w, const Registry& registry);
/// A place inside the nested diagram `block`, told from outside.
Place seen_from_outside(Place place, const std::string& block);
/// Marks with which other places it would be one finding (Place::group).
void set_groups(const Wiring& w, Place& place);

}  // namespace hysteron
