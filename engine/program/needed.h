// Decides which steps of a program the values of a few signals need: recording three signals of a thousand need not
// make the others.
#pragma once

#include <vector>

#include "engine/program/program.h"

namespace hysteron {

/// Of program.all_values, in their order, those steps on which these signals depend between sampling instants. A loop
/// counts as one step.
std::vector<Step> steps_for(const Program& program, const std::vector<int>& signals);

/// evaluate_values() for these steps only: work.y is set where they make it.
void evaluate_steps(const Program& program, const Run& run, Work& work, double t, const double* x,
                    const std::vector<Step>& steps);

}  // namespace hysteron
