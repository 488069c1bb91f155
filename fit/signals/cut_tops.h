// Decides whether a drive was cut at an end of its range: an amplifier at its limit, a logger that saturates. A flat
// top alone says nothing: squares, trapezoids and holds are made so. A top that was rounded bends towards its summit on
// both sides, on to where it is flat; a flank that is straight, or that arrives gently, was meant.
#pragma once

#include <cstddef>
#include <span>

namespace hysteron {

struct CutTops {
  bool found = false;
  double level = 0;      ///< [same unit]
  double would_be = 0;   ///< the farthest that a top would reach, as its flanks go on
  std::size_t tops = 0;  ///< that are cut there
};
/// Rows of a uniform clock. Three tops at the least are cut, and half of all that are flat at the end of the range.
/// Told from curves through both flanks (a parabola; where the drive goes up and down once in `cycle` rows a sine, too:
/// its flanks show it however far down it is cut; 0 = there is none such), which must be clearly nearer than straight
/// flanks. `finest`: step between levels, 0 = none is known.
CutTops cut_at_top(std::span<const double> u, double finest, double cycle);
CutTops cut_at_bottom(std::span<const double> u, double finest, double cycle);

}  // namespace hysteron
