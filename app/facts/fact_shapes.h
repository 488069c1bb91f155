// Decides the shape of facts that verbs share, or that report/pages makes for them: what their schemas say of "facts".
// Does not make facts.
#pragma once

#include "app/cli/shape.h"

namespace hysteron::shape {

/// metrics_facts() and split_facts(): of compare and of fit.
Facts metrics();
Facts splits();

/// fit_facts()
Facts of_fit();
/// What linearize says of small motions (motion_words.h).
Facts of_small_motions();
/// inspection_facts()
Facts of_inspection();

}  // namespace hysteron::shape
