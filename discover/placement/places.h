// Decides where in a diagram an effect may enter: a wire, or one input port, with the kind of place it is.
// All of them: places_of.cpp. Does not change the diagram (add.h).
#pragma once

#include <string>
#include <vector>

#include "discover/hypotheses/effect.h"
#include "engine/block/kernel.h"
#include "engine/diagram/diagram.h"
#include "io/data/dataset.h"

namespace hysteron {

/// A place: `at` is what a user would write behind --at.
struct Place {
  std::string kind;  ///< one of place_kinds; "" = named by the user
  std::string at;    ///< a signal ("drive", "stage.x": behind it, for all readers), an input port ("stage.in") or what
                     ///< is read off a signal ("outputs.x": behind it, for that output alone), or (vary) a block
  std::string wire;  ///< the signal that passes there
  std::string on{};  ///< the wire as it is without the effects that stand on it, where `at` is between these
  bool behind_core = false;  ///< of a core place: behind the core, not before it
  std::string side{};        ///< the signal or column that an effect reads there besides; "" = none
  bool is_other = false;     ///< by Effect::or_variation
  std::string by{};          ///< the type that replaces the block `at` (a variation that it offers); "" = no block is
  Unit side_unit{};          ///< of a column that the diagram does not read yet
  std::string group[4]{};    ///< by Commutes: places with one mark cannot be told apart by such a law
  /// The place as it is called whatever else stands there.
  const std::string& where() const { return on.empty() ? at : on; }
  std::string reading{};  ///< of a place before one reader of a wire: "outputs.x", the mux that bundles it, a damping;
                          ///< "" = all
  /// Where what it moves begins.
  const std::string& moves_from() const { return reading.empty() ? wire : reading; }
  const std::string& group_for(const Effect& effect) const { return group[static_cast<int>(effect.commutes)]; }
};

/// Every place of the diagram: from its "places", else worked out from inputs, outputs and the declarations of its
/// blocks.
std::vector<Place> find_places(const Diagram& diagram, const Registry& registry);

/// The places where `effect` may enter. A place where it already stands is left out.
/// For a `vary` effect: the blocks (chosen candidates included) whose type has the parameter that it sets.
/// For an effect that reads a side signal: each place with each such signal of the diagram and, where `data` is given,
/// each column of the recordings that is bound to nothing.
std::vector<Place> places_of(const Effect& effect, const Diagram& diagram, const Registry& registry,
                             const DataSet* data = nullptr);

/// The place that a user means: `at` as for place_at, "" = the first where the effect may enter; with the side signal
/// that it reads there. Throws Error "unknown_place", "no_side_signal".
Place place_for(const Effect& effect, const Diagram& diagram, const Registry& registry, const std::string& at,
                const DataSet* data = nullptr);

/// The place that a user named with --at, as a signal or an input port, also inside diagrams ("stage/actuator.u").
/// Throws Error "unknown_place" with the nearest name.
Place place_at(const Diagram& diagram, const Registry& registry, const std::string& at);

}  // namespace hysteron
