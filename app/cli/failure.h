// Decides how a failure looks: as text for people, or as JSON for programs (--errors json).
// Does not decide what a failure is (engine/diagram/error.h).
#pragma once

#include <string>
#include <vector>

#include "engine/diagram/error.h"

namespace hysteron {

/// The JSON Schema of problems_json().
std::string failure_schema();

/// Prints problems on stderr, in the form that the user asked for.
void print_problems(const std::vector<Problem>& problems, int code, bool as_json);

}  // namespace hysteron
