// Decides what a line of interference may do in one recording beside being steady: its amplitude and phase wander
// slowly. Does not find lines (interference.h) and does not decide whose they are. Internal to fit/ and discover/.
#pragma once

#include <span>

#include "fit/dense.h"
#include "fit/whiten.h"

namespace hysteron {

/// A line and its harmonics: amplitude and phase of each move in straight lines between knots.
struct WanderingLine {
  double frequency = 0;  ///< [Hz]
  int harmonics = 1;     ///< the line itself counts
};

/// Whitened, orthonormal columns; none where rows are too few for two knots.
struct LineColumns {
  Dense steady;     ///< a line of exactly this frequency, which a model that has one keeps
  Dense wandering;  ///< what else it may be, orthogonal to that
};

/// What such a line may be in rows at t [s]. A knot every two seconds: a mains 8 mHz off its mean frequency turns by a
/// tenth of a radian in that time, which straight lines follow to a few per mille. Fewer where rows are few: at most a
/// twentieth of them are given away, and with them no more of what another effect takes away.
LineColumns line_columns(std::span<const double> t, const WanderingLine& line, const Whitener& whitener);

}  // namespace hysteron
