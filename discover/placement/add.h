// Decides how an effect enters a diagram as a choice and how it is taken out again without a trace (remove.cpp).
// Does not decide where it should (places.h) nor with which values (fit/).
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "discover/hypotheses/effect.h"
#include "discover/placement/places.h"
#include "engine/block/kernel.h"
#include "engine/diagram/diagram.h"
#include "engine/program/program.h"

namespace hysteron {

/// A diagram with an effect in it.
struct Added {
  Diagram diagram;
  std::string name;  ///< path of the choice: "drive_creep", "stage/actuator_creep"
  std::string effect, at;
  std::string law;                ///< which form of the effect
  std::vector<std::string> free;  ///< program paths of the law's free parameters: "drive_creep.amounts[0]" ...
  /// Nested diagrams that changed: file name as now written in the diagram, and content. The caller writes them beside
  /// it.
  std::vector<std::pair<std::string, Diagram>> nested;
  /// Diagrams that a user's own effect consists of, unchanged: file name as written in the diagram, and content. Where
  /// the diagram goes to another folder, they may go along.
  std::vector<std::pair<std::string, Diagram>> parts;
  std::vector<std::string> remarks;  ///< what was assumed, for the user
};

/// Puts `law` of `effect` at `place`:
///   "drive_creep": {"choose": "on", "in": "drive", "from": {"off": {"type": "pass"}, "on": {...}}}
/// right behind its source in the file; the readers of the wire (outputs included, `record` not) read it; a further
/// effect on that wire comes after it. A vary effect turns its block into a choice between the block as it was and as
/// it is now; a further one adds a candidate that says upon which one it stands:
///   "stage": {"choose": "friction", "effect": "stiffening", "in": "force",
///             "from": {"off": {...}, "on": {...}, "friction": {"effect": "friction", "upon": "on", ...}}}
/// Throws Error "unknown_place", "effect_there" (this effect stands at this place already).
Added add_effect(const Diagram& diagram, const Registry& registry, const Effect& effect, const Law& law,
                 const Place& place);

/// For `hysteron add`: the simplest law at `at` (a signal or an input port; "" = the first place where the effect may
/// enter), with start values for `circumstances`; without data these are placeholders and a remark says so.
Added add_effect(const Diagram& diagram, const Registry& registry, const Effect& effect, const std::string& at,
                 const Excitation* excitation = nullptr, const DataSet* data = nullptr);

/// Throws Error "closes_loop" if the program with an effect at `at` has an algebraic loop more than the one before: it
/// would be solved, but that is another diagram than the one that was asked about.
void refuse_new_loop(const Program& before, const Program& after, const std::string& at);

/// Takes out the effect of the choice `name` ("drive_creep"), or the only one with this id ("creep"); where several
/// stand in one choice, that with the id `effect`. Undoes add_effect exactly. Throws Error "unknown_effect" naming the
/// effects that are there, or "ambiguous_effect".
Diagram remove_effect(const Diagram& diagram, const Registry& registry, const std::string& name,
                      const std::string& effect = "");

/// Marks an input that an effect brought into the diagram, so that it leaves with it.
inline std::string side_remark(const std::string& effect) { return "read by " + effect; }

/// The effects that stand in a diagram: path of the choice and effect id, nested diagrams included.
std::vector<std::pair<std::string, std::string>> effects_in(const Diagram& diagram);

}  // namespace hysteron
