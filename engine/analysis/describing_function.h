// Decides the describing function of a block: the first harmonic of what it makes of a sine, over that sine. Internal
// to the engine; on request it takes the place of slopes (linearize.h). Source: Gelb, Vander Velde, Multiple-Input
// Describing Functions and Nonlinear System Design (1968), chapter 2.
#pragma once

#include <complex>
#include <vector>

#include "engine/program/program.h"

namespace hysteron {

/// Per output, [out/in]: for a sine of that amplitude about `centre`, the value of the block's only input at the
/// operating point (both SI), after so many periods that memory repeats itself. To 1e-4 of itself where the output
/// jumps, else better. Throws Error "no_describing_function" for blocks whose answer depends on the frequency (states
/// that are not rate-independent, dead times) and for those with several inputs.
std::vector<std::complex<double>> describing_function(const Program& program, const Run& run, int block, double centre,
                                                      double amplitude);

}  // namespace hysteron
