// Decides which signal a name in a job means: a path, or an output of the diagram.
#pragma once

#include <string>

#include "engine/program/program.h"

namespace hysteron {

/// A signal by its path, or an output of the diagram by its name; -1 if there is none.
int find_named(const Program& program, const std::string& name);
/// The same; throws Error "unknown_signal" with the nearest name.
int named_signal(const Program& program, const std::string& name);

}  // namespace hysteron
