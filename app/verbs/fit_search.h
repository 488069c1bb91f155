// Decides how the fit of a problem is gone about: its methods one after the other, watched, ended where that is asked
// for, and what the model says before and after. Does not decide what is fitted (fit.cpp) nor how (fit/estimate).
#pragma once

#include "app/cli/watch.h"
#include "fit/thesis/problem.h"
#include "report/pages/fit_page.h"

namespace hysteron {

/// Whoever watches sees where the fit stands, and may end it with the best so far.
void watch_fit(FitOptions& settings, const Watch& watch);

/// Throws Error "fit_failed"; Interrupted where it was ended before anything was found.
Fitted fit_and_compare(DataModel& model, FitProblem problem, const Watch& watch);

}  // namespace hysteron
