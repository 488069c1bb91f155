// Decides how planned blocks are written as C99: a header and a source. Does not decide which blocks (c_plan.h) nor how
// the code is tested (c_test.h).
#pragma once

#include <string>
#include <vector>

#include "export/c/c_plan.h"
#include "export/c/c_text.h"

namespace hysteron {

/// How the code is called and from what it was made.
struct CWish {
  std::string name = "comp";  ///< of files, functions and types
  c_text::Real real = c_text::Real::float64;
  std::string from{};  ///< "feedback_sampled.json", for the comments
};

/// One number that goes in or out.
struct CPort {
  std::string name;       ///< of the member in C
  std::string signal;     ///< as the diagram has it
  Unit unit{};            ///< in which people read it; the code itself works in SI
  std::string si_unit{};  ///< "m s^-1"
};

struct CSource {
  std::string header, source;
  std::vector<CPort> inputs, outputs;
  long state_numbers = 0, constants = 0;  ///< floating-point numbers that the state and the tables hold
};

/// Throws Error "not_in_c" where a number does not fit into a float.
CSource c_source(const CPlan& plan, const CWish& wish);

}  // namespace hysteron
