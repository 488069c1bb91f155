// Decides how blocks look before they stand in a diagram. Does not list them: the verb blocks does.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "engine/block/kernel.h"

namespace hysteron::studio {

/// The symbol of each type as item_json(), without a value of its own.
nlohmann::ordered_json palette_symbols(const Registry& registry);

/// The law of each type as MathML (mathml.h).
nlohmann::ordered_json palette_laws(const Registry& registry);

}  // namespace hysteron::studio
