// Decides where an interval from a linearization cannot be trusted: the model is walked along it, and chi2 must rise as
// the linearization says. Does not find a better interval: profile.h. Internal to fit/.
#pragma once

#include <vector>

#include "fit/estimate/fit.h"
#include "fit/estimate/projection.h"

namespace hysteron {

/// Places in result.estimates whose interval the linearization gets wrong by more than a sixth or so: at an end of it,
/// with the other parameters moved along as the covariance says, chi2 has risen by less than 0.7 or more than 1.4 of
/// what it should have. Two points per parameter that is searched; linear ones that hang on them bend with them.
/// Compare the curvature measures of Bates, Watts, J. R. Stat. Soc. B 42 (1980) 1-25.
std::vector<int> curved_estimates(Projection& projection, const ProjectedPoint& best, const FitResult& result);

}  // namespace hysteron
