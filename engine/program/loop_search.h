// Decides how the tears of a loop are found: points 2 to 4 of loops.h. Internal to engine/program.
#pragma once

#include "engine/program/loops.h"

namespace hysteron {

/// From Run::warm on, with what stands outside the loop in `s`: the solution is in s.v. False where none was found;
/// then s.best, s.best_residual, s.best_weakest and s.jumps tell how far the search came.
bool search_loop(LoopSolver& s, const Program& program, const Loop& loop);

}  // namespace hysteron
