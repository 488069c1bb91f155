// Decides what is said of the solver that a simulation would take: which, why, with which tolerances and steps.
// Does not choose it (engine/simulate/choose_method.h).
#pragma once

#include <string>
#include <vector>

#include "engine/program/program.h"

namespace hysteron {

struct SolverWords {
  std::string method, why;
  std::vector<std::vector<std::string>> rows;  ///< of a table without heads
};

/// `run`: at its start.
SolverWords solver_words(const Program& program, const Run& run);

/// "0.1 ms": times here come from many files, so none of their units is right for all.
std::string time_words(double seconds);

}  // namespace hysteron
