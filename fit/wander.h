// Decides what a line of interference may do in one recording beside being steady: its amplitude and phase wander
// slowly. Does not find lines (interference.h) and does not decide whose they are. Internal to fit/ and discover/.
#pragma once

#include <span>

#include "fit/dense.h"
#include "fit/whiten.h"

namespace hysteron {

/// A line and its harmonics, near this frequency [Hz]: amplitude and phase move in straight lines between knots.
struct WanderingLine {
  double frequency = 0;
  int harmonics = 1;
  bool operator==(const WanderingLine&) const = default;
};

/// What of a line is meant: all that it may be, or that less what a steady one of exactly its frequency is, which a
/// model that has a line of its own keeps.
enum class PartOfLine { all, beside_a_steady_one };

/// Whitened, orthonormal columns of what such a line may be in rows at t [s]. A knot every two seconds (a mains that
/// wanders by some millihertz turns by a tenth of a radian in that time at most, EN 50160), fewer where rows are few:
/// at most a twentieth of the rows are given away. No columns where rows are too few for that.
Dense line_columns(std::span<const double> t, const WanderingLine& line, const Whitener& whitener, PartOfLine part);

}  // namespace hysteron
