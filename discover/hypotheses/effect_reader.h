// Decides how the member "effect" of an effect file is read, and what it says for people.
// Does not compile the diagram of the effect, nor read other files (effect_file.h).
#pragma once

#include <memory>
#include <string>

#include "discover/hypotheses/effect_content.h"

namespace hysteron {

/// An effect without its functions, and what these will work with.
struct EffectAsWritten {
  Effect effect;
  EffectContent content;
};

/// Reads what an effect file says besides its diagram, which was read from it before.
/// Throws Error with file, line and JSON path: "wrong_ports", "unknown_parameter", "bad_value", "wrong_unit" ...
EffectAsWritten read_effect_member(const std::string& file, std::shared_ptr<const Diagram> diagram);

}  // namespace hysteron
