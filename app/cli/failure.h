// Decides how a failure looks: as text for people, or as JSON for programs (--errors json).
// Does not decide what a failure is (engine/diagram/error.h), but what an exception of a library is.
#pragma once

#include <exception>
#include <string>
#include <vector>

#include "engine/diagram/error.h"

namespace hysteron {

/// What an exception means that left a verb.
struct Failure {
  int code = 0;                     ///< as the program ends (verb.h)
  std::vector<Problem> problems{};  ///< none where the work was interrupted
  std::string interrupted{};        ///< then: what was kept
  bool of_the_system = false;       ///< files and terminals
};
Failure failure_of(const std::exception_ptr& exception);

/// The JSON Schema of problems_json().
std::string failure_schema();

/// Prints problems on stderr, in the form that the user asked for.
void print_problems(const std::vector<Problem>& problems, int code, bool as_json);

}  // namespace hysteron
