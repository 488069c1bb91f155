// Decides whether a measured signal carries a line of one frequency that its drive does not: interference of the mains,
// of a pump, of a power supply. Names no cause.
#pragma once

#include <span>
#include <vector>

namespace hysteron {

/// A line of steady phase and amplitude.
struct SpectralLine {
  double frequency = 0;   ///< [Hz] as it appears at this clock; above half the rate of the rows it is an alias
  double amplitude = 0;   ///< [SI]
  double over_noise = 0;  ///< power over the median of its surroundings
};

/// Lines of `y` (a measured signal, or what a model left of it) on a uniform clock. A line stands out of its
/// surroundings further than chance among so many frequencies (one in a million) and keeps phase and amplitude through
/// six parts of the recording (a resonance that rings does not). Where a drive repeats four times and more, all that
/// repeats with it is its own, whatever the device does, but for a single harmonic that towers over what those beside
/// it lead to expect (periodic_part.h). Of other drives the line is none, nor of their harmonics, sums and differences;
/// a multiple of a tone that has no neighbour of comparable size is not taken for its harmonic from the ninth on.
/// Strongest first.
std::vector<SpectralLine> lines_of(std::span<const double> y, const std::vector<std::span<const double>>& drives,
                                   double step);

}  // namespace hysteron
