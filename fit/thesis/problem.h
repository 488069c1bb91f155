// Decides what a job asks of a fit: free parameters in SI with their bounds, priors and recordings, and the options of
// each method. The command line without a job file goes the same way. Does not read files and does not fit.
#pragma once

#include <string>
#include <vector>

#include "fit/estimate/fit.h"
#include "io/jobs/job_file.h"

namespace hysteron {

struct FitMethod {
  std::string name;
  FitOptions options;
  bool of_thesis = false;  ///< thesis_methods.h: finds the parameters of its block, free or not
};

struct FitProblem {
  std::vector<FreeParameter> free;
  std::vector<FitMethod> methods;
};

/// `extra`: parameters that are free beside those of the diagram where the job names none (effects, --free).
/// Throws Error whose paths are JSON pointers into the job: "unknown_parameter", "wrong_unit", "bad_bounds",
/// "start_outside", "bad_prior", "unknown_method", "free_twice", "not_free".
FitProblem problem_of(const FitJob& job, const Program& program, const DataSet& data,
                      const std::vector<std::string>& extra);

}  // namespace hysteron
