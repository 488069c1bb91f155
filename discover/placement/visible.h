// Decides which effects a data set can show in a diagram, and why the others cannot be seen and what would show them.
// Tries none of them: "cannot be seen in this data" is not "absent".
#pragma once

#include <string>
#include <vector>

#include "discover/hypotheses/effect.h"
#include "engine/block/kernel.h"
#include "engine/diagram/diagram.h"
#include "io/data/dataset.h"

namespace hysteron {

/// One effect, over all places where it may enter the diagram.
struct Visible {
  std::string effect, title;
  std::vector<std::string> places;  ///< where it could be seen; none = it cannot
  std::string unsure;               ///< which of its needs these data do not meet, at all these places; "" = none
  std::string reason;               ///< why it cannot at the place that comes nearest, and what it needs; "" = it can
  bool needs_block = false;         ///< it cannot because the diagram lacks a block that it varies
  bool can() const { return !places.empty(); }
  bool can_well() const { return can() && unsure.empty(); }
};

/// Every effect, in the order of the library. Throws where the diagram does not compile or run.
std::vector<Visible> visible_effects(const Diagram& diagram, const DataSet& data, const Registry& registry,
                                     const Effects& effects, const std::vector<std::string>& free_paths = {});

/// Why an effect has no place in a diagram with these data, for people.
std::string why_no_place(const Effect& effect, const Registry& registry);

}  // namespace hysteron
