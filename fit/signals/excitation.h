// Decides what a driving signal shows a device: how far, how fast and in which band it moves, how often it turns, how
// long it is held, and whether it repeats. Knows no diagram and no effect.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace hysteron {

/// A stay of a signal at one level.
struct Hold {
  double begin = 0;   ///< [s]
  double length = 0;  ///< [s]; 0 = there is none
};
/// Longest stay at one level (within 0.5 % of `range`) after a move of at least 5 % of it.
Hold longest_hold(std::span<const double> t, std::span<const double> u, double range);

/// Frequencies [Hz] at which the amplitude spectrum reaches 1 % of its peak. 0, 0 where the clock is not regular or
/// nothing moves.
struct Band {
  double lowest = 0, highest = 0;
};
Band band_of(std::span<const double> u, double step);

/// Sizes of swings between turning points that differ by more than 10 % of the range, smallest first.
std::vector<double> swing_sizes(std::span<const double> u);

/// The way of a signal from one turning point to the next; where it turns less than twice, from end to end too.
struct Swing {
  double size = 0, middle = 0;  ///< [u]
  double fastest = 0;           ///< [u/s] largest change from row to row on the way
};
/// A turn counts once the signal has come back by more than `threshold`.
std::vector<Swing> swings_of(std::span<const double> t, std::span<const double> u, double threshold);

/// A part of a signal that comes again.
struct Period {
  double rows = 0;                  ///< length of one period in rows; not whole where the clock does not divide it
  std::size_t first = 0, last = 0;  ///< rows [first, last) repeat with it: at least two periods
  bool found() const { return rows > 0; }
  double count() const { return rows > 0 ? static_cast<double>(last - first) / rows : 0; }
};
/// The shortest period with which `u` repeats to 1 % of its range for at least two periods.
Period period_of(std::span<const double> u);

/// How often a signal comes again [Hz] that goes up and down once on its way, as a sine does; 0 where it is none such.
double cycle_frequency(std::span<const double> t, std::span<const double> u);
/// Which multiple of how often each recording's drive comes again a frequency is, 2 to 15, in every recording: then it
/// is made of the drive. 0 = it is none, or `cycles` is empty.
int harmonic_order(double frequency, std::span<const double> cycles);

}  // namespace hysteron
