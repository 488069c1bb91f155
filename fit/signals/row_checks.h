// Decides what rows say by themselves of how they were recorded: the clock, the finest step of a column, rows that
// repeat or are left out, an end of the range at which a column stays. Knows no diagram and no effect.
// Each check is quiet on a clean recording: what chance or the signal itself may do is no finding.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace hysteron {

/// Rows that are not there: between `row` - 1 and `row`, at `time` [s].
struct ClockGap {
  std::size_t row = 0;
  double time = 0;
  long missing = 0;  ///< rows that the usual step would have put there
};

/// How the rows follow each other in time.
struct Clock {
  double step = 0;                   ///< [s] median
  double shortest = 0, longest = 0;  ///< [s]
  bool regular = false;              ///< nine steps of ten lie within 20 % of the median: gaps can be told
  bool uniform = false;              ///< all steps but gaps are equal, to 0.1 % or to the digits that were written
  double jitter = 0;                 ///< largest deviation of a step that is no gap from the median, over the median
  std::vector<ClockGap> gaps;        ///< only where the clock is regular
  long missing() const;
};
Clock clock_of(std::span<const double> t);

/// The step on whose multiples all values lie [same unit], 0 if there is none. Levels of a converter that were written
/// with few digits are still found: the step is measured over the whole range, not taken from one neighbour.
double finest_step(std::span<const double> values);

// `finest` in what follows: the finest step of the column, 0 = none is known. It is asked for, because a recording may
// rest on too few levels to show it and another of the same column not.

/// Rows at which a column repeats its value though it moves steadily: four rows before and behind go the same way, at
/// one pace (to 30 %) that is clearly more than the finest step and the noise; only the step that catches up may be
/// longer. A turning point, an inflection, a hold or a staircase is none.
std::vector<std::size_t> repeats_in_motion(std::span<const double> values, double finest);

/// Rows that moved by twice or several times the pace of their eight neighbours, which agree to 15 %: rows before them
/// were lost although the clock does not show it.
std::vector<std::size_t> leaps_in_motion(std::span<const double> values, double finest);

/// Single rows half a range and more outside of all others, with their neighbours back among these: an error of
/// transmission, which no device makes.
std::vector<std::size_t> rows_apart(std::span<const double> values);

/// How many more rows of a noisy column repeat the value before exactly than its noise explains; 0 where that is
/// chance. Neighbouring differences of noise are as frequent as none at all; a reading that was not fetched is not.
long unexplained_repeats(std::span<const double> values, double finest);

/// An end of the range at which a column stays.
struct Plateau {
  bool found = false;
  double level = 0;
  std::size_t rows = 0;  ///< at the level, while the drive moves
};
/// Highest and lowest level of a measured column. Rows pile up there, more than eight times as many as on each of the
/// ten levels next to it (a sine piles up 4 times), three and more in a row, though the drive moves on. `moving`: per
/// row, the drive moves there; empty = always.
Plateau plateau_at_top(std::span<const double> values, double finest, const std::vector<bool>& moving);
Plateau plateau_at_bottom(std::span<const double> values, double finest, const std::vector<bool>& moving);

}  // namespace hysteron
