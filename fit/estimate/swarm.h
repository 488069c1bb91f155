// Decides two pieces of the swarms that stand on their own: the bounce at a bound, and the curves of an attractor.
// Does not search (global.h).
#pragma once

#include <vector>

#include "fit/estimate/global.h"

namespace hysteron {

/// A particle that leaves [lower, upper] comes back as from a mirror, x' = x_b +- |x - x_b|, as often as needed, with
/// its velocity turned round each time. Source: thesis Eq. 4.3.
void reflect(double lower, double upper, double& x, double& v);

/// Sum of factor exp(rate x). Source: thesis Eqs. 4.11, 4.12.
double sum_of(const std::vector<Attractor::Exponential>& terms, double x);

}  // namespace hysteron
