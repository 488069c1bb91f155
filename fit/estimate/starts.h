// Decides how recordings begin whose start the data set leaves open, where the way from a state to the outputs is not
// linear: the start that leaves least of the residual, found by Gauss and Newton's steps with all parameters held. What
// is linear needs none of this: it is found in closed form beside the parameters (projection.h).
#pragma once

#include <span>

#include "fit/model/model.h"
#include "fit/model/score.h"

namespace hysteron {

/// Moves the starts of these recordings, as far as they are free and searched for, to where the whitened residual is
/// least at these values. True if any residual has fallen by more than one part in a million. A recording that cannot
/// be simulated stays as it is.
bool improve_starts(DataModel& model, const Judge& judge, std::span<const ParameterValue> values,
                    std::span<const int> recordings);

}  // namespace hysteron
