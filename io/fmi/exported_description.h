// Decides what the model description says of a diagram that is exported: ranges, sizes, dependencies, the experiment.
// Does not write it (fmi_description.h).
#pragma once

#include <string>

#include "engine/program/program.h"
#include "io/fmi/fmi_description.h"

namespace hysteron {

/// For co-simulation, with the variables of fmi_variables(). `version`: 2 or 3; `identifier`: a name of C.
FmiDescription exported_description(const Program& program, int version, const std::string& identifier,
                                    const std::string& token);

}  // namespace hysteron
