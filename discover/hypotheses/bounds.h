// Decides how it is told between which values a search looks for a parameter of an effect: the numbers where these are
// always the same, else what of the recordings sets them.
#pragma once

#include <string>

#include "discover/hypotheses/effect.h"

namespace hysteron {

/// "0 .. 0.4", "0 or more", "0 .. (set by the length of the recordings)" of the parameter `name` ("amounts": all
/// elements of it), in SI, over all laws of the effect that free it; "" where none does, or it has no bounds.
std::string bounds_text(const Effect& effect, const std::string& name);

}  // namespace hysteron
