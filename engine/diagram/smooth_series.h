// Decides how a signal that was sampled moves where it moves smoothly: the band-limited output of a generator or an
// amplifier bends between its samples, and straight lines through them are sinc^2(f/fs) too small. Does not decide
// whether it does: the data set says so.
#pragma once

#include "engine/diagram/series.h"

namespace hysteron {

/// `series` as the engine steps through it; what is straight or held is given back as it is. What moves smoothly, a
/// cubic spline through the samples ("not a knot" at the ends), becomes straight pieces: one, two or four between two
/// samples, by how much it bends there. They pass through the samples; in between they lie on the outer side of the
/// curve, by as much as straight pieces lie inside in the mean: what follows slowly then sees it to the fourth power of
/// their length. Fewer than four samples: straight lines. Source: de Boor, A Practical Guide to Splines (1978), chapter
/// IV.
Series in_straight_pieces(Series series);

}  // namespace hysteron
