// Decides how single lines are seen in rows on a uniform clock: how far each frequency stands out of its surroundings,
// which peaks are as narrow as a line, how large and where exactly one is. Does not ask where a line comes from
// (interference.h). Internal to fit/.
#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

namespace hysteron {

/// Rows without mean and straight line, so that a drift does not hide what is low.
std::vector<double> without_trend(std::span<const double> y);

/// Power and how far it stands out around each frequency k / (2 n step), k = 0 .. n - 1.
struct Spectrum {
  std::vector<double> power, ratio;
  double least = 0;  ///< ratio that chance does not reach
};
Spectrum spectrum_of(const std::vector<double>& rows);

/// A line is a few frequencies wide; what still rings, or what a resonance makes of a dense drive, is wider.
bool sharp(const std::vector<double>& power, std::size_t k);

/// Largest ratios that are peaks, as k, largest first.
std::vector<std::size_t> peaks(const std::vector<double>& ratio, double least, std::size_t most);

/// Amplitude and phase of exp(2 pi i f row) over rows [begin, end), windowed.
std::complex<double> amplitude_at(const std::vector<double>& rows, std::size_t begin, std::size_t end, double f);

/// The frequency [1/row] of a peak, sharper than the grid of cosines.
double refined(const std::vector<double>& rows, std::size_t k);

}  // namespace hysteron
