// Decides what a diagram gets to know of an FMU that one of its blocks is: inputs, outputs and parameters with their
// units; and, where the user trusts it, where it lies unpacked. Does not load it (blocks/fmi).
#pragma once

#include <string>
#include <vector>

#include "engine/block/foreign_interface.h"
#include "io/fmi/fmi_description.h"

namespace hysteron {

struct LookedThrough {
  FmiDescription description{};
  std::vector<std::string> faults{};  ///< of the description and of what is missing in the archive
};

/// What an FMU says of itself, and what is wrong with it; nothing of it is run. Throws Error "damaged_file", "bad_fmu".
LookedThrough look_through_fmu(const std::string& file);

/// The variables that a block of a diagram shows of it; not where it lies. Throws Error "bad_fmu".
ForeignInterface interface_of(const FmiDescription& description, const std::string& written);

/// Reads `file`, which the diagram calls `written`. Unpacked, into a folder of this process that goes away with it,
/// only if it is trusted. Throws Error "bad_fmu" where it cannot be a block: no co-simulation, no binary for this
/// machine, inputs that are no real numbers.
ForeignInterface imported_fmu(const std::string& file, const std::string& written, bool trusted);

}  // namespace hysteron
