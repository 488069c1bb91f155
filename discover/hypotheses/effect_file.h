// Decides how an effect stands in a JSON file, so that a user can add one of his own: a diagram with the inputs `in`
// (and perhaps a side signal) and the output `out`, and a member "effect" that says what it means.
// Does not decide whether it is missing (discover.h) nor how it enters (add.h).
#pragma once

#include <string>
#include <vector>

#include "discover/hypotheses/effect.h"
#include "engine/block/kernel.h"

namespace hysteron {

/// Reads an effect file. Throws Error with file, line and JSON path for what is wrong with the diagram, for ports that
/// are not there, parameters that the diagram does not have, numbers that make no sense; and, as a whole, if the
/// diagram does not compile with its start values.
Effect read_effect(const std::string& file, const Registry& registry, const std::vector<std::string>& allowed = {});

/// The library and the effects of these files; of a folder every *.json, by name.
/// Throws Error "effect_twice" where an id is taken already, "unknown_effect" where a look-alike is none.
Effects with_own_effects(const Effects& library, const std::vector<std::string>& files, const Registry& registry,
                         const std::vector<std::string>& allowed = {});

}  // namespace hysteron
