// Decides for how long the input of each row has been held, and whether a residual grows while it is.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "fit/compare/compare.h"
#include "fit/signals/branches.h"

namespace hysteron {

/// Times for which the input has been held [s], row by row; -1 where it moves.
struct Holds {
  std::vector<Rows> age;                                                   ///< [recording][row]
  double shortest = std::numeric_limits<double>::infinity(), longest = 0;  ///< [s] behind the first row of a hold
  int after_step = 0, after_motion = 0;                                    ///< how they begin
};

/// `branch`: of each row of each recording; all have an input.
Holds holds_of(const std::vector<SplitInput>& recordings, const std::vector<std::vector<Branch>>& branch);

/// ", growing with log time" where the residual of the holds does: by decades rather than by seconds, and outwards. A
/// straight line in time is ", growing with time". "" where it does neither, or no hold lasts two decades.
std::string growth_of(const Holds& holds, const std::vector<SplitInput>& recordings);

}  // namespace hysteron
