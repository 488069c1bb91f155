// Decides how many roots of the characteristic equation of a linear system lie right of the imaginary axis: without
// dead times the eigenvalues, with them a count along the axis.
//
// The characteristic function f(s) = det [s - A, -B E(s); -C, 1 - G E(s)], E = diag(factor exp(-s delay)), has no
// poles. Over prod (s + q_i) det(1 - G E), which has no zeros on the right, it tends to 1 far out: so the number of
// zeros right of the axis is minus the turn of that quotient from w = 0 to infinity, over pi (the principle of the
// argument; Nyquist, Bell Syst. Tech. J. 11 (1932) 126-147; Michailow 1938). Steps along the axis are bound by the
// logarithmic slope |f'/f|: a zero at the distance d of the line makes it 1/d, so that no step, however close or
// multiple the zeros are, passes one unseen. Behind the frequency from which the dead times can no longer turn the
// quotient its turn is known in closed form. Zeros on the axis (integrators that no loop closes) are told from those on
// the right by lines a hair right and left of it.
#pragma once

#include "engine/analysis/linearize.h"

namespace hysteron {

/// Of the model without its inputs. A describing function with a phase counts as a law that is real at w = 0 and has
/// its factor at all other frequencies. Throws Error "not_counted" where the steps along the axis do not suffice.
PoleCount unstable_poles(const LinearModel& model);

/// Of a loop with one input and one output, closed by u = -gain y.
PoleCount unstable_when_closed(const LinearModel& loop, double gain = 1);

}  // namespace hysteron
