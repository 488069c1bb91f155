// Decides how an effect is drawn: with it and without, over the input or over time, and what it adds.
// Does not simulate (discover/demonstration/demonstration.h).
#pragma once

#include <string>

#include "discover/demonstration/demonstration.h"
#include "io/results/result.h"

namespace hysteron {

/// What was done: "a step and a hold; 1 % of the move per decade ...".
std::string picture_caption(const Demonstration& shown);

/// For a terminal: with the effect and without; where these cannot be told apart there, what it adds.
std::string picture_text(const Demonstration& shown);

/// With the effect and without, then what it adds, then the second signal that it reads.
std::vector<Figure> picture_figures(const Demonstration& shown);

}  // namespace hysteron
