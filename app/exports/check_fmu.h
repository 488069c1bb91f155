// Decides what "hysteron check" says of an FMU of any origin. Does not decide what is wrong in a model description
// (io/fmi).
#pragma once

#include "app/cli/answer.h"
#include "app/cli/shape.h"

namespace hysteron {

/// Throws Error "bad_fmu" with all that is wrong. With --allow FILE it is run.
Answer check_fmu(const Arguments& arguments);
shape::Member fmu_shape();  ///< of --json

}  // namespace hysteron
