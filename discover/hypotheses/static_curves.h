// Decides the law that effects share which bend a signal without memory. Does not decide where it stands.
#pragma once

#include "discover/hypotheses/effect.h"

namespace hysteron::effects {

/// [SI] The constant of the neutral curve.
double neutral_constant(const Excitation& at);
/// y = c_0 + c_1 x + c_2 x^2 + ... of the given order, x = (u - about)/range, straight on beyond twice the range. What
/// a curve is bent about is its best straight line (Fleming, section 2), whose slope the user's gain stands for: from
/// the rest position, c_1 is free with it unless a gain behind it is; its constant is the user's zero (moves_zero).
Law curve(const Excitation& at, int order);
/// What such effects say alike.
Effect static_curve();

}  // namespace hysteron::effects
